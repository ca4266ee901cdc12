//! Events of a step: their exact location and their actions.

use super::event::EventTracker;
use super::pair::dense::Interpolant;
use super::pair::stages::{Block, Refusal, Stages};
use super::system::{Action, Fault, System};

/// Limit of Newton steps that polish the location of an event.
const MAX_POLISH_STEPS: u32 = 3;
/// Change of θ up to which dense output gives the change of a state as accurately as another step:
/// the relative error of its slope is small, and so is the distance.
const SHIFT_LIMIT: f64 = 1e-8;
/// Half width, as a fraction of the step, of the difference quotient for the slope of an event
/// function. Its second-order error only slows convergence.
const SLOPE_HALF_WIDTH: f64 = 1e-3;
/// Events within this many spacings of t are simultaneous.
const SIMULTANEOUS: f64 = 64.0;
/// Greatest change of θ by one Newton step. Polishing corrects the error of dense output, which is
/// far smaller; a greater step is a failure.
const MAX_CORRECTION: f64 = 1.0 / 32.0;

/// Cut of a step at an event.
#[derive(Debug)]
pub(super) struct Cut {
    /// Where.
    pub t: f64,
    /// The width that the polynomial of the step has now.
    pub width: f64,
    /// The event that ends the run here, if one does.
    pub stop: Option<usize>,
}

/// An accepted step, searched for events.
pub(super) struct Step<'a, S> {
    pub system: &'a mut S,
    pub stages: &'a mut Stages,
    pub interpolant: &'a mut Interpolant,
    pub n: usize,
    pub t: f64,
    pub h: f64,
    pub t_new: f64,
    pub y: &'a [Block],
    pub new: &'a [Block],
    /// The state at the point evaluated last; after a cut, the state as the event changed it.
    pub state: &'a mut [Block],
    /// The state at an event, before the event changed it.
    pub event_state: &'a mut [Block],
    /// The rates there.
    pub event_rates: &'a mut [f64],
}

