//! One design ready to be solved: its constants, its unit of length, its branch from the drawing.

use std::borrow::Cow;
use std::cell::RefCell;

use super::branch::{Branch, BranchLocation};
use super::change_interpolant::{ChangeInterpolant, ChangeWindow};
use super::crank_angles::find_references;
use super::crank_dyad::CrankDyad;
use super::knot::{ChangePoint, InitialGuess, Taylor2};
use super::lane_tracer::LaneTracer;
use super::uniform::{KNOTS, ReferenceBranch, Traced, UniformTracer};
use super::units::Units;
use crate::math::angle::Reference;
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::{Lanes, Real};
use crate::math::tolerance::{CHANGE_WIDTH, SMOOTH_CLOSURE};
use crate::math::vector::Vector;
use crate::plan::constants::DesignConstants;
use crate::plan::constants_rate::ConstantsRate;
use crate::plan::dyad::Unknown;
use crate::plan::mechanism::Mechanism;
use crate::plan::plan::{Plan, Step};
use crate::plan::tape::Tape;
use crate::state::kernel::Level;
use crate::state::kernel::portable::Portable;
use crate::state::state::{Context, State};
use crate::state::status::{Fault, Status};

/// A point on a branch.
pub(crate) struct BranchPoint<'a> {
    /// The branch.
    pub branch: Cow<'a, Branch>,
    /// The parameter there.
    pub at: f64,
}

/// Greatest distance (rad, or units of the scale) from the drawing to which several drivers are
/// followed: 1000 turns. The time for a position grows with the distance.
const MAX_DISTANCE: f64 = 1000.0 * std::f64::consts::TAU;

/// One design after another, in the requested assembly.
pub(crate) struct Design<'a> {
    pub mechanism: &'a Mechanism,
    pub constants: DesignConstants,
    pub units: Units,
    /// Tables of the requested order.
    pub derivatives: &'a DerivativeTables,
    /// Tables for tracing: of first order, or second with groups above class II.
    tracing_derivatives: DerivativeTables,
    /// The tape for tracing, which needs no points but those of dyads.
    tracing_tape: Tape,
    /// Dimensions of the present design.
    values: Vec<f64>,
    /// Unknowns of the groups at the drawing's coordinate; or the part of the path from the
    /// drawing's dimensions after which a group folds.
    pub(crate) initial_unknowns: Result<Vec<Taylor2>, f64>,
    signs: Vec<f64>,
    /// Scaled coordinates of the drawing.
    q0: Vec<f64>,
    /// The branch from the drawing, if one serves all positions.
    pub branch: Branch,
    /// Whether it does so with several drivers.
    pub(crate) serves_all: bool,
    /// Whether all steps have closed forms: then lanes close or not by the same bits as single
    /// positions. Groups iterate, and redundant links close within a tolerance.
    pub(crate) closed_forms: bool,
    /// For every dyad: where it is attached, if it is on a crank and the ground.
    crank_dyads: Vec<Option<CrankDyad>>,
    /// For every dyad of the present design, whether its sign is known to be constant.
    settled: Vec<bool>,
    lane_tracer: LaneTracer,
    /// Range around a change point within which the motion is interpolated.
    pub change_window: ChangeWindow,
    /// Interpolants in use, by their change point.
    interpolants: RefCell<Vec<(f64, Option<ChangeInterpolant>)>>,
}

impl<'a> Design<'a> {
    /// A design without dimensions yet.
    pub(crate) fn new(
        mechanism: &'a Mechanism,
        signs: &[i8],
        derivatives: &'a DerivativeTables,
    ) -> Self {
        // Groups are predicted with second derivatives.
        let order = if mechanism.plan().groups().next().is_some() { 2 } else { 1 };
        Self {
            mechanism,
            constants: DesignConstants::default(),
            units: Units::default(),
            derivatives,
            tracing_derivatives: DerivativeTables::new(mechanism.q0().len(), order),
            tracing_tape: Tape::for_dyads(mechanism.plan(), &vec![true; mechanism.plan().classes]),
            values: Vec::new(),
            initial_unknowns: Ok(Vec::new()),
            signs: signs.iter().map(|&s| f64::from(s)).collect(),
            q0: Vec::new(),
            branch: Branch::default(),
            serves_all: false,
            closed_forms: mechanism.plan().has_closed_forms(),
            crank_dyads: crank_dyads(mechanism.plan()),
            settled: Vec::new(),
            lane_tracer: LaneTracer::default(),
            change_window: ChangeWindow::SHORT,
            interpolants: RefCell::default(),
        }
    }

