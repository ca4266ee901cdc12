//! Groups above class II at several positions: the iteration from their present unknowns, then their
//! conditions and analogues.

use super::equations::GroupEquations;
use super::newton::{NewtonState, iterate};
use crate::math::inverse::invert;
use crate::math::lanes::{Mask, Real};
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
        match &group.binary_loops {
            Some(binary) if cx.derivatives.drivers == 1 => match binary.classes.len() {
                2 => self.solve_binary_loops::<2>(cx, group, binary, index),
                _ => self.solve_binary_loops::<3>(cx, group, binary, index),
            },
            _ => self.solve_any_group(cx, group, index),
        }
    }

    /// Solves a group of any links and joints, all registers together.
    #[inline(always)]
    fn solve_any_group(&mut self, cx: &Context<'_>, group: &Group, index: usize) {
        let mut skipped = self.conditions.needs_scalar;
        for unused in skipped.iter_mut().skip(self.groups) {
            *unused = R::Mask::NONE.not();
        }
        let matrix = std::mem::take(&mut self.work.matrix);
        let determinants = self.work.det_sign[group.index];
        self.prepare_group(cx, group);
        let mut equations = GroupEquations { state: self, cx, group, matrix };
        let newton = iterate(&mut equations, skipped, determinants);
        let mut matrix = equations.matrix;
        for g in 0..G {
            self.record_iteration(g, &newton, g, group);
        }
        if R::LANES == 1 && !newton.done.iter().all(|done| done.all()) {
            self.fault = Some(Fault::NotConverged { step: index });
            self.status = Status::NotConverged;
        } else {
            for g in 0..G {
                self.update_condition(g, cx, group, index, newton.inverse_size2[g]);
            }
            self.back_substitute(cx, group, 0);
            if self.len > 1 && !skipped.iter().all(|skipped| skipped.all()) {
                self.jacobian(group, &mut matrix);
                self.work.determinants[group.index] = invert(&mut matrix, group.rows);
                self.group_analogues(cx, group, &mut matrix);
            }
        }
        self.work.matrix = matrix;
    }

    /// Keeps in register `g` the results of the iteration of a group in its register `register`.
    #[inline(always)]
    pub(super) fn record_iteration<const H: usize>(
        &mut self,
        g: usize,
        newton: &NewtonState<R, H>,
        register: usize,
        group: &Group,
    ) {
        self.work.det_sign[group.index][g] = newton.determinants[register];
        let needs_scalar = &mut self.conditions.needs_scalar[g];
        *needs_scalar = needs_scalar.or(newton.done[register].not());
        self.work.first_step[g] = self.work.first_step[g].max(newton.first_step[register]);
        self.work.later_steps[g] = self.work.later_steps[g].max(newton.later_steps[register]);
    }

    /// Sets the constants of the iteration.
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
        if let Some(binary) = &group.binary_loops {
            for &class in binary.classes.iter().chain(&binary.bar_classes) {
                self.conditions.of_class[class][g] = condition;
            }
        } else {
            for unknown in group.all_unknowns() {
                match unknown {
                    Unknown::Class(class) => self.conditions.of_class[class][g] = condition,
                    Unknown::Slide(slide) => self.conditions.of_slide[slide][g] = condition,
                }
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
