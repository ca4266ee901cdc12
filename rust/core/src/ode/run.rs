//! A run: steps from break to break.

use super::control::{Control, first_width};
use super::error::Error;
use super::event_location::{Cut, Step};
use super::integrator::Integrator;
use super::options::Options;
use super::pair::stages::{Refusal, Scale, Stages};
use super::record::Record;
use super::solution::{End, Solution, Statistics};
use super::system::{Attempt, System};

/// Attempted steps between two calls of [`System::cancelled`]: a call may read a clock or take a
/// lock, and a hundred evaluations are a short wait.
const CANCEL_CHECK_STEPS: u64 = 16;
/// A step goes to the end of its smooth interval if that widens it by at most this factor, so that no
/// sliver remains (Hairer's programs).
const LAST_STEP_STRETCH: f64 = 1.01;
/// The last steps of a smooth interval, up to this many, are made equal instead of leaving a narrow
/// one at its end: the same number of steps with smaller errors.
const EQUAL_STEPS: f64 = 4.0;
/// Fraction of the theoretical first width that is used. The first step has no other to check its
/// error estimate, and a narrow feature between the stages deceives it (errors of hundreds of
/// tolerances occurred). From a narrow step the width grows within a step or two, each checked by
/// the one before.
const FIRST_STEP_FACTOR: f64 = 0.1;
/// Least width of a step, in spacings of t: the stages of a narrower one coincide.
const MIN_STEP: f64 = 4.0;
/// Least width of the first step, in spacings of t: it can still be halved a few times.
const MIN_FIRST_STEP: f64 = 256.0;

/// This many refused steps mean a domain boundary, even if some steps succeed between them: a slow
/// component may stay on its last number before the boundary while the others go on for ever.
/// Halving alone needs about a hundred.
const MAX_REFUSALS: u32 = 256;
/// Refusals are forgotten after this many steps without one: each step may be several times wider than the
/// one before, so near a boundary a refusal comes sooner.
const REFUSAL_MEMORY: u32 = 8;

/// Limit of retries of a step because of its drift: a drift that remains does not depend on the
/// width.
const MAX_DRIFT_RETRIES: u32 = 3;

/// Limit of restarts at one t: pieces whose boundaries do not meet send the run back and forth.
const MAX_RESTARTS_IN_PLACE: u32 = 64;

/// Why a step could not be evaluated.
#[derive(Debug, Clone, Copy)]
enum Obstacle {
    DomainBoundary,
    NotFinite { t: f64, component: usize },
}

/// How the run continues after a step.
enum Next {
    Step,
    Restart,
    End(End),
}

/// What a run does next.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Plan {
    /// It attempts a step.
    Attempt(Planned),
    /// It ends.
    End(End),
}

/// A step to attempt.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Planned {
    /// Its width, and where it ends.
    pub h: f64,
    t_new: f64,
    /// The width that the control proposes.
    proposed: f64,
    /// Whether it is the last of its smooth interval.
    last: bool,
}

impl Integrator {
    /// Integrates from `t` with state `y` to `t_end`, which may be before `t`.
    ///
    /// A run may end before `t_end`; [`Solution::end`] gives the reason.
    ///
    /// # Errors
    ///
    /// [`Error`], if an argument is invalid, rates are NaN or infinite, or the system fails.
    pub fn run<S: System>(
        &mut self,
        system: &mut S,
        t: f64,
        y: &[f64],
        t_end: f64,
        options: &Options,
    ) -> Result<Solution, Error<S::Error>> {
        let mut run = self.begin(system, t, y, t_end, options)?;
        loop {
            match run.plan()? {
                Plan::Attempt(planned) => run.attempt(planned)?,
                Plan::End(end) => return Ok(run.finish(end)),
            }
        }
    }

    /// Begins a run from `t` with state `y` to `t_end`, to go on step by step.
    ///
    /// # Errors
    ///
    /// An invalid argument.
    pub(crate) fn begin<'a, S: System>(
        &'a mut self,
        system: &'a mut S,
        t: f64,
        y: &[f64],
        t_end: f64,
        options: &'a Options<'a>,
    ) -> Result<Run<'a, S>, Error<S::Error>> {
        options.check(t, t_end, y, self.n)?;
        self.y.as_flattened_mut()[..self.n].copy_from_slice(y);
        self.stages.evaluations = 0;
        self.tracker.reset(options.events);
        Ok(Run::new(self, system, (t, t_end), options))
    }
}

