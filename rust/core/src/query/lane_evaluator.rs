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
    is_prepared: bool,
}

impl<'d, 'm, R: Real> LaneEvaluator<'d, 'm, R> {
    /// `None` where a position is more than its closed forms: with several drivers or a slide that
    /// drives, groups above class II, change points, or a branch that ends.
    pub(crate) fn new(evaluator: &'d Evaluator<'m>) -> Option<Self> {
        let design = evaluator.design();
        if !(design.has_one_rotary_driver() && design.has_constant_signs()) {
            return None;
        }
        let state = State::new(design.mechanism.plan(), design.derivatives);
        Some(Self { design, state, is_prepared: false })
    }

    /// Sets what all positions share. Not in `new`, which is not compiled for the level's instructions.
    #[inline(always)]
    fn prepare(&mut self) {
        let Self { design, state, is_prepared } = self;
        design.prepare_lanes(state);
        let signs = design.branch.signs(design.q0[0]);
        for (lanes, &sign) in state.pose.signs.iter_mut().zip(signs) {
            lanes[0] = R::splat(sign);
        }
        *is_prepared = true;
    }

    /// Solves at a coordinate in each lane, rad. Returns the lanes with a position whose condition is
    /// at most `most`, and the conditions; the `Evaluator` must look at the others.
    #[inline(always)]
    pub(crate) fn solve<L: Level<Register = R>>(&mut self, q: R, most: f64) -> (R::Mask, R) {
        if !self.is_prepared {
            self.prepare();
        }
        let Self { design, state, .. } = self;
        let scaled = q * R::splat(design.units.coordinate[0]);
        state.pose.q[0][0] = scaled;
        state.pose.unit[0][0] = Vector::at_angle(scaled);
        L::solve(state, &design.context(design.derivatives));
        let condition = state.conditions.greatest[0].sqrt();
        let is_solved = state.conditions.needs_scalar[0].not();
        (is_solved.and(condition.le(R::splat(most))), condition)
    }

    /// The positions solved last.
    pub(crate) fn position(&self) -> Position<'_, R> {
        Position::of(self.design, &self.state)
    }
}
