//! A run: step after step, from break to break.

use super::control::{Control, first_width};
use super::error::Error;
use super::event_location::{Cut, Step};
use super::integrator::Integrator;
use super::options::Options;
use super::record::Record;
use super::solution::{End, Solution, Statistics};
use super::stages::{Refusal, Scale};
use super::system::System;

/// The system is asked whether to go on once in so many steps tried: asking may mean a clock or a
/// lock, a hundred evaluations are little to wait for.
const ASK_EVERY: u64 = 16;
/// A step goes to the end of its stretch if it need not be wider than by this factor, so that no
/// sliver is left (Hairer's programs).
const STRETCH: f64 = 1.01;
/// So many steps before the end of a stretch are made equal, instead of a narrow one at its end:
/// as many, and their errors are smaller.
const EVEN: f64 = 4.0;
/// Part of the first width that theory proposes. Its step alone decides how large its error seems,
/// and a narrow feature between the stages deceives it (errors of hundreds of tolerances were seen);
/// from a narrow step widths grow within a step or two, each checked by the one before.
const FIRST: f64 = 0.1;
/// The narrowest steps, in spacings of t: narrower ones have no inner places left for stages.
const NARROWEST: f64 = 4.0;
/// The narrowest first step, in spacings of t: it can still be halved a few times.
const NARROWEST_FIRST: f64 = 256.0;

/// So many refusals are an edge, even if steps of some width go on between them: a component that
/// moves slowly stands on its last number before it, the others go on for ever. Halving alone needs
/// some hundred.
const MOST_REFUSALS: u32 = 256;
/// After so many steps without one they are forgotten: each may be ten times as wide as the one
/// before, near an edge some are refused soon.
const FREE: u32 = 8;

/// So often a step is tried again because an invariant has moved: what then is left does not depend
/// on its width.
const MOST_DOUBTS: u32 = 3;

/// So many restarts at one place are no progress: pieces whose borders do not meet send the run to
/// and fro.
const MOST_STANDS: u32 = 64;

/// What a step met that was not there.
#[derive(Debug, Clone, Copy)]
enum Obstacle {
    Edge,
    NotFinite { t: f64, component: usize },
}

/// What follows a step.
enum Next {
    Step,
    Restart,
    End(End),
}

impl Integrator {
    /// Integrates from `t` with state `y` to `t_end`, which may be before `t`.
    ///
    /// How a run ended that was made but did not come to `t_end` is told by [`Solution::end`].
    ///
    /// # Errors
    ///
    /// [`Error`], if it cannot be begun, if rates are NaN or infinite, or if the system says so.
    pub fn run<S: System>(
        &mut self,
        system: &mut S,
        t: f64,
        y: &[f64],
        t_end: f64,
        options: &Options,
    ) -> Result<Solution, Error<S::Error>> {
        options.check(t, t_end, y, self.n)?;
        self.y.as_flattened_mut()[..self.n].copy_from_slice(y);
        self.stages.evaluations = 0;
        self.watch.reset(options.events);
        Run::new(self, system, (t, t_end), options).go()
    }
}

/// A run that is being made. The integrator has its first state.
pub(super) struct Run<'a, S> {
    work: &'a mut Integrator,
    system: &'a mut S,
    options: &'a Options<'a>,
    scale: Scale,
    control: Control,
    t: f64,
    t_end: f64,
    /// 1 or -1.
    way: f64,
    /// Width of the next step, if nothing is in its way.
    h: Option<f64>,
    tried: u64,
    /// Whether stability held the last good step.
    stiff: bool,
    /// What was met since the last good step.
    obstacle: Option<Obstacle>,
    /// Refusals on the way to an edge, and steps since the last.
    refusals: u32,
    free: u32,
    /// Events met at one place, one after another.
    stands: u32,
    /// Steps refused for the drift of an invariant, one after another.
    doubted: u32,
    record: Record<'a>,
    statistics: Statistics,
}

impl<'a, S: System> Run<'a, S> {
    /// From one t to another.
    pub(super) fn new(
        work: &'a mut Integrator,
        system: &'a mut S,
        (t, t_end): (f64, f64),
        options: &'a Options<'a>,
    ) -> Self {
        let way = if t_end < t { -1.0 } else { 1.0 };
        Self {
            scale: Scale::new(options.relative, options.absolute, work.n),
            control: Control::new(work.stages.tableau),
            record: Record::new(options.keep, way, t, &work.y.as_flattened()[..work.n]),
            work,
            system,
            options,
            t,
            t_end,
            way,
            h: None,
            tried: 0,
            stiff: false,
            obstacle: None,
            refusals: 0,
            free: 0,
            stands: 0,
            doubted: 0,
            statistics: Statistics::default(),
        }
    }

