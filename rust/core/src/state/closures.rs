//! The closed paths of a step, as vector sums: what its equations and their transpose need.

use crate::plan::dyad::{Dyad, Unknown};
use crate::plan::group::Group;
use crate::plan::plan::Step;

/// A closed path: `P_plus − P_minus + Σ ±edges = 0`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ClosedPath {
    /// Point where it ends.
    pub plus: usize,
    /// Point where it starts.
    pub minus: usize,
    /// Edges, each with its sign.
    pub edges: Vec<(usize, f64)>,
}

/// The closed paths of a step (two equations each) and as many unknowns as equations.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Closures {
    pub unknowns: Vec<Unknown>,
    pub paths: Vec<ClosedPath>,
}

pub(crate) fn signed(backward: bool) -> f64 {
    if backward { -1.0 } else { 1.0 }
}

impl Closures {
    /// The closures of a step that solves any.
    pub(crate) fn of_step(step: &Step) -> Option<Self> {
        match step {
            Step::Dyad(dyad) => Some(Self::of_dyad(dyad)),
            Step::Group(group) => Some(Self::of_group(group)),
            Step::Place { .. } | Step::Redundant(_) | Step::Length { .. } => None,
        }
    }

    pub(crate) fn of_dyad(dyad: &Dyad) -> Self {
        let edges = dyad.path.iter().map(|term| (term.edge, signed(term.backward))).collect();
        let path = ClosedPath { plus: dyad.start, minus: dyad.end, edges };
        Self { unknowns: dyad.unknowns.to_vec(), paths: vec![path] }
    }

    pub(crate) fn of_group(group: &Group) -> Self {
        let edge = |i: usize| group.edges[i].edge;
        let paths = group.loops.iter().map(|l| {
            let path =
                l.path.iter().map(|path_edge| (edge(path_edge.edge), signed(path_edge.backward)));
            let edges = path.chain([(edge(l.edge), -1.0)]).collect();
            ClosedPath { plus: l.end, minus: l.start, edges }
        });
        Self { unknowns: group.all_unknowns().collect(), paths: paths.collect() }
    }
}