    /// Of all angles, only those of these classes will be asked for.
    pub(crate) fn trace_only(&mut self, classes: &[bool]) {
        if self.closed_forms {
            self.tracing_tape = Tape::for_dyads(self.mechanism.plan(), classes);
        }
    }

    /// Sets the dimensions; the branch is yet to be traced.
    pub(crate) fn bind(&mut self, values: &[f64]) {
        let mechanism = self.mechanism;
        self.interpolants.get_mut().clear();
        self.serves_all = false;
        self.constants.bind(mechanism.plan(), &mechanism.slots, values);
        self.units.set(mechanism, self.constants.scale, self.derivatives);
        self.q0.clear();
        self.q0.extend(mechanism.q0().iter().zip(&self.units.coordinate).map(|(q, unit)| q * unit));
        self.values.clear();
        self.values.extend_from_slice(values);
    }

    /// Rates of the fixed vectors by a dimension.
    pub(crate) fn rate(&self, index: usize) -> ConstantsRate {
        let mechanism = self.mechanism;
        ConstantsRate::new(mechanism.plan(), &mechanism.slots, &self.constants, &self.values, index)
    }

    /// The context of a position; its signs are those at the drawing.
    pub(crate) fn context<'b>(&'b self, derivatives: &'b DerivativeTables) -> Context<'b> {
        Context {
            plan: self.mechanism.plan(),
            constants: &self.constants,
            derivatives,
            signs: &self.signs,
            tape: &self.mechanism.plan().tape,
        }
    }

    /// Tables for tracing.
    pub(crate) fn tracing_derivatives(&self) -> &DerivativeTables {
        &self.tracing_derivatives
    }

    /// Coordinates in the design's own unit of length.
    pub(crate) fn scaled(&self, q: &[f64]) -> Vec<f64> {
        let units = self.units.coordinate.iter().cycle();
        q.iter().zip(units).map(|(q, unit)| q * unit).collect()
    }

    /// Work space of the order of `derivatives`.
    pub(crate) fn state(&self, derivatives: &DerivativeTables) -> State {
        let mut state = State::new(self.mechanism.plan(), derivatives);
        state.prepare(self.mechanism.plan(), &self.constants, derivatives);
        state
    }

    /// Work space for [`Design::trace_in_lanes`].
    pub(crate) fn uniform_tracer<R: Real, const G: usize>(&self) -> UniformTracer<R, G> {
        UniformTracer::new(self.mechanism.plan(), &self.tracing_derivatives)
    }

    /// Whether one branch serves all positions, and its driver is an angle.
    fn has_one_rotary_driver(&self) -> bool {
        self.q0.len() == 1 && self.mechanism.plan().driven_slide(0).is_none()
    }

    /// Sets the groups' unknowns to those of the branch at a location, as first guess of the
    /// iteration.
    #[inline(always)]
    pub(crate) fn guess<R: Real, const G: usize>(
        &self,
        g: usize,
        state: &mut State<R, G>,
        branch: &Branch,
        location: &BranchLocation<R>,
    ) {
        let plan = self.mechanism.plan();
        let count = plan.groups().map(|group| group.unknowns.len()).sum();
        let unknowns = plan.groups().flat_map(|group| &group.unknowns);
        for (index, &unknown) in unknowns.enumerate() {
            match unknown {
                Unknown::Class(class) => {
                    state.class[class][g] = branch.rotation(location, index, count);
                }
                Unknown::Slide(slide) => {
                    state.slides[slide * state.len][g] = branch.slide(location, index, count);
                }
            }
        }
    }