/// A run in progress. The integrator holds its state.
pub(crate) struct Run<'a, S> {
    integrator: &'a mut Integrator,
    system: &'a mut S,
    options: &'a Options<'a>,
    scale: Scale,
    control: Control,
    t: f64,
    t_end: f64,
    /// End of the smooth interval that it is in.
    interval: Option<f64>,
    /// Whether the signs of the event functions are taken again at the start of the next interval.
    resets_signs: bool,
    /// Why it has ended.
    end: Option<End>,
    /// 1 or -1: the direction of the run.
    direction: f64,
    /// Width proposed for the next step.
    h: Option<f64>,
    attempted: u64,
    /// Whether stability limited the last accepted step.
    stiff: bool,
    /// Why a step could not be evaluated since the last accepted one.
    obstacle: Option<Obstacle>,
    /// Refused steps near a domain boundary, and accepted steps since the last of them.
    refusals: u32,
    steps_since_refusal: u32,
    /// Where the last step ended that left the domain.
    refused: Option<f64>,
    /// Width of the next step toward the domain boundary, if one is ahead.
    to_boundary: Option<f64>,
    /// Consecutive restarts at one t.
    restarts_in_place: u32,
    /// Consecutive steps rejected for their drift.
    drift_retries: u32,
    record: Record<'a>,
    statistics: Statistics,
}

impl<'a, S: System> Run<'a, S> {
    /// A run from one t to another.
    pub(super) fn new(
        integrator: &'a mut Integrator,
        system: &'a mut S,
        (t, t_end): (f64, f64),
        options: &'a Options<'a>,
    ) -> Self {
        let direction = if t_end < t { -1.0 } else { 1.0 };
        Self {
            scale: Scale::new(options.relative, options.absolute, integrator.n),
            control: Control::new(integrator.stages.tableau),
            record: Record::new(
                options.output,
                direction,
                t,
                &integrator.y.as_flattened()[..integrator.n],
            ),
            integrator,
            system,
            options,
            t,
            t_end,
            interval: None,
            resets_signs: true,
            end: None,
            direction,
            h: None,
            attempted: 0,
            stiff: false,
            obstacle: None,
            refusals: 0,
            steps_since_refusal: 0,
            refused: None,
            to_boundary: None,
            restarts_in_place: 0,
            drift_retries: 0,
            statistics: Statistics::default(),
        }
    }

    /// The step to attempt next, unless it ends.
    pub(crate) fn plan(&mut self) -> Result<Plan, Error<S::Error>> {
        loop {
            if let Some(end) = self.end {
                return Ok(Plan::End(end));
            }
            if self.interval.is_none() && self.t == self.t_end {
                self.end = Some(End::Reached);
                continue;
            }
            let Some(to) = self.interval else {
                let to = self.interval_end();
                self.end = self.begin_interval(to)?;
                self.interval = Some(to);
                continue;
            };
            if self.t != to {
                match self.plan_step(to)? {
                    Plan::End(end) => self.end = Some(end),
                    plan @ Plan::Attempt(_) => return Ok(plan),
                }
            } else if self.t == self.t_end {
                self.end = Some(End::Reached);
            } else {
                self.leave_interval(false);
            }
        }
    }

    /// The stages of its steps.
    pub(super) fn stages(&self) -> &Stages {
        &self.integrator.stages
    }

    /// Its present state.
    pub(super) fn state(&self) -> &[f64] {
        &self.integrator.y.as_flattened()[..self.integrator.n]
    }

    /// The rates there.
    pub(super) fn rates(&self) -> &[f64] {
        &self.integrator.stages.rates(0).as_flattened()[..self.integrator.n]
    }

