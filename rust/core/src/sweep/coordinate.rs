//! One coordinate of a motion: of a joint, a link or a slide, or a derivative of it.

use super::metric::{MeanOf, Need, Positions};
use crate::batch::request::Quantity;
use crate::query::extremes::tracked::Tracked;

/// A coordinate, or a derivative of it by the driver's.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Coordinate {
    /// Where it is read.
    pub need: Need,
    /// For a joint, 0 for x and 1 for y.
    pub component: usize,
}

impl Coordinate {
    /// A joint's x or y, m.
    #[must_use]
    pub fn joint(index: usize, component: usize) -> Self {
        Self { need: Need { quantity: Quantity::Joint(index), order: 0 }, component }
    }

    /// A link's angle, rad.
    #[must_use]
    pub fn link(index: usize) -> Self {
        Self { need: Need { quantity: Quantity::Angle(index), order: 0 }, component: 0 }
    }

    /// A slide's value, m.
    #[must_use]
    pub fn slide(index: usize) -> Self {
        Self { need: Need { quantity: Quantity::Slide(index), order: 0 }, component: 0 }
    }

    /// Its derivative of an order by the driver's coordinate.
    #[must_use]
    pub fn derivative(self, order: usize) -> Self {
        Self { need: Need { order, ..self.need }, ..self }
    }

    /// What its mean is, or the root of the mean of its squares.
    pub(super) fn mean(self, is_root_of_squares: bool) -> MeanOf {
        MeanOf { need: self.need, component: self.component, is_root_of_squares }
    }

    /// The numbers of its need, each replaced by a function of the coordinate there: of other components 0.
    pub(super) fn slopes(&self, positions: &Positions<'_>, of: impl Fn(f64) -> f64) -> Vec<f64> {
        let stride = self.need.width();
        let first = self.component.min(stride - 1);
        let mut slopes = vec![0.0; stride * positions.count()];
        let own = slopes.iter_mut().skip(first).step_by(stride);
        for (slope, value) in own.zip(self.values(positions)) {
            *slope = of(value);
        }
        slopes
    }

    /// Its numbers, if it is the only need.
    pub(super) fn values<'a>(&self, positions: &Positions<'a>) -> impl Iterator<Item = f64> + 'a {
        let stride = self.need.width();
        let first = self.component.min(stride - 1);
        let all = positions.values.first().copied().unwrap_or(&[]);
        all.iter().skip(first).step_by(stride).copied()
    }
}

impl From<Tracked> for Coordinate {
    fn from(tracked: Tracked) -> Self {
        match tracked {
            Tracked::Joint(index, component) => Self::joint(index, component),
            Tracked::Link(index) => Self::link(index),
            Tracked::Slide(index) => Self::slide(index),
        }
    }
}
