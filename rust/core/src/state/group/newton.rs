//! Newton's iteration for groups above class II.
//!
//! The unknown rotations are unit vectors, which every step turns. The equations are polynomials in
//! them and in the slides, so the Jacobian is exact. The iteration starts from the rotations and
//! slides that the caller has set, which the branch predicts. Each Jacobian serves two steps, which
//! together converge to the third order (Potra & Pták, Nondiscrete Induction and Iterative
//! Processes, 1984). All positions iterate together; each lane stops when its own steps converge.

use super::turn::turned;
use crate::math::inverse::invert;
use crate::math::lanes::{Mask, Real};
use crate::math::tolerance::{
    NEWTON_FROZEN_MAX2, NEWTON_LAST_STEP, NEWTON_MAX_ROUNDS, NEWTON_MAX_STEP, NEWTON_TOLERANCE,
};
use crate::math::vector::Vector;
use crate::plan::dyad::Unknown;
use crate::plan::group::{Chord, Group, Loop};
use crate::plan::plan::EdgeSlide;
use crate::state::state::{Context, State};
use crate::state::status::{FLAT2, Fault, Status};

impl<R: Real, const G: usize> State<R, G> {
    /// Solves the group (step `index`) from the present values of its unknowns; skips lanes that
    /// are already in `needs_scalar`.
    #[inline(always)]
    pub(crate) fn solve_group(&mut self, cx: &Context<'_>, group: &Group, index: usize) {
        if let (Some(binary), 1) = (&group.binary_loops, cx.derivatives.drivers) {
            self.solve_binary_loops(cx, group, binary, index);
            return;
        }
        let mut matrix = std::mem::take(&mut self.work.matrix);
        let mut work = NewtonState::<R, G>::new(self.conditions.needs_scalar);
        for unused in work.done.iter_mut().skip(self.groups) {
            *unused = R::Mask::NONE.not();
        }
        let skipped = work.done;
        self.prepare_group(cx, group);
        self.update_loops(cx, group);
        for round in 0..NEWTON_MAX_ROUNDS {
            if all(&work.done) {
                break;
            }
            self.jacobian(cx, group, &mut matrix);
            let determinants = invert(&mut matrix, group.rows);
            for g in 0..G {
                let last = &mut self.work.det_sign[group.index][g];
                *last = R::select(work.done[g], *last, determinants[g]);
            }
            work.update_inverse_size(cx, group, &matrix);
            let first_size = self.step(group, &matrix, &work.done);
            let skip = work.skip_second_step(first_size);
            self.update_loops(cx, group);
            let mut second_size = [R::ZERO; G];
            if !all(&skip) {
                self.group_residual(cx, group, 0, &mut matrix[2 * group.rows * group.rows..]);
                second_size = self.step(group, &matrix, &skip);
                self.update_loops(cx, group);
            }
            work.record_steps(first_size, second_size, &skip, round == 0);
        }
        for g in 0..G {
            self.conditions.needs_scalar[g] =
                self.conditions.needs_scalar[g].or(work.done[g].not());
            self.work.first_step[g] = self.work.first_step[g].max(work.first_step[g]);
            self.work.later_steps[g] = self.work.later_steps[g].max(work.later_steps[g]);
        }
        if R::LANES == 1 && !all(&work.done) {
            self.fault = Some(Fault::NotConverged { step: index });
            self.status = Status::NotConverged;
        } else {
            for g in 0..G {
                self.update_condition(g, cx, group, index, work.inverse_size2[g]);
            }
            self.back_substitute(cx, group, 0);
            if self.len > 1 && !all(&skipped) {
                self.jacobian(cx, group, &mut matrix);
                self.work.determinants[group.index] = invert(&mut matrix, group.rows);
                self.group_analogues(cx, group, &mut matrix);
            }
        }
        self.work.matrix = matrix;
    }

