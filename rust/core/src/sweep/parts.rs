//! A metric over a part of the positions.

use super::course::Course;
use super::metric::{Growth, Metric, Need, Positions, Slopes};

/// Coordinates are compared with the ends of a part to this share of the greatest of them: sums and
/// conversions from degrees are some roundings off.
const END: f64 = 1.0e-12;

/// A metric of the positions whose coordinate is within a range, its ends included. For one driver.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Part<M> {
    /// The metric.
    pub metric: M,
    /// First and last coordinate, rad or m.
    pub from: f64,
    /// See `from`.
    pub to: f64,
    /// The modulus of the coordinates: a turn, for angles.
    pub period: Option<f64>,
}

/// The positions of a part, in the order of the path.
struct Chosen {
    places: Vec<usize>,
    /// Whether the path passes the end of q, from the last position to the first.
    passes_end: bool,
    /// Whether the positions are consecutive.
    is_one_stretch: bool,
}

impl<M> Part<M> {
    /// The indices of its positions, in the order of the path.
    #[must_use]
    pub fn places(&self, q: &[f64]) -> Vec<usize> {
        self.choose(q).places
    }

    fn contains(&self, q: f64, tolerance: f64) -> bool {
        let length = self.to - self.from;
        match self.period {
            None => self.from - tolerance <= q && q <= self.to + tolerance,
            Some(period) => {
                let turned = (q - self.from) / period;
                let after = (turned - turned.floor()) * period;
                after <= length + tolerance || after >= period - tolerance
            }
        }
    }

    fn choose(&self, q: &[f64]) -> Chosen {
        let greatest = |most: f64, q: &f64| most.max(q.abs());
        let size = q.iter().fold(self.from.abs().max(self.to.abs()), greatest);
        let size = self.period.map_or(size, |period| size.max(period));
        let is_in = |&at: &usize| self.contains(q[at], END * size);
        let mut places: Vec<usize> = (0..q.len()).filter(is_in).collect();
        let mut breaks = (1..places.len()).filter(|&k| places[k] != places[k - 1] + 1);
        let (first_break, has_more) = (breaks.next(), breaks.next().is_some());
        let is_at_both_ends = places.first() == Some(&0) && places.last() == Some(&(q.len() - 1));
        let passes_end = self.period.is_some() && is_at_both_ends && first_break.is_some();
        if let (true, Some(first)) = (passes_end && !has_more, first_break) {
            places.rotate_left(first);
        }
        let is_one_stretch = !has_more && (passes_end || first_break.is_none());
        Chosen { places, passes_end, is_one_stretch }
    }
}

impl<M: Metric> Part<M> {
    /// Shows the metric its positions.
    fn show<T>(
        &self,
        positions: &Positions<'_>,
        places: &[usize],
        see: impl FnOnce(&Positions<'_>) -> T,
    ) -> T {
        let q: Vec<f64> = places.iter().map(|&at| positions.q[at]).collect();
        let gather = |(values, need): (&&[f64], Need)| -> Vec<f64> {
            let width = need.width();
            places.iter().flat_map(|&at| &values[at * width..][..width]).copied().collect()
        };
        let values: Vec<Vec<f64>> =
            positions.values.iter().zip(self.metric.needs()).map(gather).collect();
        let values: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
        let returns = positions.returns && places.len() == positions.q.len();
        see(&Positions { q: &q, values: &values, returns, ..*positions })
    }
}

impl<M: Metric> Metric for Part<M> {
    fn needs(&self) -> Vec<Need> {
        self.metric.needs()
    }

    fn of(&self, positions: &Positions<'_>) -> f64 {
        let Chosen { places, passes_end, .. } = self.choose(positions.q);
        if passes_end && self.metric.asks_return() && !positions.returns {
            return f64::NAN;
        }
        self.show(positions, &places, |seen| self.metric.of(seen))
    }

    fn with_slopes(&self) -> Option<&dyn Slopes> {
        self.metric.with_slopes().map(|_| self as &dyn Slopes)
    }

    fn growth(&self) -> Growth {
        self.metric.growth()
    }

    fn of_failed(&self) -> f64 {
        self.metric.of_failed()
    }

    fn asks_return(&self) -> bool {
        self.metric.asks_return()
    }

    fn effort(&self) -> usize {
        self.metric.effort()
    }

    fn check(&self, course: &Course<'_>) -> Result<(), String> {
        course.check_one_driver("a part of the positions")?;
        let Chosen { places, passes_end, is_one_stretch } = self.choose(course.q);
        let is_path = is_one_stretch && (!passes_end || course.turn.is_some());
        if self.metric.asks_return() && !is_path {
            return Err(format!(
                "the {} positions from {} to {} do not follow each other: q must go once round in \
                 even steps, without its end, or not pass over this part twice",
                places.len(),
                self.from,
                self.to
            ));
        }
        let q: Vec<f64> = places.iter().map(|&at| course.q[at]).collect();
        let turn = course.turn.filter(|_| q.len() == course.q.len());
        self.metric.check(&Course { q: &q, turn, ..*course })
    }
}

impl<M: Metric> Slopes for Part<M> {
    fn slopes(&self, positions: &Positions<'_>) -> Vec<Vec<f64>> {
        let places = self.places(positions.q);
        let own = self.show(positions, &places, |seen| {
            self.metric.with_slopes().map(|metric| metric.slopes(seen)).unwrap_or_default()
        });
        let spread = |(own, need): (Vec<f64>, Need)| {
            // (Of a direction there is one a position.)
            let width = own.len().checked_div(places.len()).unwrap_or_else(|| need.width());
            let mut slopes = vec![0.0; width * positions.count()];
            for (&at, own) in places.iter().zip(own.chunks_exact(width)) {
                slopes[at * width..][..width].copy_from_slice(own);
            }
            slopes
        };
        own.into_iter().zip(self.needs()).map(spread).collect()
    }

    fn by_dimensions(&self, positions: &Positions<'_>) -> Vec<(usize, f64)> {
        let places = self.places(positions.q);
        self.show(positions, &places, |seen| {
            let slopes = self.metric.with_slopes();
            slopes.map(|metric| metric.by_dimensions(seen)).unwrap_or_default()
        })
    }
}