    /// Goes to the end, or as far as it can.
    pub(super) fn go(mut self) -> Result<Solution, Error<S::Error>> {
        let mut end = if self.t == self.t_end { Some(End::Reached) } else { None };
        let mut again = true;
        while end.is_none() {
            let to = self.stretch_end();
            end = match self.stretch(to, again)? {
                Next::Step if self.t == self.t_end => Some(End::Reached),
                Next::End(end) => Some(end),
                next => {
                    self.statistics.restarts += 1;
                    again = matches!(next, Next::Restart);
                    None
                }
            };
        }
        self.statistics.evaluations = self.work.stages.evaluations;
        Ok(Solution {
            t: self.t,
            y: self.work.y.as_flattened()[..self.work.n].to_vec(),
            end: end.unwrap_or(End::Reached),
            events: self.record.events,
            event_states: self.record.event_states,
            samples: self.record.samples,
            path: self.record.path,
            statistics: self.statistics,
        })
    }

    /// The next break, or the end.
    fn stretch_end(&self) -> f64 {
        let breaks = self.options.breaks;
        let next = if self.way > 0.0 {
            breaks.get(breaks.partition_point(|b| *b <= self.t))
        } else {
            breaks.partition_point(|b| *b < self.t).checked_sub(1).and_then(|i| breaks.get(i))
        };
        next.copied().filter(|b| (self.t_end - b) * self.way > 0.0).unwrap_or(self.t_end)
    }

    /// Goes to the end of a smooth stretch, or to what ends it before: `Next::Step` if nothing does.
    /// `again` if signs of events are to be taken anew.
    fn stretch(&mut self, to: f64, again: bool) -> Result<Next, Error<S::Error>> {
        let Integrator { n, stages, watch, y, new, .. } = &mut *self.work;
        let flat = &y.as_flattened()[..*n];
        self.system.enter(self.t, to, flat).map_err(Error::System)?;
        stages.enter();
        if watch.len() > 0 {
            self.system.events(self.t, flat, watch.start_values()).map_err(Error::System)?;
            if again {
                watch.begin();
            }
        }
        if let Err(refusal) = stages.evaluate(self.system, 0, self.t, y) {
            return match refusal {
                Refusal::NotThere => Ok(Next::End(End::DomainBoundary { t: self.t })),
                Refusal::NotFinite { t, component } => Err(Error::NotFinite { t, component }),
                Refusal::System(error) => Err(Error::System(error)),
            };
        }
        self.system.watch_invariant(self.t, &y.as_flattened()[..*n]);
        if self.h.is_none() {
            let most = (self.t_end - self.t).abs().min(self.options.max_step);
            let width = if let Some(width) = self.options.first_step {
                width.min(most)
            } else {
                let most = most.min((to - self.t).abs());
                let start = (self.t, y.as_slice());
                first_width(stages, self.system, &self.scale, start, (most, self.way), new)
                    .map_err(Error::System)?
            };
            let width = if self.options.first_step.is_some() { width } else { FIRST * width };
            self.h = Some(self.way * width.max(NARROWEST_FIRST * spacing(self.t)));
        }
        while self.t != to {
            match self.step(to)? {
                Next::Step => {}
                next => return Ok(next),
            }
        }
        Ok(Next::Step)
    }

    /// Tries one step.
    fn step(&mut self, to: f64) -> Result<Next, Error<S::Error>> {
        if self.tried >= self.options.max_steps {
            let stiff = 2 * self.statistics.stiff > self.statistics.steps;
            return Ok(Next::End(End::StepLimit { t: self.t, stiff }));
        }
        if self.tried.is_multiple_of(ASK_EVERY) && self.system.cancelled() {
            return Ok(Next::End(End::Cancelled { t: self.t }));
        }
        self.tried += 1;
        let remaining = to - self.t;
        let own = self.h.unwrap_or(remaining);
        let parts = (remaining / (own * STRETCH)).ceil();
        let last = parts <= 1.0;
        let (h, t_new) = if last {
            (remaining, to)
        } else {
            let h = if parts <= EVEN { remaining / parts } else { own };
            (h, self.t + h)
        };
        if self.refusals > MOST_REFUSALS {
            return Ok(Next::End(End::DomainBoundary { t: self.t }));
        }
        if !last && h.abs() < NARROWEST * spacing(self.t) {
            return match self.obstacle {
                None => Ok(Next::End(End::Stalled { t: self.t })),
                Some(Obstacle::Edge) => Ok(Next::End(End::DomainBoundary { t: self.t })),
                Some(Obstacle::NotFinite { t, component }) => {
                    Err(Error::NotFinite { t, component })
                }
            };
        }
        let factor = match self.attempt(h, t_new) {
            Ok(error) if error <= 1.0 => {
                let factor = self.control.accepted(error);
                // A step cut short by its stretch says little of the width that it might have had.
                let wider =
                    if last { (h * factor).abs().max(own.abs()) } else { (h * factor).abs() };
                self.h = Some(self.way * wider.min(self.options.max_step));
                return self.accept(h, t_new, last);
            }
            Ok(error) => self.control.rejected(error),
            Err(Refusal::System(error)) => return Err(Error::System(error)),
            Err(Refusal::NotThere) => {
                self.obstacle = Some(Obstacle::Edge);
                self.refusals += 1;
                self.free = 0;
                self.control.refused()
            }
            Err(Refusal::NotFinite { t, component }) => {
                self.obstacle = Some(Obstacle::NotFinite { t, component });
                self.control.refused()
            }
        };
        self.statistics.rejected += 1;
        self.h = Some(h * factor);
        Ok(Next::Step)
    }