    /// Gives the rates of stages of the step that it has planned; see [`Stages::give`].
    pub(super) fn give(
        &mut self,
        count: usize,
        rate: impl Fn(usize, usize) -> f64,
        argument: impl Fn(usize) -> f64,
    ) {
        self.integrator.stages.give(count, rate, argument);
    }

    /// Goes on to the next smooth interval.
    fn leave_interval(&mut self, resets_signs: bool) {
        self.statistics.restarts += 1;
        (self.interval, self.resets_signs) = (None, resets_signs);
    }

    /// Takes the solution of a run that has ended.
    pub(crate) fn finish(&mut self, end: End) -> Solution {
        self.statistics.evaluations = self.integrator.stages.evaluations;
        let record = &mut self.record;
        Solution {
            t: self.t,
            y: self.integrator.y.as_flattened()[..self.integrator.n].to_vec(),
            end,
            events: std::mem::take(&mut record.events),
            event_states: std::mem::take(&mut record.event_states),
            samples: std::mem::take(&mut record.samples),
            dense: std::mem::take(&mut record.dense),
            statistics: self.statistics,
        }
    }

    /// The next break, or the end of the run.
    fn interval_end(&self) -> f64 {
        let breaks = self.options.breaks;
        let next = if self.direction > 0.0 {
            breaks.get(breaks.partition_point(|b| *b <= self.t))
        } else {
            breaks.partition_point(|b| *b < self.t).checked_sub(1).and_then(|i| breaks.get(i))
        };
        next.copied().filter(|b| (self.t_end - b) * self.direction > 0.0).unwrap_or(self.t_end)
    }

    /// Begins a smooth interval; returns why the run ends there, if it does.
    fn begin_interval(&mut self, to: f64) -> Result<Option<End>, Error<S::Error>> {
        let Integrator { n, stages, tracker, y, new, .. } = &mut *self.integrator;
        let flat = &y.as_flattened()[..*n];
        self.system.begin_interval(self.t, to, flat).map_err(Error::System)?;
        stages.begin_interval();
        if tracker.len() > 0 {
            self.system.events(self.t, flat, tracker.start_values()).map_err(Error::System)?;
            if self.resets_signs {
                tracker.reset_signs();
            }
        }
        if let Err(refusal) = stages.evaluate(self.system, 0, self.t, y) {
            return match refusal {
                Refusal::OutOfDomain => Ok(Some(End::DomainBoundary { t: self.t })),
                Refusal::NotFinite { t, component } => Err(Error::NotFinite { t, component }),
                Refusal::System(error) => Err(Error::System(error)),
            };
        }
        self.system.watch_invariant(self.t, &y.as_flattened()[..*n]);
        if self.h.is_none() {
            let limit = (self.t_end - self.t).abs().min(self.options.max_step);
            let width = if let Some(width) = self.options.first_step {
                width.min(limit)
            } else {
                let limit = limit.min((to - self.t).abs());
                let start = (self.t, y.as_slice());
                first_width(stages, self.system, &self.scale, start, (limit, self.direction), new)
                    .map_err(Error::System)?
            };
            let width =
                if self.options.first_step.is_some() { width } else { FIRST_STEP_FACTOR * width };
            self.h = Some(self.direction * width.max(MIN_FIRST_STEP * spacing(self.t)));
        }
        Ok(None)
    }

