//! Parameters of a group's forms at a position that is solved up to the group.

use super::forms::GroupForms;
use super::homotopy::Parameters;
use crate::math::vector::Vector;
use crate::plan::group::{Chord, Group};
use crate::plan::plan::EdgeSlide;
use crate::state::state::{Context, State};

/// The parameters; Y's are the conjugates of X's.
pub(super) fn parameters(
    forms: &GroupForms,
    group: &Group,
    cx: &Context<'_>,
    state: &State,
) -> Parameters {
    let turned = |index: usize, vector: Vector| {
        let edge = &group.edges[index];
        let plan_edge = &cx.plan.edges[edge.edge];
        let orientation = &cx.plan.orientations[plan_edge.orientation];
        let phase = if orientation.driven {
            state.pose.phase[plan_edge.orientation][0]
        } else {
            Vector::ONE
        };
        let is_bar =
            group.loops.iter().any(|l| l.edge == index && matches!(l.chord, Chord::Length { .. }));
        let is_known = edge.turns.is_none() && !is_bar;
        let class = if is_known { state.pose.class[plan_edge.class][0] } else { Vector::ONE };
        class * phase * vector
    };
    let with_conjugate = |x: Vector| [x, x.conj()];
    let constant = |index: usize| {
        let edge = group.edges[index].edge;
        let mut vector = cx.constants.edge_vector[edge];
        if let EdgeSlide::Driver { slide } = cx.plan.edges[edge].along {
            let value = state.pose.slides[slide * state.len][0];
            vector += cx.constants.guide[edge].scale(value);
        }
        turned(index, vector)
    };
    let guide = |index: usize| turned(index, cx.constants.guide[group.edges[index].edge]);
    let edges = 0..group.edges.len();
    let points = forms.points.iter().map(|&point| state.pose.points[point * state.len][0]);
    edges.clone().map(constant).chain(edges.map(guide)).chain(points).map(with_conjugate).collect()
}