    /// Makes a step and says how large its error is. All stages are there if it is good.
    fn attempt(&mut self, h: f64, t_new: f64) -> Result<f64, Refusal<S::Error>> {
        let output = self.work.watch.len() > 0 || self.record.asks_before(t_new);
        let Integrator { n, stages, interpolant, y, new, .. } = &mut *self.work;
        let end = stages.tableau.stages;
        stages.advance(self.system, self.t, y, h, new)?;
        if let Some(component) = new.as_flattened().iter().position(|y| !y.is_finite()) {
            return Err(Refusal::NotFinite { t: t_new, component });
        }
        let too_far = self
            .options
            .max_change
            .iter()
            .enumerate()
            .map(|(i, most)| (new.as_flattened()[i] - y.as_flattened()[i]).abs() / most);
        // As an error it gives the right width.
        let too_far = libm::pow(too_far.fold(0.0, f64::max), f64::from(stages.tableau.order));
        if too_far > 1.0 {
            return Ok(too_far);
        }
        if stages.tableau.error_needs_end {
            stages.evaluate(self.system, end, t_new, new)?;
        }
        let error = stages.error(&self.scale, y, new, h).max(too_far);
        if error > 1.0 {
            return Ok(error);
        }
        if !stages.tableau.error_needs_end {
            stages.evaluate(self.system, end, t_new, new)?;
        }
        let drift = self.system.drift(t_new, &new.as_flattened()[..*n]);
        if drift > 1.0 && self.doubted < MOST_DOUBTS {
            self.doubted += 1;
            return Ok(drift);
        }
        // The stages of the continuous output take the place of what this looks at.
        self.stiff = stages.is_stiff(&self.scale, y, new, h);
        if output {
            stages.extend(self.system, self.t, y, h)?;
            interpolant.set(stages, y, new, h);
        }
        Ok(error)
    }

    /// Takes a good step, as far as no event cuts it.
    fn accept(&mut self, h: f64, t_new: f64, last: bool) -> Result<Next, Error<S::Error>> {
        self.obstacle = None;
        self.doubted = 0;
        self.free = self.free.saturating_add(1);
        if self.free >= FREE {
            self.refusals = 0;
        }
        let cut = self.look_for_events(h, t_new).map_err(Error::System)?;
        let reached = cut.as_ref().map_or(t_new, |cut| cut.t);
        self.statistics.count((reached - self.t).abs(), last || cut.is_some(), self.stiff);
        if reached != self.t {
            self.record.step(&self.work.interpolant, self.work.n, self.t, h, reached);
            self.stands = 0;
        }
        self.stands += 1;
        self.t = reached;
        let Some(cut) = cut else {
            self.system.keep_invariant();
            std::mem::swap(&mut self.work.y, &mut self.work.new);
            self.work.stages.turn_over();
            return Ok(Next::Step);
        };
        self.work.y.copy_from_slice(&self.work.state);
        match cut.stop {
            Some(index) => Ok(Next::End(End::Event { index, t: cut.t })),
            None if self.t == self.t_end => Ok(Next::Step),
            None if self.stands > MOST_STANDS => Ok(Next::End(End::Stalled { t: self.t })),
            None => Ok(Next::Restart),
        }
    }

    fn look_for_events(&mut self, h: f64, t_new: f64) -> Result<Option<Cut>, S::Error> {
        let Integrator { n, stages, interpolant, watch, y, new, state, met } = &mut *self.work;
        if watch.len() == 0 {
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
            met,
        };
        let record = &mut self.record;
        step.watch(watch, |index, t, y| record.event(index, t, y))
    }
}

/// The distance of a number from the next, about.
fn spacing(t: f64) -> f64 {
    (t.abs() * f64::EPSILON).max(f64::MIN_POSITIVE)
}
