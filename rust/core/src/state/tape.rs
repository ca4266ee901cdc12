//! Runs the tape: the operations that a request needs, on one position or a block.

use super::kernel::Level;
use super::kernel::alone::Alone;
use super::state::{Conditions, Context, State};
use super::status::{Fault, Status};
use crate::math::lanes::{Mask, Real};
use crate::math::tolerance::NEAR_SINGULAR_CONDITION;
use crate::math::vector::Vector;
use crate::plan::plan::{Orientation, Step};
use crate::plan::tape::{DrivenOrientation, DyadOp, Op, Tape};

/// No dyad is nearly flat while all [`Conditions::bounds`] are at least this (with a margin for their
/// rounding).
const LEAST_BOUND: f64 = (1.0 + 1.0e-6) / (NEAR_SINGULAR_CONDITION * NEAR_SINGULAR_CONDITION);

impl<R: Real, const G: usize> State<R, G> {
    /// Checked path: computes positions at their `q`, `unit` and `signs`, with conditions, margins and
    /// the reason of a failure.
    #[inline(always)]
    pub(crate) fn run<L: Level<Register = R>>(&mut self, cx: &Context<'_>, tape: &Tape) {
        self.start_checked();
        self.load_drivers(cx, tape);
        for op in &tape.ops {
            if R::LANES == 1 && self.has_failed() {
                return;
            }
            match op {
                Op::TwoLegs(op) if op.is_used => self.two_legs(cx, op),
                Op::StandingGuide(op) if op.is_used => self.standing_guide(cx, op),
                Op::MovingGuide(op) if op.is_used => self.moving_guide(cx, op),
                Op::TurningGuide(op) if op.is_used => self.turning_guide(cx, op),
                Op::StandingGuides(op) if op.is_used => self.standing_guides::<true>(cx, op),
                Op::Place(op) => self.place_point(cx, op),
                Op::Dyad { step } => {
                    if let Step::Dyad(dyad) = &cx.plan.steps[*step] {
                        for g in 0..self.groups.min(G) {
                            self.general_dyad(g, cx, dyad, *step);
                        }
                    }
                }
                Op::Group { step } => {
                    if let Step::Group(group) = &cx.plan.steps[*step] {
                        L::group(self, cx, group, *step);
                    }
                }
                Op::Redundant { step } => {
                    if let Step::Redundant(redundant) = &cx.plan.steps[*step] {
                        for g in 0..self.groups.min(G) {
                            self.check_redundant(g, cx, redundant, *step);
                        }
                    }
                }
                &Op::Length { step, slide } => self.check_length(slide, step),
                Op::TwoLegs(_)
                | Op::StandingGuide(_)
                | Op::MovingGuide(_)
                | Op::TurningGuide(_)
                | Op::StandingGuides(_) => {}
            }
        }
    }

    /// Unchecked path, for one driver, or two where the tape
    /// [serves these](Tape::serves_two_drivers), and a tape that [`is_bounded`](Tape::is_bounded): computes positions
    /// with no more about them than [`Conditions::open`] and [`Conditions::bounds`]. If
    /// [`is_uncertain`](Self::is_uncertain), they must be computed again by [`run`](Self::run);
    /// otherwise they have the same bits.
    #[inline(always)]
    pub(crate) fn run_unchecked<L: Level<Register = R>>(&mut self, cx: &Context<'_>, tape: &Tape) {
        self.conditions.open[..self.groups.min(G)].fill(R::Mask::NONE);
        self.load_drivers(cx, tape);
        match self.len {
            1 => self.run_unchecked_of_length::<L, 1>(cx, tape),
            2 => self.run_unchecked_of_length::<L, 2>(cx, tape),
            3 => self.run_unchecked_of_length::<L, 3>(cx, tape),
            6 => self.run_unchecked_of_length::<L, 6>(cx, tape),
            _ => self.run_unchecked_of_length::<L, 4>(cx, tape),
        }
    }

    #[inline(always)]
    fn run_unchecked_of_length<L: Level<Register = R>, const LEN: usize>(
        &mut self,
        cx: &Context<'_>,
        tape: &Tape,
    ) {
        for op in &tape.ops {
            match op {
                Op::TwoLegs(op) if op.is_used => {
                    self.start_bound(op);
                    L::two_legs::<LEN, G>(self, cx, op);
                }
                Op::StandingGuide(op) if op.is_used => {
                    self.start_bound(op);
                    L::standing_guide::<LEN, G>(self, cx, op);
                }
                Op::MovingGuide(op) if op.is_used => {
                    self.start_bound(op);
                    L::moving_guide::<LEN, G>(self, cx, op);
                }
                Op::TurningGuide(op) if op.is_used => {
                    self.start_bound(op);
                    L::turning_guide::<LEN, G>(self, cx, op);
                }
                Op::StandingGuides(op) if op.is_used => {
                    self.start_bound(op);
                    L::standing_guides::<G>(self, cx, op);
                }
                Op::Place(op) if op.is_used => L::place::<LEN, G>(self, cx, op),
                &Op::Length { slide, .. } => {
                    for g in 0..self.groups.min(G) {
                        let negative = self.pose.slides[slide * self.len][g].lt(R::ZERO);
                        self.conditions.open[g] = self.conditions.open[g].or(negative);
                    }
                }
                _ => {}
            }
        }
    }