    /// The next step of a smooth interval, unless the run ends.
    fn plan_step(&mut self, to: f64) -> Result<Plan, Error<S::Error>> {
        if self.attempted >= self.options.max_steps {
            let stiff = 2 * self.statistics.stiff > self.statistics.steps;
            return Ok(Plan::End(End::StepLimit { t: self.t, stiff }));
        }
        if self.attempted.is_multiple_of(CANCEL_CHECK_STEPS) && self.system.cancelled() {
            return Ok(Plan::End(End::Cancelled { t: self.t }));
        }
        self.attempted += 1;
        let remaining = to - self.t;
        let mut proposed = self.h.unwrap_or(remaining);
        if let Some(width) = self.to_boundary {
            proposed = self.direction * width.min(proposed.abs());
        }
        let steps_left = (remaining / (proposed * LAST_STEP_STRETCH)).ceil();
        let last = steps_left <= 1.0;
        let (h, t_new) = if last {
            (remaining, to)
        } else {
            let h = if steps_left <= EQUAL_STEPS { remaining / steps_left } else { proposed };
            (h, self.t + h)
        };
        if self.refusals > MAX_REFUSALS || self.to_boundary == Some(0.0) {
            return Ok(Plan::End(End::DomainBoundary { t: self.t }));
        }
        if !last && h.abs() < MIN_STEP * spacing(self.t) {
            return match self.obstacle {
                None => Ok(Plan::End(End::Stalled { t: self.t })),
                Some(Obstacle::DomainBoundary) => Ok(Plan::End(End::DomainBoundary { t: self.t })),
                Some(Obstacle::NotFinite { t, component }) => {
                    Err(Error::NotFinite { t, component })
                }
            };
        }
        Ok(Plan::Attempt(Planned { h, t_new, proposed, last }))
    }

    /// Attempts a planned step.
    pub(crate) fn attempt(&mut self, planned: Planned) -> Result<(), Error<S::Error>> {
        let outcome = self.compute(planned.h, planned.t_new);
        self.integrator.stages.forget_given();
        match self.conclude(planned, outcome)? {
            Next::Step => {}
            Next::Restart => self.leave_interval(true),
            Next::End(end) => self.end = Some(end),
        }
        Ok(())
    }

    /// Accepts or rejects a step with its error relative to the tolerance.
    fn conclude(
        &mut self,
        Planned { h, t_new, proposed, last }: Planned,
        outcome: Result<f64, Refusal<S::Error>>,
    ) -> Result<Next, Error<S::Error>> {
        let factor = match outcome {
            Ok(error) if error <= 1.0 => {
                let factor = self.control.factor_after_accept(error);
                // A step cut short by the end of its interval shows little of the width that the tolerance
                // allows.
                let wider =
                    if last { (h * factor).abs().max(proposed.abs()) } else { (h * factor).abs() };
                self.h = Some(self.direction * wider.min(self.options.max_step));
                return self.accept(h, t_new, last);
            }
            Ok(error) => self.control.factor_after_reject(error),
            Err(Refusal::System(error)) => return Err(Error::System(error)),
            Err(Refusal::OutOfDomain) => {
                self.obstacle = Some(Obstacle::DomainBoundary);
                self.refusals += 1;
                self.steps_since_refusal = 0;
                self.refused = Some(t_new);
                self.look_for_boundary(h)?;
                self.control.factor_after_refusal()
            }
            Err(Refusal::NotFinite { t, component }) => {
                self.obstacle = Some(Obstacle::NotFinite { t, component });
                self.control.factor_after_refusal()
            }
        };
        self.statistics.rejected += 1;
        self.h = Some(h * factor);
        Ok(Next::Step)
    }

    /// Computes a step and its error relative to the tolerance. If the error is at most 1, all
    /// stages are evaluated.
    fn compute(&mut self, h: f64, t_new: f64) -> Result<f64, Refusal<S::Error>> {
        let dense = self.integrator.tracker.len() > 0 || self.record.needs_dense_output(t_new);
        let Integrator { n, stages, interpolant, y, new, .. } = &mut *self.integrator;
        let end = stages.tableau.stages;
        stages.advance(self.system, self.t, y, h, new)?;
        if let Some(component) = new.as_flattened().iter().position(|y| !y.is_finite()) {
            return Err(Refusal::NotFinite { t: t_new, component });
        }
        let excess = self
            .options
            .max_change
            .iter()
            .enumerate()
            .map(|(i, limit)| (new.as_flattened()[i] - y.as_flattened()[i]).abs() / limit);
        // Raised to the order, it acts as an error that gives the right width.
        let excess = libm::pow(excess.fold(0.0, f64::max), f64::from(stages.tableau.order));
        if excess > 1.0 {
            return Ok(excess);
        }
        if stages.tableau.error_needs_end {
            stages.evaluate(self.system, end, t_new, new)?;
        }
        let error = stages.error(&self.scale, y, new, h).max(excess);
        if error > 1.0 {
            return Ok(error);
        }
        if !stages.tableau.error_needs_end {
            stages.evaluate(self.system, end, t_new, new)?;
        }
        if stages.is_given(end) {
            self.system.place(t_new, &new.as_flattened()[..*n]);
        }
        let drift = self.system.drift(t_new, &new.as_flattened()[..*n]);
        if drift > 1.0 && self.drift_retries < MAX_DRIFT_RETRIES {
            self.drift_retries += 1;
            return Ok(drift);
        }
        // Before `extend`, which overwrites the state that this compares.
        self.stiff = stages.is_stiff(&self.scale, y, new, h);
        if dense {
            stages.extend(self.system, self.t, y, h)?;
            interpolant.set(stages, y, new, h);
        }
        Ok(error)
    }

