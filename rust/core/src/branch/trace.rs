//! Traces the branch of a design: in closed form, by knots in lanes, or knot by knot.

use super::branch::Branch;
use super::crank_angles::find_references;
use super::design::Design;
use super::driven_chord::chord_paths;
use super::knot::InitialGuess;
use super::lanes::grid::Grid;
use super::lanes::reference_branch::ReferenceBranch;
use super::lanes::uniform::{Traced, UniformTracer};
use crate::math::angle::Reference;
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::Real;
use crate::state::kernel::baseline::Baseline;
use crate::state::kernel::{BLOCK, Level};
use crate::state::state::Context;

/// Work space for tracing outside of batches.
pub(super) type BaselineTracer = UniformTracer<<Baseline as Level>::Register, { BLOCK / 2 }>;

impl Design<'_> {
    /// Traces the branch without solving a position, if all dyads are on cranks and the ground.
    /// If `references` are given, sets them instead of angles at knots.
    #[inline(always)]
    pub(crate) fn trace_in_closed_form(
        &mut self,
        classes: &[usize],
        references: Option<&mut [Reference]>,
    ) -> Traced {
        self.settled.clear();
        let plan = self.mechanism.plan();
        let several = self.q0.len() > 1;
        if !(self.closed_forms && (several || self.has_one_rotary_driver())) {
            self.settled.resize(self.crank_dyads.len(), false);
            return Traced::No;
        }
        for (dyad, on_crank) in plan.dyads().zip(&self.crank_dyads) {
            let fixed = several && dyad.sign.is_none_or(|sign| !self.constants.may_change[sign]);
            let keeps_sign = || on_crank.is_some_and(|dyad| dyad.keeps_sign(&self.constants));
            let is_length = dyad.is_length && (several || classes.is_empty());
            self.settled.push(fixed || is_length || keeps_sign());
        }
        if !self.settled.iter().all(|&settled| settled) {
            return Traced::No;
        }
        let start = &self.mechanism.class_angle;
        if several && !classes.is_empty() {
            let Some(dyads) = &self.driven_dyads else { return Traced::No };
            let paths = chord_paths(&self.tracing_context(), dyads, (&self.q0, start), classes);
            let Some(paths) = paths else { return Traced::No };
            self.chord_paths = paths;
        }
        if classes.is_empty() || several {
            self.set_constant_signs();
            return Traced::Whole;
        }
        let Some(references) = references else { return Traced::No };
        let cx = self.tracing_context();
        if self.crank_dyads.len() > 1
            || !find_references(&cx, self.q0[0], start, classes, references)
        {
            return Traced::No;
        }
        self.branch.set_constant_signs(start.len(), &self.signs);
        Traced::Surveyed
    }

    /// Whether the traced branch serves these coordinates, of one driver or all, without change points.
    pub(crate) fn is_smooth(&self, q: &[f64]) -> bool {
        let branch = &self.branch;
        branch.is_whole()
            || branch.changes.is_empty()
                && self.q0.len() == 1
                && q.iter().all(|q| branch.covers(q * self.units.coordinate[0]))
    }

    /// Whether the branch just traced serves all coordinates with the drawing's signs.
    pub(crate) fn has_constant_signs(&self) -> bool {
        let serves_all = self.serves_all || self.has_one_rotary_driver();
        let branch = &self.branch;
        self.closed_forms && serves_all && branch.is_whole() && branch.has_constant_signs()
    }

    /// Makes the branch one without angles, with the drawing's signs everywhere.
    pub(crate) fn set_constant_signs(&mut self) {
        self.branch.set_constant_signs(self.mechanism.class_angle.len(), &self.signs);
        self.serves_all = self.q0.len() > 1;
    }

    /// The context for solving knots.
    fn tracing_context(&self) -> Context<'_> {
        Context { tape: &self.tracing_tape, ..self.context(&self.tracing_derivatives) }
    }

    /// Traces the branch by knots in lanes, with the angles of `classes`, where
    /// [`Self::trace_in_closed_form`] cannot. If `references` are given and the design needs no checks, sets
    /// them instead of angles at knots (see [`UniformTracer::survey`]). `range`: values of a driven
    /// slide (m) to trace over.
    #[inline(always)]
    pub(crate) fn trace_in_lanes<L: Level, const G: usize>(
        &mut self,
        uniform: &mut UniformTracer<L::Register, G>,
        classes: &[usize],
        references: Option<&mut [Reference]>,
        range: [f64; 2],
    ) -> Traced {
        if self.mechanism.plan().has_passive_lengths() {
            return Traced::No;
        }
        let Some(grid) = self.grid(range) else { return Traced::No };
        let mut goes_wide = false;
        if self.has_groups() {
            let Some(reference) = uniform.reference(|| self.reference_branch()) else {
                return Traced::No;
            };
            goes_wide = reference.goes_wide;
        }
        let start = &self.mechanism.class_angle[..];
        let cx = Context {
            plan: self.mechanism.plan(),
            constants: &self.constants,
            derivatives: &self.tracing_derivatives,
            signs: &self.signs,
            tape: &self.tracing_tape,
            cancel: self.cancel,
        };
        let (branch, tracer, settled) =
            (&mut self.branch, self.lane_tracer.get_or_insert_default(), &self.settled);
        let with_angles = !classes.is_empty();
        let references = references.filter(|_| self.closed_forms && with_angles);
        let mut is_solved = false;
        let mut turns_fully = grid.is_turn && (with_angles || !self.closed_forms);
        if let Some(references) = references {
            uniform.solve_knots::<L>(&cx, grid, false);
            uniform.check_uncertain::<L>(&cx);
            let surveyed = uniform.survey(&cx, classes, start, references);
            // A survey solves closer scans in their place.
            is_solved = surveyed.is_some();
            if surveyed.is_none() && grid.is_turn {
                let angles = (classes, start);
                let surveyed =
                    tracer.survey::<L, G>(&cx, uniform, angles, settled, references, branch);
                let Some(surveyed) = surveyed else { return Traced::No };
                if surveyed != Traced::No {
                    return surveyed;
                }
            }
            if surveyed == Some(true) {
                branch.set_constant_signs(start.len(), cx.signs);
                return Traced::Surveyed;
            }
            turns_fully &= surveyed.is_some();
        }
        if goes_wide {
            uniform.solve_knots::<L>(&cx, Grid::wide_turn(grid.from), with_angles);
            if uniform.trace(&cx, classes, start, branch) {
                return Traced::Whole;
            }
        }
        let follows_slide = with_angles && !grid.is_turn;
        let up_and_down = if follows_slide { self.rays(range) } else { Some([grid, Grid::NONE]) };
        let Some(up_and_down) = up_and_down else { return Traced::No };
        let mut below = Branch::default();
        let (branch, tracer, settled) =
            (&mut self.branch, self.lane_tracer.get_or_insert_default(), &self.settled);
        branch.set_constant_signs(start.len(), cx.signs);
        for (path, branch) in up_and_down.into_iter().zip([&mut *branch, &mut below]) {
            if path.count == 0 {
                continue;
            }
            if !is_solved || path != grid {
                uniform.solve_knots::<L>(&cx, path, with_angles);
            }
            let traced = turns_fully && uniform.trace(&cx, classes, start, branch)
                || self.closed_forms
                    && tracer.trace::<L, G>(&cx, uniform, (classes, start), settled, branch);
            // Beyond a gap, angles depend on which islands the knots hit. A slide is then left to the
            // tracer, whose knots do not depend on the requested positions.
            if !traced || follows_slide && !branch.ends_once() {
                return Traced::No;
            }
        }
        branch.extend_down(below);
        Traced::Whole
    }

    /// Traces a turn by knots in lanes, outside of batches: compiled once, for any processor.
    #[inline(never)]
    pub(super) fn trace_in_baseline_lanes(
        &mut self,
        uniform: &mut BaselineTracer,
        classes: &[usize],
    ) -> Traced {
        self.trace_in_lanes::<Baseline, _>(uniform, classes, None, [f64::NAN; 2])
    }

    /// The grid of the knots; `range`: values of a driven slide, m.
    fn grid(&self, range: [f64; 2]) -> Option<Grid> {
        match self.q0[..] {
            [q0] if self.has_one_rotary_driver() => Some(Grid::turn(q0)),
            [q0] if self.closed_forms => Grid::stretch(q0, self.with_drawing(range)),
            _ => None,
        }
    }

    /// The knots along a driven slide from the drawing's value, upward and downward.
    fn rays(&self, range: [f64; 2]) -> Option<[Grid; 2]> {
        let [low, high] = self.with_drawing(range);
        Some([Grid::ray(self.q0[0], high)?, Grid::ray(self.q0[0], low)?])
    }

    /// A range of a driven slide's values (m), scaled and widened to contain the drawing's.
    fn with_drawing(&self, range: [f64; 2]) -> [f64; 2] {
        let [low, high] = range.map(|q| q * self.units.coordinate[0]);
        [low.max(self.least_coordinate()).min(self.q0[0]), high.max(self.q0[0])]
    }

    /// The least coordinate of the driver that may be reached: 0 for a length.
    fn least_coordinate(&self) -> f64 {
        let is_length = self.mechanism.plan().driven_length().is_some();
        if is_length { 0.0 } else { f64::NEG_INFINITY }
    }

    /// The branch of the drawing, from which those of other designs start.
    #[cold]
    #[inline(never)]
    fn reference_branch<R: Real, const G: usize>(&self) -> Option<ReferenceBranch<R, G>> {
        let derivatives = DerivativeTables::new(1, 0);
        let mut drawing = Design::new(self.mechanism, &[], &derivatives);
        drawing.signs.clone_from(&self.signs);
        drawing.bind(self.mechanism.drawing());
        drawing.trace(&[]);
        let (plan, q0, scale) = (self.mechanism.plan(), drawing.q0[0], drawing.constants.scale);
        let mut reference = ReferenceBranch::new(plan, &drawing.branch, q0, scale)?;
        // Between knots farther apart the sign of a dyad might change unseen.
        if plan.signs() == 0 {
            let mut uniform: BaselineTracer = drawing.uniform_tracer();
            uniform.reference(|| ReferenceBranch::new(plan, &drawing.branch, q0, scale));
            let (start, cx) = (&self.mechanism.class_angle, drawing.tracing_context());
            uniform.solve_knots::<Baseline>(&cx, Grid::wide_turn(q0), false);
            reference.goes_wide = uniform.trace(&cx, &[], start, &mut Branch::default());
        }
        Some(reference)
    }

    /// Traces the branch over the coordinates `q` (all positions, rad or m), as a batch would.
    #[cold]
    #[inline(never)]
    pub(crate) fn trace(&mut self, q: &[f64]) {
        if self.closed_forms && self.has_one_rotary_driver() {
            let classes: Vec<usize> = (1..self.mechanism.class_angle.len()).collect();
            let mut uniform = self.uniform_tracer();
            let whole = self.trace_in_closed_form(&classes, None) == Traced::Whole
                || self.trace_in_baseline_lanes(&mut uniform, &classes) == Traced::Whole;
            if whole {
                return;
            }
        }
        self.trace_knot_by_knot(q);
    }

    /// The sum of all lengths, in sizes: slides do not go farther.
    pub(crate) fn reach(&self) -> f64 {
        let edges = self.mechanism.plan().edges.iter().zip(&self.constants.edge_vector);
        let paired = edges.filter(|(edge, _)| edge.paired).map(|(_, vector)| vector);
        let lengths = paired.chain(&self.constants.fixed).map(|vector| vector.norm());
        2.0 * lengths.sum::<f64>() + 1.0
    }

    /// Traces the branch over the coordinates `q`, one knot after another.
    #[cold]
    #[inline(never)]
    pub(crate) fn trace_knot_by_knot(&mut self, q: &[f64]) {
        if self.has_groups() {
            self.initial_unknowns = self.homotopy(&self.values);
        }
        let [start] = self.q0[..] else { return };
        let mut state = self.state(&self.tracing_derivatives);
        let cx = self.context(&self.tracing_derivatives);
        let angles = &self.mechanism.class_angle;
        let Ok(taylor) = &self.initial_unknowns else {
            self.branch = Branch::empty(angles.len(), &self.signs);
            return;
        };
        let from = &InitialGuess { angles, taylor };
        self.branch = if self.has_one_rotary_driver() {
            Branch::over_turns(&cx, &mut state, start, from)
        } else {
            let scaled =
                || q.iter().map(|q| q * self.units.coordinate[0]).filter(|q| q.is_finite());
            let low = scaled().fold(start, f64::min).max(self.least_coordinate());
            let range = [low, scaled().fold(start, f64::max)];
            Branch::over_range(&cx, &mut state, start, range, self.reach(), from)
        };
    }

    /// The signs at the drawing that lead straight to the given signs at `q` (scaled), found by
    /// tracing backward.
    pub(crate) fn signs_at_drawing(&self, signs: &[f64], q: &[f64]) -> Vec<i8> {
        let cx = Context { signs, ..self.context(&self.tracing_derivatives) };
        let angles = &self.mechanism.class_angle;
        let mut state = self.state(&self.tracing_derivatives);
        let start = &InitialGuess { angles, taylor: &[] };
        let (branch, at) = Branch::along_segment(&cx, &mut state, q, &self.q0, start);
        branch.signs(at).iter().map(|&s| if s > 0.0 { 1 } else { -1 }).collect()
    }
}
