//! One assembly of a mechanism, and all of them at a position.

use std::f64::consts::{PI, TAU};
use std::fmt;

use super::solutions::PathEnd;
use crate::branch::design::Design;
use crate::state::state::State;
use crate::structure::closure::point_of_joint;

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

impl Assembly {
    /// The position of a design that was just solved with these signs at a (scaled) coordinate.
    pub(crate) fn of(
        design: &Design<'_>,
        state: &State,
        signs: &[f64],
        scaled: &[f64],
        is_double: bool,
    ) -> Self {
        let (mechanism, constants) = (design.mechanism, &design.constants);
        let joint = |joint: usize| {
            let point = state.pose.points[point_of_joint(joint) * state.len][0];
            let [x, y] = constants.origin;
            [point.x * constants.scale + x, point.y * constants.scale + y]
        };
        let slides = state.pose.slides.chunks_exact(state.len);
        let angle = |link: usize| {
            let rotation = &mechanism.plan().rotation[link];
            let turns = rotation.turns.iter().zip(scaled);
            let driven: f64 = turns.map(|(&turns, q)| f64::from(turns) * q).sum();
            let class = state.pose.class[rotation.class][0].angle();
            let angle = class + constants.offset[link] + driven;
            angle - TAU * ((angle - PI) / TAU).ceil()
        };
        Self {
            signs: signs.iter().map(|&sign| if sign > 0.0 { 1 } else { -1 }).collect(),
            class_angles: state.pose.class.iter().map(|unit| unit[0].angle()).collect(),
            slides: slides.map(|jet| jet[0][0] * constants.scale).collect(),
            joints: (0..mechanism.linkage().joints.len()).map(joint).collect(),
            angles: (0..mechanism.linkage().links.len()).map(angle).collect(),
            is_double,
        }
    }
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
