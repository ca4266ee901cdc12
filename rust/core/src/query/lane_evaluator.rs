//! Positions of one design side by side, each with the bits that the `Evaluator` finds alone.

use super::evaluator::{Evaluator, Position};
use crate::branch::design::Design;
use crate::math::lanes::{Mask, Real};
use crate::math::vector::Vector;
use crate::state::kernel::Level;
use crate::state::state::State;

/// A design with one driver that has the same signs everywhere, and work space for a position in each
/// lane.
pub(crate) struct LaneEvaluator<'d, 'm, R: Real> {
    design: &'d Design<'m>,
    state: State<R>,
}

impl<'d, 'm, R: Real> LaneEvaluator<'d, 'm, R> {
    /// `None` where a position is more than its closed forms: with several drivers, groups above class
    /// II, change points, or a branch that ends.
    pub(crate) fn new(evaluator: &'d Evaluator<'m>) -> Option<Self> {
        let design = evaluator.design();
        let branch = &design.branch;
        let is_plain = design.q0.len() == 1
            && design.closed_forms
            && branch.has_constant_signs()
            && branch.changes.is_empty()
            && branch.covered.is_none();
        if !is_plain {
            return None;
        }
        let mut state = State::new(design.mechanism.plan(), design.derivatives);
        design.prepare_lanes(&mut state);
        for (lanes, &sign) in state.pose.signs.iter_mut().zip(branch.signs(design.q0[0])) {
            lanes[0] = R::splat(sign);
        }
        Some(Self { design, state })
    }

    /// Solves at a coordinate in each lane, rad or m. Returns the lanes with a position whose condition is
    /// at most `most`; the `Evaluator` must look at the others.
    #[inline(always)]
    pub(crate) fn solve<L: Level<Register = R>>(&mut self, q: R, most: f64) -> R::Mask {
        let Self { design, state } = self;
        let plan = design.mechanism.plan();
        let scaled = q * R::splat(design.units.coordinate[0]);
        state.pose.q[0][0] = scaled;
        if plan.driven_slide(0).is_none() {
            state.pose.unit[0][0] = Vector::at_angle(scaled);
        }
        L::solve(state, &design.context(design.derivatives));
        let condition = state.conditions.greatest[0].sqrt();
        let is_fine = state.conditions.needs_scalar[0].not().and(condition.le(R::splat(most)));
        // A driven length is not negative.
        let is_length = plan.length_step(0).is_some();
        if is_length { is_fine.and(R::ZERO.le(scaled)) } else { is_fine }
    }

    /// The positions solved last.
    pub(crate) fn position(&self) -> Position<'_, R> {
        Position::of(self.design, &self.state)
    }
}
