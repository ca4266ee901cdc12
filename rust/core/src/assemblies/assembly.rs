//! One assembly of a mechanism, and all of them at a position.

use std::fmt;

use super::solutions::PathEnd;

/// A way to put a mechanism together at a coordinate.
#[derive(Debug, Clone, PartialEq)]
pub struct Assembly {
    /// Signs of the dyads with two solutions, in the order of
    /// [`Mechanism::dyad_names`](crate::Mechanism::dyad_names). Without groups above class II they are
    /// those at the drawing; else those at the coordinate.
    pub signs: Vec<i8>,
    /// Rotations of the classes of links that only translate against each other, rad.
    pub class_angles: Vec<f64>,
    /// Values of all slides, m.
    pub slides: Vec<f64>,
    /// Positions of all joints, m.
    pub joints: Vec<[f64; 2]>,
    /// Angles of all links, rad, in (−π, π].
    pub angles: Vec<f64>,
    /// Whether two assemblies meet here.
    pub is_double: bool,
}

/// A path of the search that did not lead to its own assembly.
#[derive(Debug, Clone, PartialEq)]
pub struct PathFailure {
    /// The group, by class and links.
    pub group: String,
    /// How it ended.
    pub end: PathEnd,
}

impl fmt::Display for PathFailure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "group {}: {}", self.group, self.end)
    }
}

/// Every assembly of a design at a coordinate.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Assemblies {
    /// The real assemblies.
    pub found: Vec<Assembly>,
    /// The number of complex assemblies of each group above class II, with dimensions that are not
    /// special.
    pub complex_counts: Vec<usize>,
    /// Paths that did not lead to an assembly.
    pub failures: Vec<PathFailure>,
}

impl Assemblies {
    /// Whether no assembly can be missing: the failures, if any, are at infinity or where two
    /// assemblies meet.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        let loses_none =
            |failure: &PathFailure| matches!(failure.end, PathEnd::AtInfinity | PathEnd::Multiple);
        self.failures.iter().all(loses_none)
    }
}