    /// Sets what is constant during the iteration.
    #[inline(always)]
    fn prepare_group(&mut self, cx: &Context<'_>, group: &Group) {
        for (i, l) in group.loops.iter().enumerate() {
            if l.chord == Chord::Whole {
                continue;
            }
            let e = group.edges[l.edge].edge;
            if let EdgeSlide::Driver { .. } = cx.plan.edges[e].along {
                for g in 0..G {
                    self.work.inv_length[i][g] = R::ONE / self.local(g, cx, e, 0).norm();
                }
            } else {
                self.work.inv_length[i] = [R::splat(1.0 / cx.constants.edge_vector[e].norm()); G];
            }
        }
    }

    /// Updates edges and chords to the present unknowns.
    #[inline(always)]
    fn update_loops(&mut self, cx: &Context<'_>, group: &Group) {
        for (i, &unknown) in group.unknowns.iter().enumerate() {
            if let Unknown::Class(class) = unknown {
                self.set_orientations(cx, &group.orientations[i], class);
            }
        }
        self.update_edge_vectors(cx, group, 0);
    }

    /// Takes a Newton step with the present inverse on the lanes that are not done; returns the
    /// largest change of an unknown before it is limited.
    #[inline(always)]
    fn step(&mut self, group: &Group, matrix: &[[R; G]], done: &[R::Mask; G]) -> [R; G] {
        let (len, n) = (self.len, group.rows);
        let longest = R::splat(NEWTON_MAX_STEP);
        let mut largest = [R::ZERO; G];
        let residual = &matrix[2 * n * n..][..n];
        for (i, &unknown) in group.unknowns.iter().enumerate() {
            let row = &matrix[i * 2 * n + n..][..n];
            for g in 0..G {
                let mut step = R::ZERO;
                for (inverse, residual) in row.iter().zip(residual) {
                    step = step - inverse[g] * residual[g];
                }
                let size = step.abs();
                // NaN must count as large, so that it does not look converged.
                largest[g] = R::select(size.le(largest[g]), largest[g], size);
                let step = R::select(done[g], R::ZERO, step.max(-longest).min(longest));
                match unknown {
                    Unknown::Class(class) => {
                        let old = self.pose.class[class][g];
                        let new = turned(old, step);
                        let x = R::select(done[g], old.x, new.x);
                        self.pose.class[class][g] =
                            Vector::new(x, R::select(done[g], old.y, new.y));
                    }
                    Unknown::Slide(slide) => {
                        let value = &mut self.pose.slides[slide * len][g];
                        *value += step;
                    }
                }
            }
        }
        largest
    }

    /// Sets the condition of the group from the size of its inverse, and updates that of the
    /// position.
    #[inline(always)]
    pub(crate) fn update_condition(
        &mut self,
        g: usize,
        cx: &Context<'_>,
        group: &Group,
        index: usize,
        inverse_size2: R,
    ) {
        let mut upstream2 = R::ONE;
        for l in &group.loops {
            for point in [l.start, l.end] {
                upstream2 = upstream2.max(self.conditions.of_point[point][g]);
            }
        }
        if group.binary_loops.is_none() {
            upstream2 = upstream2.max(self.incoming_condition2(g, cx, group));
        }
        let condition = upstream2 * inverse_size2.max(R::ONE);
        // NaN must count as large, so that it is not taken for well-conditioned.
        let is_less = condition.le(self.conditions.greatest[g]);
        self.conditions.greatest[g] = R::select(is_less, self.conditions.greatest[g], condition);
        for unknown in group.all_unknowns() {
            match unknown {
                Unknown::Class(class) => self.conditions.of_class[class][g] = condition,
                Unknown::Slide(slide) => self.conditions.of_slide[slide][g] = condition,
            }
        }
        let flat = (condition * R::splat(FLAT2)).le(upstream2).not();
        self.conditions.needs_scalar[g] = self.conditions.needs_scalar[g].or(flat);
        if R::LANES == 1 && flat.any() {
            self.fault.get_or_insert(Fault::Singular { step: index });
            self.status = Status::Singular;
        }
    }

