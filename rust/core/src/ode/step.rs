//! One step of a run: its width, its error, and what follows from it.

use super::control::{MIN_STEP, fitted, spacing};
use super::error::Error;
use super::event_location::{Cut, Step};
use super::integrator::Integrator;
use super::pair::stages::Refusal;
use super::run::{Next, Obstacle, Ordinary, Plan, Planned, Run};
use super::solution::End;
use super::system::{Attempt, System};

/// Attempted steps between two calls of [`System::cancelled`]: a call may read a clock or take a
/// lock, and a hundred evaluations are a short wait.
const CANCEL_CHECK_STEPS: u64 = 16;
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

impl<S: System> Run<'_, S> {
    /// The next step of a smooth interval, unless the run ends.
    pub(super) fn plan_step(&mut self, to: f64) -> Result<Plan, Error<S::Error>> {
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
        let (h, last) = fitted(remaining, proposed);
        let t_new = if last { to } else { self.t + h };
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
        let next = self.conclude(planned, outcome)?;
        self.ordinary = None;
        match next {
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
        if let Some(Ordinary { error, is_stiff, .. }) = self.ordinary {
            self.stiff = is_stiff;
            return Ok(error);
        }
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
        let excess = excess.fold(0.0, f64::max);
        let excess =
            if excess > 0.0 { libm::pow(excess, f64::from(stages.tableau.order)) } else { 0.0 };
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
        let Integrator {
            n,
            stages,
            interpolant,
            tracker,
            y,
            new,
            state,
            event_state,
            event_rates,
            ..
        } = &mut *self.integrator;
        if tracker.len() == 0 {
            return Ok(None);
        }
        if let Some(Ordinary { event_value, magnitude, .. }) = self.ordinary {
            tracker.pass_step(event_value, magnitude);
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