    /// Solves again a position that was not found or came out beyond a fold.
    #[cold]
    fn resolve_from_knot(&self, state: &mut State, q: &[f64], (branch, at): (&Branch, f64)) {
        let cx = self.context(&self.tracing_derivatives);
        if let [_] = *q {
            let Some(taylor) = branch.retrace(&cx, &mut self.state(&self.tracing_derivatives), at)
            else {
                // Too near the fold at the end of the branch to find the unknowns.
                state.set_lost();
                return;
            };
            let unknowns = self.mechanism.plan().groups().flat_map(|group| &group.unknowns);
            for (&unknown, value) in unknowns.zip(taylor) {
                match unknown {
                    Unknown::Class(class) => state.class[class][0] = Vector::at_angle(value),
                    Unknown::Slide(slide) => state.slides[slide * state.len][0] = value,
                }
            }
            state.solve(&Context { signs: branch.signs(at), ..self.context(self.derivatives) }, q);
        }
        let not_converged = state.status == Status::NotConverged;
        let other_side = matches!(state.status, Status::Ok | Status::NearSingular)
            && !branch.same_det_sign(state, 0);
        if (not_converged || other_side) && q.len() == 1 {
            state.set_lost();
        } else if other_side {
            let steps = &self.mechanism.plan().steps;
            let last = steps.iter().rposition(|step| matches!(step, Step::Group(_)));
            state.fault = last.map(|step| Fault::NotConverged { step });
            state.status = Status::NotConverged;
        }
    }

