//! The positions at which a coordinate has a value.

use std::cmp::Ordering;

use crate::assemblies::assembly::{Assembly, PathFailure};

/// A position of the mechanism.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// Coordinates of the drivers, rad or m; angles in (−π, π].
    pub q: Vec<f64>,
    /// Where the assembly stands: at `q`, or beside it where `q` is a fold.
    pub at: Vec<f64>,
    /// The assembly.
    pub assembly: Assembly,
}

/// All positions of a design.
#[derive(Debug, Clone, PartialEq)]
pub struct Answers {
    /// By their coordinates.
    pub found: Vec<Answer>,
    /// Paths of the search that did not lead to a position.
    pub failures: Vec<PathFailure>,
    /// Whether no position can be missing.
    pub is_complete: bool,
}

impl Answer {
    /// The order of two positions.
    pub(super) fn order(&self, other: &Self) -> Ordering {
        let pairs = self.q.iter().zip(&other.q);
        let differ = |(a, b): (&f64, &f64)| a.partial_cmp(b).filter(|order| order.is_ne());
        pairs.into_iter().find_map(differ).unwrap_or(Ordering::Equal)
    }
}