    /// A length that is negative does not exist: there the position does not close (step `index`).
    #[inline(always)]
    fn check_length(&mut self, slide: usize, index: usize) {
        for g in 0..self.groups.min(G) {
            let value = self.pose.slides[slide * self.len][g];
            let negative = value.lt(R::ZERO);
            self.conditions.open[g] = self.conditions.open[g].or(negative);
            self.mark_open(g, negative, || Fault::NotClosed { step: index, gap: -value.lane(0) });
        }
    }

    /// Sets the bound of everything that a dyad depends on, 1 if it depends on nothing.
    #[inline(always)]
    fn start_bound(&mut self, op: &DyadOp) {
        if !op.may_have_upstream() {
            return;
        }
        let groups = self.groups.min(G);
        let Conditions { bound, bounds, .. } = &mut self.conditions;
        bound[..groups].fill(R::ONE);
        for &dyad in &op.upstream {
            for g in 0..groups {
                bound[g] = bound[g].min(bounds[dyad][g]);
            }
        }
    }

    /// Whether in some lane a coordinate is not finite, or a dyad may be nearly flat, or open without
    /// being marked as such.
    #[inline(always)]
    pub(crate) fn is_uncertain(&self) -> bool {
        let mut uncertain = R::Mask::NONE;
        for q in &self.pose.q {
            for g in 0..self.groups.min(G) {
                uncertain = uncertain.or(q[g].finite().or(self.conditions.open[g]).not());
            }
        }
        uncertain.any() || self.has_uncertain_dyads()
    }

    /// The same where all coordinates are finite.
    #[inline(always)]
    pub(crate) fn has_uncertain_dyads(&self) -> bool {
        let groups = self.groups.min(G);
        let Conditions { bounds, open, .. } = &self.conditions;
        let mut uncertain = R::Mask::NONE;
        for bounds in bounds {
            for g in 0..groups {
                // NaN must count as uncertain.
                let far = R::splat(LEAST_BOUND).le(bounds[g]);
                uncertain = uncertain.or(far.or(open[g]).not());
            }
        }
        uncertain.any()
    }

    /// Whether in some lane a dyad does not close.
    #[inline(always)]
    pub(crate) fn has_open(&self) -> bool {
        let mut open_lanes = R::Mask::NONE;
        for &open in &self.conditions.open[..self.groups.min(G)] {
            open_lanes = open_lanes.or(open);
        }
        open_lanes.any()
    }

    #[inline(always)]
    fn start_checked(&mut self) {
        self.fault = None;
        self.status = Status::Ok;
        let groups = self.groups.min(G);
        self.conditions.greatest[..groups].fill(R::ONE);
        self.conditions.needs_scalar[..groups].fill(R::Mask::NONE);
        self.conditions.open[..groups].fill(R::Mask::NONE);
        self.work.first_step[..groups].fill(R::ZERO);
        self.work.later_steps[..groups].fill(R::ZERO);
        for q in &self.pose.q {
            for g in 0..groups {
                self.conditions.needs_scalar[g] =
                    self.conditions.needs_scalar[g].or(q[g].finite().not());
            }
        }
        if R::LANES == 1 && self.conditions.needs_scalar[0].any() {
            self.status = Status::BadInput;
        }
    }

    /// Sets driven slides and orientations.
    #[inline(always)]
    fn load_drivers(&mut self, cx: &Context<'_>, tape: &Tape) {
        for (driver, q) in self.pose.q.iter().enumerate() {
            if let Some(slide) = cx.plan.driven_slide(driver) {
                self.pose.slides[slide * self.len] = *q;
            }
        }
        for &DrivenOrientation { index: o, has_jet } in &tape.driven {
            let orientation = &cx.plan.orientations[o];
            for g in 0..self.groups.min(G) {
                let phase = self.phase_of(g, orientation);
                self.pose.phase[o][g] = phase;
                if orientation.class == 0 && has_jet {
                    self.set_driven_orientation(g, cx, o, phase);
                }
            }
        }
    }

    /// The rotation of an orientation by the drivers alone.
    #[inline(always)]
    pub(crate) fn phase_of(&self, g: usize, orientation: &Orientation) -> Vector<R> {
        match orientation.single_driver {
            Some((driver, false)) => self.pose.unit[driver][g],
            Some((driver, true)) => self.pose.unit[driver][g].conj(),
            None => {
                let mut phase = Vector::ONE;
                for (&turns, unit) in orientation.turns.iter().zip(&self.pose.unit) {
                    let unit = if turns < 0 { unit[g].conj() } else { unit[g] };
                    for _ in 0..turns.unsigned_abs() {
                        phase = phase * unit;
                    }
                }
                phase
            }
        }
    }
}

impl State {
    /// Computes one position at `q` (rad; slide drivers in units of the scale).
    #[inline(never)]
    pub(crate) fn solve(&mut self, cx: &Context<'_>, q: &[f64]) {
        for (lanes, &sign) in self.pose.signs.iter_mut().zip(cx.signs) {
            lanes[0] = sign;
        }
        for (driver, &value) in q.iter().enumerate() {
            self.pose.q[driver][0] = value;
            if cx.plan.driven_slide(driver).is_none() {
                self.pose.unit[driver][0] = Vector::at_angle(value);
            }
        }
        self.run::<Alone>(cx, cx.tape);
        if self.status == Status::Ok && self.near_singular(0) {
            self.status = Status::NearSingular;
        }
    }
}
