//! A run: steps from break to break.

use super::control::{Control, first_width, spacing};
use super::error::Error;
use super::integrator::Integrator;
use super::options::Options;
use super::pair::stages::{Refusal, Scale, Stages};
use super::record::Record;
use super::solution::{End, Solution, Statistics};
use super::system::System;

/// Fraction of the theoretical first width that is used. The first step has no other to check its
/// error estimate, and a narrow feature between the stages deceives it (errors of hundreds of
/// tolerances occurred). From a narrow step the width grows within a step or two, each checked by
/// the one before.
const FIRST_STEP_FACTOR: f64 = 0.1;
/// Least width of the first step, in spacings of t: it can still be halved a few times.
const MIN_FIRST_STEP: f64 = 256.0;

/// Why a step could not be evaluated.
#[derive(Debug, Clone, Copy)]
pub(super) enum Obstacle {
    DomainBoundary,
    NotFinite { t: f64, component: usize },
}

/// How the run continues after a step.
pub(super) enum Next {
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
    pub(super) t_new: f64,
    /// The width that the control proposes.
    pub(super) proposed: f64,
    /// Whether it is the last of its smooth interval.
    pub(super) last: bool,
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
    pub(super) integrator: &'a mut Integrator,
    pub(super) system: &'a mut S,
    pub(super) options: &'a Options<'a>,
    pub(super) scale: Scale,
    pub(super) control: Control,
    pub(super) t: f64,
    pub(super) t_end: f64,
    /// End of the smooth interval that it is in.
    pub(super) interval: Option<f64>,
    /// Whether the signs of the event functions are taken again at the start of the next interval.
    pub(super) resets_signs: bool,
    /// Why it has ended.
    pub(super) end: Option<End>,
    /// 1 or -1: the direction of the run.
    pub(super) direction: f64,
    /// Width proposed for the next step.
    pub(super) h: Option<f64>,
    pub(super) attempted: u64,
    /// Whether stability limited the last accepted step.
    pub(super) stiff: bool,
    /// Why a step could not be evaluated since the last accepted one.
    pub(super) obstacle: Option<Obstacle>,
    /// Refused steps near a domain boundary, and accepted steps since the last of them.
    pub(super) refusals: u32,
    pub(super) steps_since_refusal: u32,
    /// Where the last step ended that left the domain.
    pub(super) refused: Option<f64>,
    /// Width of the next step toward the domain boundary, if one is ahead.
    pub(super) to_boundary: Option<f64>,
    /// Consecutive restarts at one t.
    pub(super) restarts_in_place: u32,
    /// Consecutive steps rejected for their drift.
    pub(super) drift_retries: u32,
    /// The end of the planned step, if it was found elsewhere.
    pub(super) ordinary: Option<Ordinary>,
    pub(super) record: Record<'a>,
    pub(super) statistics: Statistics,
}

/// What event functions watch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Watched {
    Nothing,
    /// The sign of a component of the state.
    Component(usize),
}

/// How a step ends that is accepted and has no event.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ordinary {
    /// Its error relative to the tolerance.
    pub error: f64,
    pub is_stiff: bool,
    /// The only event function at its end, and its greatest magnitude.
    pub event_value: f64,
    pub magnitude: f64,
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
                (t, &integrator.y.as_flattened()[..integrator.n]),
                std::mem::take(&mut integrator.spare),
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
            ordinary: None,
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

    /// Its system.
    pub(crate) fn system(&self) -> &S {
        self.system
    }

    /// Its system, to be changed.
    pub(crate) fn system_mut(&mut self) -> &mut S {
        self.system
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

    /// What is watched over a step; `None` if more is than its states show.
    pub(super) fn watched(&self) -> Option<Watched> {
        if !self.options.max_change.is_empty() {
            return None;
        }
        match self.integrator.tracker.len() {
            0 => Some(Watched::Nothing),
            1 => self.system.event_component().map(Watched::Component),
            _ => None,
        }
    }

    /// Sign and value of the first event function at the present state; see `EventTracker::first`.
    pub(super) fn first_event(&self) -> (f64, f64) {
        self.integrator.tracker.first()
    }

    /// The absolute and the relative tolerance of a component.
    pub(super) fn tolerance(&self, component: usize) -> [f64; 2] {
        self.scale.of(component)
    }

    /// Error of the step that it has planned; see [`Stages::error_of`].
    pub(super) fn error_of(&mut self, fine: f64, coarse: Option<f64>, h: f64) -> f64 {
        self.integrator.stages.error_of(fine, coarse, h)
    }

    /// Gives the end of the step that it has planned: the new state and its rates, and the numbers of the
    /// continuous extension by row and component.
    pub(super) fn give_end(
        &mut self,
        t_new: f64,
        ordinary: Ordinary,
        [state, rates]: [&[f64]; 2],
        row: impl Fn(usize, usize) -> f64,
    ) {
        let Integrator { n, stages, interpolant, tracker, new, .. } = &mut *self.integrator;
        new.as_flattened_mut()[..*n].copy_from_slice(state);
        stages.give_end(rates);
        stages.evaluations += stages.tableau.stages as u64;
        if tracker.len() > 0 || self.record.needs_dense_output(t_new) {
            stages.evaluations += (stages.tableau.all_stages() - stages.tableau.stages - 1) as u64;
            interpolant.give(row);
        }
        self.ordinary = Some(ordinary);
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
    pub(super) fn leave_interval(&mut self, resets_signs: bool) {
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

    /// The same, with the room of its steps left to the next run of the integrator.
    pub(crate) fn finish_in_room(&mut self, end: End) -> Solution {
        let mut solution = self.finish(end);
        // Without memory for a copy it keeps all.
        if let Ok(copy) = solution.dense.copied() {
            self.integrator.spare = std::mem::replace(&mut solution.dense, copy);
            self.integrator.spare.clear();
        }
        solution
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
}