    /// Traces the branch without solving a position, if all dyads are on cranks and the ground.
    /// With `references`, the design gets these in place of angles at knots.
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
            let fixed = several && dyad.sign.is_none_or(|sign| !plan.may_change[sign]);
            let keeps_sign = || on_crank.is_some_and(|dyad| dyad.keeps_sign(&self.constants));
            self.settled.push(fixed || keeps_sign());
        }
        if !self.settled.iter().all(|&settled| settled) || several && !classes.is_empty() {
            return Traced::No;
        }
        let start = &self.mechanism.class_angle;
        if classes.is_empty() {
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

    /// Whether the branch just traced serves all coordinates with the drawing's signs.
    pub(crate) fn has_constant_signs(&self) -> bool {
        let serves_all = self.serves_all || self.has_one_rotary_driver();
        let branch = &self.branch;
        self.closed_forms && serves_all && branch.is_plain() && branch.has_constant_signs()
    }

    /// Makes the branch one of positions without angles, with the drawing's signs everywhere.
    pub(crate) fn set_constant_signs(&mut self) {
        self.branch.set_constant_signs(self.mechanism.class_angle.len(), &self.signs);
        self.serves_all = self.q0.len() > 1;
    }

    /// The context of knots.
    fn tracing_context(&self) -> Context<'_> {
        Context { tape: &self.tracing_tape, ..self.context(&self.tracing_derivatives) }
    }

    /// Traces the branch by knots in lanes, with the angles of `classes`, where
    /// [`Self::trace_in_closed_form`] does not. With `references`, a plain design gets these in
    /// place of angles at knots (see [`UniformTracer::survey`]).
    #[inline(always)]
    pub(crate) fn trace_in_lanes<L: Level, const G: usize>(
        &mut self,
        uniform: &mut UniformTracer<L::Register, G>,
        classes: &[usize],
        references: Option<&mut [Reference]>,
    ) -> Traced {
        if !self.has_one_rotary_driver() {
            return Traced::No;
        }
        if self.has_groups() && !uniform.has_reference(|| self.reference_branch()) {
            return Traced::No;
        }
        let start = &self.mechanism.class_angle;
        let cx = Context {
            plan: self.mechanism.plan(),
            constants: &self.constants,
            derivatives: &self.tracing_derivatives,
            signs: &self.signs,
            tape: &self.tracing_tape,
        };
        let (branch, tracer) = (&mut self.branch, &mut self.lane_tracer);
        uniform.solve_knots::<L>(&cx, self.q0[0], !classes.is_empty());
        let mut turns_fully = !(self.closed_forms && classes.is_empty());
        if let (Some(references), true, false) = (references, self.closed_forms, classes.is_empty())
        {
            let plain = uniform.survey(&cx, classes, start, references);
            if plain == Some(true) {
                branch.set_constant_signs(start.len(), cx.signs);
                return Traced::Surveyed;
            }
            turns_fully &= plain.is_some();
        }
        let settled = &self.settled;
        let traced = turns_fully && uniform.trace(&cx, classes, start, branch)
            || self.closed_forms
                && tracer.trace::<L, G>(&cx, uniform, classes, start, settled, branch);
        if traced { Traced::Whole } else { Traced::No }
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
        ReferenceBranch::new(
            self.mechanism.plan(),
            &drawing.branch,
            drawing.q0[0],
            drawing.constants.scale,
        )
    }

    pub(crate) fn has_groups(&self) -> bool {
        self.mechanism.plan().groups().next().is_some()
    }

    /// Traces the branch over the coordinates `q` (all positions, rad or m), as a batch would.
    #[cold]
    #[inline(never)]
    pub(crate) fn trace(&mut self, q: &[f64]) {
        if self.closed_forms && self.has_one_rotary_driver() {
            let classes: Vec<usize> = (1..self.mechanism.class_angle.len()).collect();
            let mut uniform = self.uniform_tracer::<Lanes<2>, { KNOTS / 2 }>();
            let whole = self.trace_in_closed_form(&classes, None) == Traced::Whole
                || self.trace_in_lanes::<Portable, { KNOTS / 2 }>(&mut uniform, &classes, None)
                    == Traced::Whole;
            if whole {
                return;
            }
        }
        self.trace_knot_by_knot(q);
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
            let range = [scaled().fold(start, f64::min), scaled().fold(start, f64::max)];
            // No slide goes farther than the sum of all lengths.
            let paired =
                cx.plan.edges.iter().zip(&cx.constants.edge_vector).filter(|(e, _)| e.paired);
            let lengths = paired.map(|(_, w)| w).chain(&cx.constants.fixed).map(|w| w.norm());
            let reach = 2.0 * lengths.sum::<f64>() + 1.0;
            Branch::over_range(&cx, &mut state, start, range, reach, from)
        };
    }

    /// The signs at the drawing that lead straight to the signs given at `q` (scaled); traced
    /// backward.
    pub(crate) fn signs_at_drawing(&self, signs: &[f64], q: &[f64]) -> Vec<i8> {
        let cx = Context { signs, ..self.context(&self.tracing_derivatives) };
        let angles = &self.mechanism.class_angle;
        let mut state = self.state(&self.tracing_derivatives);
        let start = &InitialGuess { angles, taylor: &[] };
        let (branch, at) = Branch::along_segment(&cx, &mut state, q, &self.q0, start);
        branch.signs(at).iter().map(|&s| if s > 0.0 { 1 } else { -1 }).collect()
    }

    /// Whether coordinates (scaled) are too far from the drawing to be followed.
    pub(crate) fn is_too_far(&self, q: &[f64]) -> bool {
        q.iter().zip(&self.q0).any(|(a, b)| (a - b).abs() > MAX_DISTANCE)
    }

    /// Whether one of several drivers is too far from the drawing to be followed, or not finite;
    /// `q`: one position, rad or m.
    pub(crate) fn cannot_follow(&self, q: &[f64]) -> bool {
        let scaled = q.iter().zip(&self.units.coordinate).map(|(q, unit)| q * unit);
        !scaled.zip(&self.q0).all(|(a, b)| (a - b).abs() <= MAX_DISTANCE)
    }

    /// The branch to one position (scaled coordinates); `None` if a coordinate is not finite or too
    /// far.
    pub(crate) fn branch_to(&self, q: &[f64]) -> Option<BranchPoint<'_>> {
        if q.iter().any(|x| !x.is_finite()) {
            return None;
        }
        if let [at] = *q {
            return Some(BranchPoint { branch: Cow::Borrowed(&self.branch), at });
        }
        if self.is_too_far(q) {
            return None;
        }
        if self.serves_all {
            return Some(BranchPoint { branch: Cow::Borrowed(&self.branch), at: 0.0 });
        }
        let angles = &self.mechanism.class_angle;
        let (branch, at) = if let Ok(taylor) = &self.initial_unknowns {
            let cx = self.context(&self.tracing_derivatives);
            let mut state = self.state(&self.tracing_derivatives);
            let start = &InitialGuess { angles, taylor };
            Branch::along_segment(&cx, &mut state, &self.q0, q, start)
        } else {
            (Branch::empty(angles.len(), &self.signs), 0.0)
        };
        Some(BranchPoint { branch: Cow::Owned(branch), at })
    }

    /// Distance (in sizes) of the farthest joint at a parameter of the branch; 0 if it cannot be
    /// solved.
    pub(crate) fn max_distance(&self, at: f64) -> f64 {
        let mut state = self.state(self.derivatives);
        let point = BranchPoint { branch: Cow::Borrowed(&self.branch), at };
        self.solve(&mut state, &[at], Some(&point));
        if state.has_failed() {
            return 0.0;
        }
        let values = state.points.chunks_exact(state.len);
        values.fold(0.0, |max, jet| max.max(jet[0][0].norm()))
    }

    /// Class angles near those at a point, from which whole turns are counted.
    pub(crate) fn reference_angles(&self, point: &BranchPoint<'_>, classes: usize) -> Vec<f64> {
        let location = point.branch.locate(point.at);
        if point.branch.in_untraced_island(&location, 0) {
            // An island that the tracer has not seen.
            let cx = self.context(&self.tracing_derivatives);
            let own = point.branch.trace_island(
                &cx,
                &mut self.state(&self.tracing_derivatives),
                point.at,
            );
            let location = own.locate(point.at);
            return (0..classes).map(|class| own.reference_angle(&location, class)).collect();
        }
        (0..classes).map(|class| point.branch.reference_angle(&location, class)).collect()
    }

    /// The interpolated motion beside a change point.
    #[cold]
    #[inline(never)]
    fn at_change_point(
        &self,
        state: &State,
        branch: &Branch,
        change: &ChangePoint,
        distance: f64,
    ) -> Option<State> {
        let mut interpolants = self.interpolants.borrow_mut();
        let known = interpolants.iter().position(|(at, _)| *at == change.at);
        let known = known.unwrap_or_else(|| {
            let solve = |derivatives: &DerivativeTables, distance: f64| {
                let at = change.at + distance;
                // A fresh state, so that nothing depends on the position that comes first.
                let mut trial = self.state(derivatives);
                self.guess(0, &mut trial, branch, &branch.locate(at));
                trial.solve(
                    &Context { signs: branch.signs(at), ..self.context(derivatives) },
                    &[at],
                );
                let lost = trial.fault.is_some() || trial.points.iter().any(|p| p[0].x.is_nan());
                (!lost).then_some(trial)
            };
            // Values must not depend on the order requested.
            let judge = DerivativeTables::new(1, ChangeInterpolant::JUDGED_ORDER);
            let interpolant =
                ChangeInterpolant::fit(self.change_window, |distance| solve(&judge, distance));
            let interpolant = interpolant.and_then(|interpolant| {
                interpolant.refit(self.change_window, |at| solve(self.derivatives, at))
            });
            interpolants.push((change.at, interpolant));
            interpolants.len() - 1
        });
        let smooth = interpolants[known].1.as_ref()?.state_at(distance, state)?;
        (smooth.residual(&self.context(self.derivatives)) <= SMOOTH_CLOSURE).then_some(smooth)
    }

    /// Solves one position with the signs of its branch there; true if the analogues exist.
    pub(crate) fn solve(
        &self,
        state: &mut State,
        q: &[f64],
        point: Option<&BranchPoint<'_>>,
    ) -> bool {
        let Some(BranchPoint { branch, at }) = point else {
            state.set_bad_input();
            return false;
        };
        if !branch.covers(*at) {
            state.set_lost();
            return false;
        }
        let cx = self.context(self.derivatives);
        state.prepare(cx.plan, cx.constants, cx.derivatives);
        self.guess(0, state, branch, &branch.locate(*at));
        state.solve(&Context { signs: branch.signs(*at), ..cx }, q);
        let not_converged = state.status == Status::NotConverged;
        let solved = matches!(state.status, Status::Ok | Status::NearSingular);
        if not_converged || solved && !branch.same_det_sign(state, 0) {
            self.resolve_from_knot(state, q, (branch, *at));
        }
        // At a change point a dyad is flat, and beside it few digits of the analogues remain: the
        // interpolant is more accurate.
        let solved = matches!(state.status, Status::Ok | Status::NearSingular);
        if q.len() == 1
            && state.status != Status::BadInput
            && let Some((change, distance)) = branch.change_near(*at, self.change_window.reach)
            && let Some(smooth) = self.at_change_point(state, branch, &change, distance)
            && (!solved || smooth.is_near(state))
        {
            let at_change = !solved || distance.abs() <= CHANGE_WIDTH;
            let status = if at_change { Status::Singular } else { state.status };
            *state = smooth;
            state.status = status;
            if at_change {
                let flat = cx.plan.steps.iter().position(
                    |step| matches!(step, Step::Dyad(dyad) if dyad.sign == Some(change.sign)),
                );
                state.fault = flat.map(|step| Fault::Singular { step });
            }
            return true;
        }
        !matches!(state.status, Status::Singular | Status::Unreachable | Status::NotConverged)
    }
}

fn crank_dyads(plan: &Plan) -> Vec<Option<CrankDyad>> {
    plan.dyads().map(|dyad| CrankDyad::of(plan, dyad)).collect()
}
