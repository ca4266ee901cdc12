//! Curvature of the equations of a group above class II.

use super::group::{Chord, Group};
use super::plan::{EdgeSlide, Plan};
use crate::math::vector::Vector;

/// The part of the square of a Newton step that remains in the equations, at least 1.
///
/// The edges of a loop's path turn the end of a bar across it, which lengthens it by half the square
/// of that over its own length: much, if the bar is short. (Bars that a driver lengthens have no
/// length of their own.)
pub(crate) fn curvature(plan: &Plan, group: &Group, edge_vectors: &[Vector]) -> f64 {
    let length = |edge: usize| edge_vectors[group.edges[edge].edge].norm();
    let mut greatest = 1.0_f64;
    for l in &group.loops {
        let along = plan.edges[group.edges[l.edge].edge].along;
        if matches!(l.chord, Chord::Length { .. }) && along == EdgeSlide::Nothing {
            let path: f64 = l.path.iter().map(|part| length(part.edge)).sum();
            greatest = greatest.max(0.5 * path * path / length(l.edge));
        }
    }
    greatest
}
