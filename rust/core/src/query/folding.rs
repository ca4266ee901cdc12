//! The dyad, group or length that folds at an end of a branch.

use crate::branch::design::Design;
use crate::plan::plan::{Plan, Step};
use crate::state::state::{Context, State};

/// Where conditions are compared, before the end by these parts of the way from the drawing: toward a
/// fold the square of a condition grows as the inverse of the distance, there a hundredfold.
const BEFORE_FOLD: [f64; 2] = [1.0e-5, 1.0e-7];

/// The step of the plan that ends the branch at a coordinate (scaled): of all dyads, groups and lengths
/// the one whose own condition grows the most toward it, for any order of the steps.
pub(crate) fn folding_step(design: &Design<'_>, state: &mut State, end: f64) -> Option<usize> {
    let [q0] = design.q0[..] else { return None };
    let [far, near] = BEFORE_FOLD.map(|part| {
        let cx = solve(design, state, end + part * (q0 - end));
        conditions2(state, &cx)
    });
    let growth = far.iter().zip(&near).enumerate().map(|(step, (far, near))| (step, near / far));
    let finite = growth.filter(|(_, growth)| growth.is_finite());
    finite.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(step, _)| step)
}

/// The index in [`Mechanism::fold_names`](crate::Mechanism::fold_names) of what a step solves; `None` for
/// two guides.
pub(crate) fn fold_of(plan: &Plan, step: usize) -> Option<usize> {
    match &plan.steps[step] {
        Step::Dyad(dyad) => dyad.sign,
        Step::Group(group) => Some(plan.signs() + group.index),
        &Step::Length { slide } => Some(plan.end_of_length(slide)),
        _ => None,
    }
}

/// Solves a position of the branch.
pub(super) fn solve<'d>(design: &'d Design<'_>, state: &mut State, q: f64) -> Context<'d> {
    let branch = &design.branch;
    design.guess(0, state, branch, &branch.locate(q));
    let tracing = design.context(design.tracing_derivatives());
    let cx = Context { signs: branch.signs(q), ..tracing };
    state.solve(&cx, &[q]);
    cx
}

/// Squares of the conditions of all steps on their own; for a length the inverse of its square. NaN for
/// steps without a condition.
fn conditions2(state: &State, cx: &Context<'_>) -> Vec<f64> {
    let condition2 = |(index, step): (usize, &Step)| match step {
        &Step::Length { slide } => {
            let length = state.pose.slides[slide * state.len][0];
            1.0 / (length * length)
        }
        _ => state.own_condition2(cx, index).unwrap_or(f64::NAN),
    };
    cx.plan.steps.iter().enumerate().map(condition2).collect()
}
