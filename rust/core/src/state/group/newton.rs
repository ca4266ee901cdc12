//! Newton's iteration for groups above class II.
//!
//! The unknown rotations are unit vectors, which every step turns. The equations are polynomials in
//! them and in the slides, so the Jacobian is exact. The iteration starts from the rotations and
//! slides that the caller has set, which the branch predicts. Each Jacobian serves two steps, which
//! together converge to the third order (Potra & Pták, Nondiscrete Induction and Iterative
//! Processes, 1984). All positions iterate together; each lane stops when its own steps converge.

use crate::math::lanes::{Mask, Real};
use crate::math::tolerance::{
    NEWTON_FROZEN_MAX2, NEWTON_LAST_STEP, NEWTON_MAX_ROUNDS, NEWTON_TOLERANCE,
};

/// The equations of a group at `G` registers of positions, as the iteration needs them.
pub(super) trait Equations<R: Real, const G: usize> {
    /// Updates what depends on the unknowns.
    fn update(&mut self);
    /// Inverts the Jacobian; returns its determinants.
    fn invert(&mut self) -> [R; G];
    /// Square of the norm of the inverse, each rotation weighted by the greatest arm that turns with
    /// it.
    fn inverse_size2(&self) -> [R; G];
    /// Takes a Newton step with the present inverse on the lanes that are not done; returns the
    /// largest change of an unknown before it is limited.
    fn step(&mut self, done: &[R::Mask; G]) -> [R; G];
    /// See [`crate::plan::curvature::curvature`].
    fn curvature(&self) -> R;
}

/// Iterates from the present unknowns, on the lanes that are not `skipped`. `determinants`: what the
/// other lanes keep.
#[inline(always)]
pub(super) fn iterate<R: Real, const G: usize>(
    equations: &mut impl Equations<R, G>,
    skipped: [R::Mask; G],
    determinants: [R; G],
) -> NewtonState<R, G> {
    let mut work = NewtonState::new(skipped, determinants, equations.curvature());
    equations.update();
    for round in 0..NEWTON_MAX_ROUNDS {
        if all(&work.done) {
            break;
        }
        let determinants = equations.invert();
        work.record_inverse(determinants, equations.inverse_size2());
        let first_size = equations.step(&work.done);
        let skip = work.skip_second_step(first_size);
        equations.update();
        let mut second_size = [R::ZERO; G];
        if !all(&skip) {
            second_size = equations.step(&skip);
            equations.update();
        }
        work.record_steps(first_size, second_size, &skip, round == 0);
    }
    work
}

/// Progress of the iteration.
pub(crate) struct NewtonState<R: Real, const G: usize> {
    /// Lanes that have converged, and those that are skipped.
    pub done: [R::Mask; G],
    /// Determinant of the last Jacobian.
    pub determinants: [R; G],
    /// Square of the weighted norm of its inverse.
    pub inverse_size2: [R; G],
    /// See [`Equations::curvature`].
    curvature: R,
    /// Largest change of an unknown in the first step (rad, or relative to the scale).
    pub first_step: [R; G],
    /// Sum of the largest changes in the later steps.
    pub later_steps: [R; G],
}

impl<R: Real, const G: usize> NewtonState<R, G> {
    #[inline(always)]
    fn new(done: [R::Mask; G], determinants: [R; G], curvature: R) -> Self {
        Self {
            done,
            determinants,
            inverse_size2: [R::ONE; G],
            curvature,
            first_step: [R::ZERO; G],
            later_steps: [R::ZERO; G],
        }
    }

    /// Records determinant and size of the inverse on the lanes that are not done.
    #[inline(always)]
    fn record_inverse(&mut self, determinants: [R; G], inverse_size2: [R; G]) {
        for g in 0..G {
            let done = self.done[g];
            self.determinants[g] = R::select(done, self.determinants[g], determinants[g]);
            self.inverse_size2[g] = R::select(done, self.inverse_size2[g], inverse_size2[g]);
        }
    }

    /// Lanes that skip the second (frozen-Jacobian) step: converged, or about to converge with the
    /// first, or the first was so long that the Jacobian has changed (near a fold a second step
    /// would lead to the other assembly).
    #[inline(always)]
    fn skip_second_step(&self, first_size: [R; G]) -> [R::Mask; G] {
        let mut skip = self.done;
        for g in 0..G {
            let relative2 = first_size[g] * first_size[g] * self.inverse_size2[g];
            let curved = relative2.lt(R::splat(NEWTON_FROZEN_MAX2)).not();
            skip[g] = skip[g].or(curved).or(self.will_converge(g, first_size[g]));
        }
        skip
    }

    /// Whether one step is enough: the remaining error is the square of the step times the curvature
    /// and the condition (Kantorovich's theorem).
    #[inline(always)]
    fn will_converge(&self, g: usize, first_size: R) -> R::Mask {
        let error = first_size * first_size * self.curvature;
        (error * error * self.inverse_size2[g].max(R::ONE))
            .lt(R::splat(NEWTON_TOLERANCE * NEWTON_TOLERANCE))
    }

    /// Records the two steps of a round, and the lanes that have converged.
    #[inline(always)]
    fn record_steps(
        &mut self,
        first_size: [R; G],
        second_size: [R; G],
        skip: &[R::Mask; G],
        is_first: bool,
    ) {
        for g in 0..G {
            let done = self.done[g];
            let second_size = R::select(skip[g], R::ZERO, second_size[g]);
            let sum = if is_first {
                second_size
            } else {
                self.later_steps[g] + first_size[g] + second_size
            };
            self.later_steps[g] = R::select(done, self.later_steps[g], sum);
            if is_first {
                self.first_step[g] = R::select(done, self.first_step[g], first_size[g]);
            }
            // The remaining error is about the product of the two steps times the curvature.
            let bent = first_size[g] * self.curvature;
            let settled = skip[g].not().and((bent * second_size).lt(R::splat(NEWTON_TOLERANCE)));
            let is_short = (bent * first_size[g])
                .lt(R::splat(NEWTON_LAST_STEP * NEWTON_LAST_STEP))
                .or(self.will_converge(g, first_size[g]));
            self.done[g] = done.or(settled).or(is_short);
        }
    }
}

/// Whether all lanes of all registers are true; a closure over them would not be inlined.
#[inline(always)]
fn all<M: Mask>(masks: &[M]) -> bool {
    let mut all = true;
    for mask in masks {
        all &= mask.all();
    }
    all
}
