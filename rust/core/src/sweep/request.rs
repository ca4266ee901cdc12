//! The request for a sweep, and its result.

use super::metric::{Condition, Metric};
use crate::plan::mechanism::Mechanism;

/// A request for a sweep.
#[derive(Clone, Copy)]
pub struct Sweep<'a> {
    /// Dimensions: the first of every design, then the second of every design, and so on.
    pub dimensions: &'a [f64],
    /// Coordinates of all designs, rad or m.
    pub q: &'a [f64],
    /// Assembly signs, +1 or −1 for every dyad with two solutions.
    pub signs: &'a [i8],
    /// The metrics.
    pub metrics: &'a [&'a dyn Metric],
    /// The conditions on designs, in the order in which they are checked.
    pub conditions: &'a [Condition],
    /// The gradients to find.
    pub gradients: Gradients<'a>,
}

/// Gradients by dimensions of metrics that are [means](Metric::mean_of) or know their [slopes](Metric::with_slopes).
#[derive(Debug, Clone, Copy, Default)]
pub struct Gradients<'a> {
    /// Indices of the metrics.
    pub of: &'a [usize],
    /// The dimensions, in the order of [`Mechanism::dimensions`].
    pub by: &'a [usize],
}

/// The metrics of a batch.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Measured {
    /// For every metric, its value for every design. Designs that do not move have its
    /// [number for these](Metric::of_failed), mostly NaN, and those that miss a condition NaN.
    pub values: Vec<Vec<f64>>,
    /// For every design a [`Status`](crate::Status) code: that of a position that cannot be solved, if one was
    /// found, or the worst. A design that misses a condition has 0: it is not solved further.
    pub status: Vec<u8>,
    /// Whether it moves over all positions and meets all conditions.
    pub kept: Vec<bool>,
    /// For every gradient the derivatives of each design, design after design: NaN if it is not kept.
    pub gradients: Vec<Vec<f64>>,
}

impl<'a> Sweep<'a> {
    /// Designs of a mechanism in the assembly of its drawing, without metrics.
    #[must_use]
    pub fn of(mechanism: &'a Mechanism, dimensions: &'a [f64], q: &'a [f64]) -> Self {
        let gradients = Gradients::default();
        Self { dimensions, q, signs: mechanism.signs(), metrics: &[], conditions: &[], gradients }
    }
}
