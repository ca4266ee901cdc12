//! Extremes of a coordinate: their values, their places and their difference.

use super::coordinate::Coordinate;
use super::course::Course;
use super::metric::{Growth, Metric, Need, Positions, Slopes};

/// The greatest value minus the least.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Span(pub Coordinate);

impl Metric for Span {
    fn needs(&self) -> Vec<Need> {
        vec![self.0.need]
    }

    fn of(&self, positions: &Positions<'_>) -> f64 {
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        for value in self.0.values(positions) {
            range = [range[0].min(value), range[1].max(value)];
        }
        // Without positions it is not a number.
        if range[0] <= range[1] { range[1] - range[0] } else { f64::NAN }
    }

    fn growth(&self) -> Growth {
        Growth::Rises
    }

    fn with_slopes(&self) -> Option<&dyn Slopes> {
        Some(self)
    }
}

impl Slopes for Span {
    fn slopes(&self, positions: &Positions<'_>) -> Vec<Vec<f64>> {
        let [mut greatest, least] = [Extreme::Greatest(self.0), Extreme::Least(self.0)]
            .map(|extreme| extreme.slopes(positions));
        for (slope, least) in greatest.iter_mut().flatten().zip(least.iter().flatten()) {
            *slope -= least;
        }
        greatest
    }
}

/// The kind of an extreme.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extreme {
    /// The least value of a coordinate.
    Least(Coordinate),
    /// Its greatest value.
    Greatest(Coordinate),
}

impl Extreme {
    fn coordinate(&self) -> &Coordinate {
        match self {
            Self::Least(coordinate) | Self::Greatest(coordinate) => coordinate,
        }
    }

    /// The extreme, and the first position that has it.
    fn find(&self, positions: &Positions<'_>) -> Option<(usize, f64)> {
        let mut extreme: Option<(usize, f64)> = None;
        for (index, value) in self.coordinate().values(positions).enumerate() {
            let exceeds = |most: f64| match self {
                Self::Least(_) => value < most,
                Self::Greatest(_) => value > most,
            };
            if extreme.is_none_or(|(_, most)| exceeds(most)) {
                extreme = Some((index, value));
            }
        }
        extreme
    }
}

impl Metric for Extreme {
    fn needs(&self) -> Vec<Need> {
        vec![self.coordinate().need]
    }

    fn of(&self, positions: &Positions<'_>) -> f64 {
        self.find(positions).map_or(f64::NAN, |(_, value)| value)
    }

    fn growth(&self) -> Growth {
        match self {
            Self::Least(_) => Growth::Falls,
            Self::Greatest(_) => Growth::Rises,
        }
    }

    fn with_slopes(&self) -> Option<&dyn Slopes> {
        Some(self)
    }
}

impl Slopes for Extreme {
    /// An extreme changes as its coordinate does at the position where it is (the envelope theorem, J. M. Danskin
    /// 1966).
    fn slopes(&self, positions: &Positions<'_>) -> Vec<Vec<f64>> {
        let Coordinate { need, component } = *self.coordinate();
        let width = need.width();
        let mut slopes = vec![0.0; width * positions.count()];
        if let Some((index, _)) = self.find(positions) {
            slopes[width * index + component.min(width - 1)] = 1.0;
        }
        vec![slopes]
    }
}

/// The index of the position that has an extreme, of those that the metric is of; the first of several equal
/// ones. NaN without positions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct IndexOf<M>(pub M);

/// A metric that one position decides.
pub trait Decided: Metric {
    /// The index of that position.
    fn index(&self, positions: &Positions<'_>) -> Option<usize>;
}

impl Decided for Extreme {
    fn index(&self, positions: &Positions<'_>) -> Option<usize> {
        self.find(positions).map(|(index, _)| index)
    }
}

impl<M: Decided> Metric for IndexOf<M> {
    fn needs(&self) -> Vec<Need> {
        self.0.needs()
    }

    fn of(&self, positions: &Positions<'_>) -> f64 {
        self.0.index(positions).map_or(f64::NAN, |index| index as f64)
    }

    fn check(&self, course: &Course<'_>) -> Result<(), String> {
        self.0.check(course)
    }
}

/// The driver's coordinate at an extreme; the first of several equal ones. For one driver.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlaceOf(pub Extreme);

impl Metric for PlaceOf {
    fn needs(&self) -> Vec<Need> {
        self.0.needs()
    }

    fn of(&self, positions: &Positions<'_>) -> f64 {
        let place = self.0.find(positions).and_then(|(index, _)| positions.q.get(index));
        place.copied().unwrap_or(f64::NAN)
    }

    fn check(&self, course: &Course<'_>) -> Result<(), String> {
        course.check_one_driver("the place of an extreme")
    }
}