    /// Takes an accepted step, up to an event that cuts it.
    fn accept(&mut self, h: f64, t_new: f64, last: bool) -> Result<Next, Error<S::Error>> {
        self.obstacle = None;
        self.drift_retries = 0;
        self.steps_since_refusal = self.steps_since_refusal.saturating_add(1);
        if self.steps_since_refusal >= REFUSAL_MEMORY {
            self.refusals = 0;
        }
        let cut = self.detect_events(h, t_new).map_err(Error::System)?;
        let reached = cut.as_ref().map_or(t_new, |cut| cut.t);
        self.statistics.add_step((reached - self.t).abs(), last || cut.is_some(), self.stiff);
        if reached != self.t {
            let Integrator { interpolant, n, .. } = &*self.integrator;
            let width = cut.as_ref().map_or(h, |cut| cut.width);
            let recorded = self.record.step(interpolant, *n, self.t, width, reached);
            recorded.map_err(|_| Error::OutOfMemory { steps: self.record.dense.ends().len() })?;
            self.restarts_in_place = 0;
        }
        self.restarts_in_place += 1;
        self.t = reached;
        let Some(cut) = cut else {
            self.system.keep_invariant();
            std::mem::swap(&mut self.integrator.y, &mut self.integrator.new);
            self.integrator.stages.next_step();
            self.look_for_boundary(h)?;
            return Ok(Next::Step);
        };
        self.integrator.y.copy_from_slice(&self.integrator.state);
        match cut.stop {
            Some(index) => Ok(Next::End(End::Event { index, t: cut.t })),
            None if self.t == self.t_end => Ok(Next::Step),
            None if self.restarts_in_place > MAX_RESTARTS_IN_PLACE => {
                Ok(Next::End(End::Stalled { t: self.t }))
            }
            None => Ok(Next::Restart),
        }
    }

    /// Requests the width of a step toward the domain boundary after an attempted step of width `h`.
    fn look_for_boundary(&mut self, h: f64) -> Result<(), Error<S::Error>> {
        let Integrator { n, y, .. } = &*self.integrator;
        self.refused = self.refused.filter(|t| (t - self.t) * self.direction > 0.0);
        // Steps that aim at a boundary do not count as refused.
        let has_left_domain = self.refusals > 0 || self.to_boundary.is_some();
        let last = Attempt { h, refused: self.refused, has_left_domain };
        let width = self.system.step_to_boundary(self.t, &y.as_flattened()[..*n], last);
        self.to_boundary = width.map_err(Error::System)?;
        Ok(())
    }

    fn detect_events(&mut self, h: f64, t_new: f64) -> Result<Option<Cut>, S::Error> {
        let Integrator { n, stages, interpolant, tracker, y, new, state, event_state, event_rates } =
            &mut *self.integrator;
        if tracker.len() == 0 {
            return Ok(None);
        }
        let mut step = Step {
            system: self.system,
            stages,
            interpolant,
            n: *n,
            t: self.t,
            h,
            t_new,
            y,
            new,
            state,
            event_state,
            event_rates,
        };
        let record = &mut self.record;
        step.detect(tracker, |index, t, y| record.event(index, t, y))
    }
}

/// Approximate distance from a number to the next.
fn spacing(t: f64) -> f64 {
    (t.abs() * f64::EPSILON).max(f64::MIN_POSITIVE)
}