impl<S: System> Step<'_, S> {
    fn time(&self, theta: f64) -> f64 {
        if theta == 1.0 { self.t_new } else { self.t + theta * self.h }
    }

    /// The event functions from dense output.
    fn events_by_dense_output(&mut self, theta: f64, values: &mut [f64]) -> Result<(), S::Error> {
        let state = &mut self.state.as_flattened_mut()[..self.n];
        if theta == 1.0 {
            state.copy_from_slice(&self.new.as_flattened()[..self.n]);
        } else {
            self.interpolant.at(theta, state);
        }
        let t = self.time(theta);
        self.system.events(t, &self.state.as_flattened()[..self.n], values)
    }

    /// The event functions from a step of the method, which is more accurate than dense output.
    fn events_by_step(&mut self, theta: f64, values: &mut [f64]) -> Result<(), S::Error> {
        if theta == 1.0 {
            return self.events_by_dense_output(theta, values);
        }
        let h = theta * self.h;
        match self.stages.advance(self.system, self.t, self.y, h, self.state) {
            Ok(()) => {}
            Err(Refusal::System(error)) => return Err(error),
            // A shorter step fails where the full one did not: fall back to dense output.
            Err(_) => return self.events_by_dense_output(theta, values),
        }
        let t = self.time(theta);
        self.system.events(t, &self.state.as_flattened()[..self.n], values)
    }

    /// The event functions close to the point evaluated last, `from`.
    fn shift(&mut self, from: f64, theta: f64, values: &mut [f64]) -> Result<(), S::Error> {
        let state = &mut self.state.as_flattened_mut()[..self.n];
        self.interpolant.shift(from, theta, state);
        let t = self.time(theta);
        self.system.events(t, &self.state.as_flattened()[..self.n], values)
    }

    /// Polishes the location of an event by simplified Newton steps with states of the method.
    fn polish(
        &mut self,
        j: usize,
        theta: f64,
        spacing: f64,
        values: &mut [f64],
    ) -> Result<f64, S::Error> {
        if theta == 0.0 {
            return Ok(theta);
        }
        let low = (theta - SLOPE_HALF_WIDTH).max(0.0);
        let high = (theta + SLOPE_HALF_WIDTH).min(1.0);
        self.events_by_dense_output(low, values)?;
        let before = values[j];
        self.events_by_dense_output(high, values)?;
        let slope = (values[j] - before) / (high - low);
        let (mut best, mut last) = (theta, theta);
        self.events_by_step(best, values)?;
        let mut value = values[j];
        for _ in 0..MAX_POLISH_STEPS {
            let change = value / slope;
            if !(change.abs() > spacing && change.abs() <= MAX_CORRECTION) {
                break;
            }
            last = (best - change).clamp(0.0, 1.0);
            if change.abs() <= SHIFT_LIMIT {
                self.shift(best, last, values)?;
            } else {
                self.events_by_step(last, values)?;
            }
            let improved = values[j].abs() < value.abs();
            if !improved {
                break;
            }
            (best, value) = (last, values[j]);
        }
        if last != best {
            self.events_by_step(best, values)?;
        }
        Ok(best)
    }

    /// Detects the events of the step in order, until one cuts it.
    ///
    /// `record` receives each: its number, t, and the state there.
    pub(super) fn detect(
        &mut self,
        tracker: &mut EventTracker,
        mut record: impl FnMut(usize, f64, &[f64]),
    ) -> Result<Option<Cut>, S::Error> {
        tracker.sample(|theta, values| self.events_by_dense_output(theta, values))?;
        // The spacing of t as a fraction of the step.
        let spacing = 2.0 * f64::EPSILON * (self.t_new.abs() / self.h.abs()).max(1.0);
        for interval in 0..tracker.intervals() {
            tracker.find_events(interval, spacing, |theta, values| {
                self.events_by_dense_output(theta, values)
            })?;
            let mut detected = std::mem::take(&mut tracker.detected);
            for (theta, j) in &mut detected {
                *theta = self.polish(*j, *theta, spacing, &mut tracker.current)?;
            }
            detected.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
            let cut = self.apply_events(&detected, SIMULTANEOUS * spacing, tracker, &mut record)?;
            tracker.detected = detected;
            if cut.is_some() {
                return Ok(cut);
            }
            tracker.pass_interval(interval);
        }
        tracker.next_step();
        Ok(None)
    }

    /// Records the events of one interval in order and applies their actions.
    fn apply_events(
        &mut self,
        events: &[(f64, usize)],
        tolerance: f64,
        tracker: &mut EventTracker,
        record: &mut impl FnMut(usize, f64, &[f64]),
    ) -> Result<Option<Cut>, S::Error> {
        for (i, &(theta, j)) in events.iter().enumerate() {
            let t = self.time(theta);
            // A single event is the point evaluated last.
            if events.len() > 1 || theta == 0.0 {
                self.evaluate_event(theta, &mut tracker.current)?;
            }
            self.event_state.copy_from_slice(self.state);
            record(j, t, &self.event_state.as_flattened()[..self.n]);
            // After the event the system may have changed.
            let may_cut = self.system.may_cut(j);
            if may_cut {
                self.evaluate_event_rates(theta)?;
            }
            let action =
                self.system.on_event(j, t, &mut self.state.as_flattened_mut()[..self.n])?;
            tracker.pass_event(j);
            if action == Action::Continue {
                continue;
            }
            tracker.fired[j] = true;
            // Simultaneous events already recorded must not occur again.
            for &(before, function) in &events[..i] {
                tracker.fired[function] = theta - before <= tolerance;
            }
            let mut width = self.h;
            if theta > 0.0 {
                let state = self.event_state.as_flattened();
                let widths = [self.h, t - self.t];
                width = self.interpolant.end_at(theta, widths, state, self.event_rates);
            }
            let mut cut = Cut { t, width, stop: Some(j).filter(|_| action == Action::Stop) };
            // Events of other functions that cross here must occur now: after the restart the functions are
            // past their crossing.
            for function in 0..tracker.len() {
                // Rounding may put the event just after this one.
                let mut near = events[i + 1..].iter();
                let is_near = !tracker.is_boundary(function)
                    && near.any(|&(at, which)| which == function && at - theta <= tolerance);
                let occurs = is_near || tracker.is_event(function, tracker.current[function]);
                if tracker.fired[function] || !occurs {
                    continue;
                }
                record(function, t, &self.event_state.as_flattened()[..self.n]);
                let state = &mut self.state.as_flattened_mut()[..self.n];
                let action = self.system.on_event(function, t, state)?;
                tracker.fired[function] = true;
                cut.stop = cut.stop.or(Some(function).filter(|_| action == Action::Stop));
            }
            return Ok(Some(cut));
        }
        Ok(None)
    }

    /// The rates at an event, before it changes anything. Where they have no value, those of dense output:
    /// the step was accepted beyond the event.
    fn evaluate_event_rates(&mut self, theta: f64) -> Result<(), S::Error> {
        self.stages.evaluations += 1;
        let (t, state) = (self.time(theta), &self.event_state.as_flattened()[..self.n]);
        match self.system.rates(t, state, self.event_rates) {
            Ok(()) if self.event_rates.iter().all(|rate| rate.is_finite()) => Ok(()),
            Err(Fault::Error(error)) => Err(error),
            _ => {
                self.interpolant.slope(theta, self.h, self.event_rates);
                Ok(())
            }
        }
    }

    /// State and event functions at a polished event.
    fn evaluate_event(&mut self, theta: f64, values: &mut [f64]) -> Result<(), S::Error> {
        if theta > 0.0 {
            return self.events_by_step(theta, values);
        }
        self.state.copy_from_slice(self.y);
        self.system.events(self.t, &self.state.as_flattened()[..self.n], values)
    }
}