    /// Square of the condition of the rotations that earlier steps have found.
    #[inline(always)]
    fn incoming_condition2(&self, g: usize, cx: &Context<'_>, group: &Group) -> R {
        let mut upstream2 = R::ONE;
        for edge in group.edges.iter().filter(|edge| edge.turns.is_none()) {
            let class = cx.plan.class_of(edge.edge);
            let is_chord_of = |l: &Loop| l.chord == Chord::Length { class };
            if !group.loops.iter().any(is_chord_of) {
                upstream2 = upstream2.max(self.conditions.of_class[class][g]);
            }
        }
        upstream2
    }
}

/// Progress of the iteration.
pub(crate) struct NewtonState<R: Real, const G: usize> {
    /// Lanes that have converged, and those that are skipped.
    pub done: [R::Mask; G],
    /// Square of the weighted norm of the last inverse.
    pub inverse_size2: [R; G],
    /// Largest change of an unknown in the first step (rad, or relative to the scale).
    pub first_step: [R; G],
    /// Sum of the largest changes in the later steps.
    pub later_steps: [R; G],
}

impl<R: Real, const G: usize> NewtonState<R, G> {
    #[inline(always)]
    pub(crate) fn new(done: [R::Mask; G]) -> Self {
        Self {
            done,
            inverse_size2: [R::ONE; G],
            first_step: [R::ZERO; G],
            later_steps: [R::ZERO; G],
        }
    }

    /// Computes and records the size of the inverse.
    #[inline(always)]
    fn update_inverse_size(&mut self, cx: &Context<'_>, group: &Group, matrix: &[[R; G]]) {
        let n = group.rows;
        let mut inverse_size2 = [R::ZERO; G];
        for (i, &unknown) in group.unknowns.iter().enumerate() {
            // Weight a rotation by the greatest arm that turns with it.
            let max_arm2 = match unknown {
                Unknown::Class(class) => R::splat(cx.constants.max_arm2[class]),
                Unknown::Slide(_) => R::ONE,
            };
            let row = &matrix[i * 2 * n + n..][..n];
            for g in 0..G {
                let mut sum = R::ZERO;
                for entry in row {
                    sum += entry[g] * entry[g];
                }
                inverse_size2[g] += max_arm2 * sum;
            }
        }
        self.record_inverse_size(inverse_size2);
    }

    /// Records the size of the inverse on the lanes that are not done.
    #[inline(always)]
    pub(crate) fn record_inverse_size(&mut self, inverse_size2: [R; G]) {
        for g in 0..G {
            self.inverse_size2[g] =
                R::select(self.done[g], self.inverse_size2[g], inverse_size2[g]);
        }
    }

    /// Lanes that skip the second (frozen-Jacobian) step: converged, or about to converge with the
    /// first, or the first was so long that the Jacobian has changed (near a fold a second step
    /// would lead to the other assembly).
    #[inline(always)]
    pub(crate) fn skip_second_step(&self, first_size: [R; G]) -> [R::Mask; G] {
        let mut skip = self.done;
        for g in 0..G {
            let relative2 = first_size[g] * first_size[g] * self.inverse_size2[g];
            let curved = relative2.lt(R::splat(NEWTON_FROZEN_MAX2)).not();
            skip[g] = skip[g].or(curved).or(self.will_converge(g, first_size[g]));
        }
        skip
    }

    /// Whether one step is enough: the remaining error is the square of the step times the
    /// condition (Kantorovich's theorem).
    #[inline(always)]
    fn will_converge(&self, g: usize, first_size: R) -> R::Mask {
        let error = first_size * first_size;
        (error * error * self.inverse_size2[g].max(R::ONE))
            .lt(R::splat(NEWTON_TOLERANCE * NEWTON_TOLERANCE))
    }

    /// Records the two steps of a round, and the lanes that have converged.
    #[inline(always)]
    pub(crate) fn record_steps(
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
            // The remaining error is about the product of the two steps.
            let error = first_size[g] * second_size;
            let settled = skip[g].not().and(error.lt(R::splat(NEWTON_TOLERANCE)));
            let is_short = first_size[g]
                .lt(R::splat(NEWTON_LAST_STEP))
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
