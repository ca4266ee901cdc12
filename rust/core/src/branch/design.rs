//! One design ready to be solved: its constants, its unit of length, its branch from the drawing.

use std::borrow::Cow;
use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::branch::Branch;
use super::change_interpolant::{ChangeInterpolant, ChangeWindow};
use super::crank_dyad::{CrankDyad, CrankLengths};
use super::driven_chord::{ChordPath, DrivenDyad};
use super::knot::Taylor2;
use super::lanes::lane_tracer::LaneTracer;
use super::lanes::uniform::UniformTracer;
use super::scalar_chord::may_change;
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::constants::DesignConstants;
use crate::plan::constants_rate::ConstantsRate;
use crate::plan::mechanism::Mechanism;
use crate::plan::plan::Plan;
use crate::plan::tape::{Op, Tape};
use crate::state::state::{Context, State};

/// One design after another, in the requested assembly.
pub(crate) struct Design<'a> {
    pub mechanism: &'a Mechanism,
    pub constants: DesignConstants,
    pub units: Units,
    /// Tables of the requested order.
    pub derivatives: &'a DerivativeTables,
    /// Tables for tracing: of first order, or second with groups above class II.
    pub(super) tracing_derivatives: Arc<DerivativeTables>,
    /// The tape for tracing.
    pub(super) tracing_tape: Cow<'a, Tape>,
    /// Dimensions of the present design.
    pub(super) values: Vec<f64>,
    /// Unknowns of the groups at the drawing's coordinate; or the part of the path from the
    /// drawing's dimensions after which a group folds.
    pub(crate) initial_unknowns: Result<Vec<Taylor2>, f64>,
    pub(super) signs: Vec<f64>,
    /// Scaled coordinates of the drawing.
    pub(crate) q0: Vec<f64>,
    /// The branch from the drawing, if one serves all positions.
    pub branch: Branch,
    /// Whether the branch serves all positions of several drivers.
    pub(crate) serves_all: bool,
    /// Whether all steps have closed forms: then lanes close or not by the same bits as single
    /// positions. Groups iterate, and redundant links close within a tolerance.
    pub(crate) closed_forms: bool,
    /// The dyads of several drivers, if chords give the turns of all angles.
    pub(super) driven_dyads: Option<Vec<DrivenDyad>>,
    /// Their chords, if whole turns of requested angles depend on the path to each position and are
    /// counted by these.
    pub(crate) chord_paths: Vec<ChordPath>,
    /// For every dyad: where it is attached, if it is on a crank and the ground.
    pub(super) crank_dyads: Vec<Option<CrankDyad>>,
    /// For every one of those, where its lengths stand, if they decide alone whether it closes.
    crank_lengths: Vec<Option<CrankLengths>>,
    /// For every dyad of the present design, whether its sign is known to be constant.
    pub(super) settled: Vec<bool>,
    /// Made for the first design that needs it.
    pub(super) lane_tracer: Option<Box<LaneTracer>>,
    /// Range around a change point within which the motion is interpolated.
    pub change_window: ChangeWindow,
    /// Interpolants in use, by their change point.
    pub(super) interpolants: RefCell<Vec<(f64, Option<ChangeInterpolant>)>>,
    /// Work space of [`Self::may_change`].
    at_drawing: Option<Box<State>>,
    /// See [`Context::cancel`].
    pub cancel: Option<&'a AtomicBool>,
}

/// Factors between the design's own unit of length and the metre: powers of two.
#[derive(Debug, Default)]
pub(crate) struct Units {
    /// The unit of length that they belong to, m.
    scale: f64,
    /// Factor of every coordinate, into the design's unit.
    pub coordinate: Vec<f64>,
    /// Factor of every jet entry of a length, into metres.
    pub length: Vec<f64>,
    /// Factor of every jet entry of an angle.
    pub angle: Vec<f64>,
}

impl Units {
    fn set(&mut self, mechanism: &Mechanism, scale: f64, derivatives: &DerivativeTables) {
        if self.scale == scale {
            return;
        }
        self.scale = scale;
        let inverse_scale = 1.0 / scale;
        let slides = |d: usize| mechanism.plan().driven_slide(d).is_some();
        self.coordinate.clear();
        self.coordinate
            .extend((0..mechanism.q0().len()).map(|d| if slides(d) { inverse_scale } else { 1.0 }));
        self.angle.clear();
        self.length.clear();
        for power in &derivatives.powers {
            // One factor at a time: a length's third analogue stays in range where the cube of the
            // unit does not.
            let (mut angle, mut length) = (1.0, scale);
            for (&power, &unit) in power.iter().zip(&self.coordinate) {
                for _ in 0..power {
                    angle *= unit;
                    length *= unit;
                }
            }
            self.angle.push(angle);
            self.length.push(length);
        }
    }
}

