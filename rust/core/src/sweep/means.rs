//! Means of a coordinate over the positions; evenly spaced over a turn, they are those over the turn.

use super::coordinate::Coordinate;
use super::metric::{MeanOf, Metric, Need, Positions, Slopes};

/// The arithmetic mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Mean(pub Coordinate);

impl Metric for Mean {
    fn needs(&self) -> Vec<Need> {
        vec![self.0.need]
    }

    fn of(&self, positions: &Positions<'_>) -> f64 {
        mean(self.0.values(positions))
    }

    fn mean_of(&self) -> Option<MeanOf> {
        Some(self.0.mean(false))
    }

    fn with_slopes(&self) -> Option<&dyn Slopes> {
        Some(self)
    }
}

impl Slopes for Mean {
    fn slopes(&self, positions: &Positions<'_>) -> Vec<Vec<f64>> {
        vec![self.0.slopes(positions, |_| 1.0 / positions.count() as f64)]
    }
}

/// The root of the mean square.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RootMeanSquare(pub Coordinate);

impl Metric for RootMeanSquare {
    fn needs(&self) -> Vec<Need> {
        vec![self.0.need]
    }

    fn of(&self, positions: &Positions<'_>) -> f64 {
        mean(self.0.values(positions).map(|value| value * value)).sqrt()
    }

    fn mean_of(&self) -> Option<MeanOf> {
        Some(self.0.mean(true))
    }

    fn with_slopes(&self) -> Option<&dyn Slopes> {
        Some(self)
    }
}

impl Slopes for RootMeanSquare {
    fn slopes(&self, positions: &Positions<'_>) -> Vec<Vec<f64>> {
        let over = self.of(positions) * positions.count() as f64;
        vec![self.0.slopes(positions, |value| value / over)]
    }
}

/// NaN without values.
fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for value in values {
        sum += value;
        count += 1.0;
    }
    sum / count
}