/// The memory that a design fills when it is bound and traced: allocated once for all designs of a mechanism.
#[derive(Default)]
pub(crate) struct DesignMemory {
    constants: DesignConstants,
    values: Vec<f64>,
    branch: Branch,
    settled: Vec<bool>,
    /// Boxed: moving it would take longer than solving a position.
    lane_tracer: Option<Box<LaneTracer>>,
    at_drawing: Option<Box<State>>,
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
            tracing_derivatives: DerivativeTables::shared(mechanism.q0().len(), order),
            tracing_tape: Cow::Borrowed(&mechanism.plan().tracing_tape),
            values: Vec::new(),
            initial_unknowns: Ok(Vec::new()),
            signs: signs_of(mechanism.plan(), signs),
            q0: Vec::new(),
            branch: Branch::default(),
            serves_all: false,
            closed_forms: mechanism.plan().has_closed_forms(),
            driven_dyads: DrivenDyad::all(mechanism.plan()),
            chord_paths: Vec::new(),
            crank_dyads: crank_dyads(mechanism.plan()),
            crank_lengths: crank_lengths(mechanism),
            settled: Vec::new(),
            lane_tracer: None,
            change_window: ChangeWindow::SHORT,
            interpolants: RefCell::default(),
            at_drawing: None,
            cancel: None,
        }
    }

    /// Whether its searches have been cancelled.
    pub(crate) fn is_cancelled(&self) -> bool {
        self.cancel.is_some_and(|cancel| cancel.load(Ordering::Relaxed))
    }

    /// A new design with the memory of an earlier one of the mechanism.
    pub(crate) fn reusing(self, memory: DesignMemory) -> Self {
        let DesignMemory { constants, values, branch, settled, lane_tracer, at_drawing } = memory;
        Self { constants, values, branch, settled, lane_tracer, at_drawing, ..self }
    }

    /// Traces by a tape that has the requested angles only.
    pub(crate) fn trace_by(&mut self, tape: Tape) {
        self.tracing_tape = Cow::Owned(tape);
    }

    /// The tape for tracing, which another design may use, and the memory.
    pub(crate) fn into_memory(self) -> (Option<Tape>, DesignMemory) {
        let Self { constants, values, branch, settled, lane_tracer, at_drawing, .. } = self;
        let memory = DesignMemory { constants, values, branch, settled, lane_tracer, at_drawing };
        match self.tracing_tape {
            Cow::Owned(tape) => (Some(tape), memory),
            Cow::Borrowed(_) => (None, memory),
        }
    }

    /// Sets the dimensions; the branch is yet to be traced.
    pub(crate) fn bind(&mut self, values: &[f64]) {
        self.bind_within(values, self.mechanism.slots.scale(values), f64::INFINITY);
    }

    /// Sets the dimensions with a known scale, for driven slides whose values never exceed `driven_reach`, m.
    pub(crate) fn bind_within(&mut self, values: &[f64], scale: f64, driven_reach: f64) {
        let mechanism = self.mechanism;
        self.interpolants.get_mut().clear();
        self.serves_all = false;
        self.chord_paths.clear();
        self.constants.bind(mechanism.plan(), &mechanism.slots, values, scale, driven_reach);
        self.units.set(mechanism, self.constants.scale, self.derivatives);
        self.q0.clear();
        self.q0.extend(mechanism.q0().iter().zip(&self.units.coordinate).map(|(q, unit)| q * unit));
        self.values.clear();
        self.values.extend_from_slice(values);
        // A point that moves over an area in the drawing may move along a curve in a design, where joints
        // coincide.
        if mechanism.plan().may_change.contains(&false) {
            self.constants.may_change = self.may_change();
        }
    }

    /// For every sign, whether its dyad can pass change points.
    pub(crate) fn may_change(&mut self) -> Vec<bool> {
        let state = self.at_drawing.take();
        let mut state = state.unwrap_or_else(|| Box::new(self.state(&self.tracing_derivatives)));
        let cx = self.context(&self.tracing_derivatives);
        state.prepare(cx.plan, cx.constants, cx.derivatives);
        let may_change = may_change(&cx, &mut state, &self.q0);
        self.at_drawing = Some(state);
        may_change
    }

    /// A point of the ground, m.
    pub(crate) fn fixed_point(&self, point: usize) -> Vector {
        let origin = Vector::new(self.constants.origin[0], self.constants.origin[1]);
        self.constants.fixed[point].scale(self.units.length[0]) + origin
    }

    /// Rates of the constants where the dimensions have these rates.
    pub(crate) fn rate(&self, by: &[f64]) -> ConstantsRate {
        let mechanism = self.mechanism;
        ConstantsRate::new(mechanism.plan(), &mechanism.slots, &self.constants, &self.values, by)
    }

    /// Whether a dyad that the tape solves certainly does not close at one of the positions of a turn in
    /// even steps (rad). If false, it may close or not.
    pub(crate) fn misses_position(&self, tape: &Tape, step: f64) -> bool {
        self.crank_dyads.iter().zip(&self.crank_lengths).any(|(dyad, lengths)| {
            let Some(dyad) = dyad else { return false };
            lengths.is_none()
                && is_solved(tape, dyad.dyad)
                && dyad.misses_position(&self.constants, step)
        })
    }

    /// The same for a design that is not bound yet, where its lengths alone show it.
    pub(crate) fn lengths_miss_position(&self, tape: &Tape, values: &[f64], step: f64) -> bool {
        self.crank_lengths.iter().enumerate().any(|(dyad, lengths)| {
            let Some(lengths) = lengths else { return false };
            is_solved(tape, dyad) && lengths.miss_position(values, step)
        })
    }

    /// The context of a position; its signs are those at the drawing.
    pub(crate) fn context<'b>(&'b self, derivatives: &'b DerivativeTables) -> Context<'b> {
        Context {
            plan: self.mechanism.plan(),
            constants: &self.constants,
            derivatives,
            signs: &self.signs,
            tape: &self.mechanism.plan().tape,
            cancel: self.cancel,
        }
    }

    /// Tables for tracing.
    pub(crate) fn tracing_derivatives(&self) -> &DerivativeTables {
        &self.tracing_derivatives
    }

    /// Signs at the drawing, as the solver needs them.
    pub(crate) fn signs_in_use(&self) -> &[f64] {
        &self.signs
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

    /// Sets the data that all positions of the design share in a work space that other designs may have used.
    pub(crate) fn prepare(&self, state: &mut State) {
        state.prepare(self.mechanism.plan(), &self.constants, self.derivatives);
    }

    /// The same in every lane.
    #[inline(always)]
    pub(crate) fn prepare_lanes<R: Real>(&self, state: &mut State<R>) {
        state.prepare(self.mechanism.plan(), &self.constants, self.derivatives);
    }

    /// Work space for [`Design::trace_in_lanes`].
    pub(crate) fn uniform_tracer<R: Real, const G: usize>(&self) -> UniformTracer<R, G> {
        UniformTracer::new(self.mechanism.plan(), &self.tracing_derivatives)
    }

    /// Whether one branch serves all positions, and its driver is an angle.
    pub(crate) fn has_one_rotary_driver(&self) -> bool {
        self.q0.len() == 1 && self.mechanism.plan().driven_slide(0).is_none()
    }

    pub(crate) fn has_groups(&self) -> bool {
        self.mechanism.plan().groups().next().is_some()
    }
}

/// Signs as the solver needs them; those of lengths are always +1.
fn signs_of(plan: &Plan, signs: &[i8]) -> Vec<f64> {
    let mut signs: Vec<f64> = signs.iter().map(|&sign| f64::from(sign)).collect();
    for dyad in plan.dyads().filter(|dyad| dyad.is_length) {
        if let Some(sign_of_length) = dyad.sign.and_then(|sign| signs.get_mut(sign)) {
            *sign_of_length = 1.0;
        }
    }
    signs
}

/// Whether the requested positions need this dyad.
fn is_solved(tape: &Tape, dyad: usize) -> bool {
    matches!(&tape.ops[tape.dyads[dyad]], Op::TwoLegs(op) | Op::StandingGuide(op) if op.is_used)
}

fn crank_lengths(mechanism: &Mechanism) -> Vec<Option<CrankLengths>> {
    let plan = mechanism.plan();
    let lengths = |dyad| CrankLengths::of(&CrankDyad::of(plan, dyad)?, dyad, &mechanism.slots);
    plan.dyads().map(lengths).collect()
}

fn crank_dyads(plan: &Plan) -> Vec<Option<CrankDyad>> {
    plan.dyads().map(|dyad| CrankDyad::of(plan, dyad)).collect()
}
