//! Events of a step: where exactly they are, and what they lead to.

use super::dense::Interpolant;
use super::event::EventTracker;
use super::stages::{Block, Refusal, Stages};
use super::system::{Action, System};

/// How often the place of an event is mended by steps of the method itself.
const MENDINGS: u32 = 3;
/// Over so small a part of the step the continuous output tells the change of a state as well as
/// another step would: its slope is wrong by little, and by so little of that.
const BESIDE: f64 = 1e-8;
/// Half width of the difference that gives the slope of an event function, as part of the step: its
/// error, of the second order, costs nothing but speed of convergence.
const SLOPE_HALF_WIDTH: f64 = 1e-3;
/// Events nearer than so many spacings of t are at one place.
const TOGETHER: f64 = 64.0;
/// Mending moves an event by the error of the continuous output, which is far less than this part
/// of the step; more is no mending.
const FARTHEST: f64 = 1.0 / 32.0;

/// Where a step is cut by an event.
#[derive(Debug)]
pub(super) struct Cut {
    /// Where.
    pub t: f64,
    /// The event that ends the run here, if one does.
    pub stop: Option<usize>,
}

/// A step that was good, in which events are looked for.
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
    /// The state at the place looked at last; behind a cut, what the event has made of it.
    pub state: &'a mut [Block],
    /// The state at an event, before it has made anything of it.
    pub met: &'a mut [Block],
}

impl<S: System> Step<'_, S> {
    fn time(&self, theta: f64) -> f64 {
        if theta == 1.0 { self.t_new } else { self.t + theta * self.h }
    }

    /// The event functions by continuous output.
    fn output(&mut self, theta: f64, values: &mut [f64]) -> Result<(), S::Error> {
        let state = &mut self.state.as_flattened_mut()[..self.n];
        if theta == 1.0 {
            state.copy_from_slice(&self.new.as_flattened()[..self.n]);
        } else {
            self.interpolant.at(theta, state);
        }
        let t = self.time(theta);
        self.system.events(t, &self.state.as_flattened()[..self.n], values)
    }

    /// The event functions by a step of the method itself: the continuous output is less accurate.
    fn method(&mut self, theta: f64, values: &mut [f64]) -> Result<(), S::Error> {
        if theta == 1.0 {
            return self.output(theta, values);
        }
        let h = theta * self.h;
        match self.stages.advance(self.system, self.t, self.y, h, self.state) {
            Ok(()) => {}
            Err(Refusal::System(error)) => return Err(error),
            // A shorter step fails where the whole one did not: the output must do.
            Err(_) => return self.output(theta, values),
        }
        let t = self.time(theta);
        self.system.events(t, &self.state.as_flattened()[..self.n], values)
    }

    /// The event functions beside the place looked at last, which is `from`.
    fn shift(&mut self, from: f64, theta: f64, values: &mut [f64]) -> Result<(), S::Error> {
        let state = &mut self.state.as_flattened_mut()[..self.n];
        self.interpolant.shift(from, theta, state);
        let t = self.time(theta);
        self.system.events(t, &self.state.as_flattened()[..self.n], values)
    }

    /// Mends the place of an event by simplified Newton steps with the method's own states.
    fn mend(
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
        self.output(low, values)?;
        let before = values[j];
        self.output(high, values)?;
        let slope = (values[j] - before) / (high - low);
        let (mut best, mut last) = (theta, theta);
        self.method(best, values)?;
        let mut value = values[j];
        for _ in 0..MENDINGS {
            let change = value / slope;
            if !(change.abs() > spacing && change.abs() <= FARTHEST) {
                break;
            }
            last = (best - change).clamp(0.0, 1.0);
            if change.abs() <= BESIDE {
                self.shift(best, last, values)?;
            } else {
                self.method(last, values)?;
            }
            let better = values[j].abs() < value.abs();
            if !better {
                break;
            }
            (best, value) = (last, values[j]);
        }
        if last != best {
            self.method(best, values)?;
        }
        Ok(best)
    }

    /// Goes through the step from event to event, until one cuts it.
    ///
    /// `record` is told of each: its number, where it is, and the state there.
    pub(super) fn watch(
        &mut self,
        watch: &mut EventTracker,
        mut record: impl FnMut(usize, f64, &[f64]),
    ) -> Result<Option<Cut>, S::Error> {
        watch.survey(|theta, values| self.output(theta, values))?;
        // The spacing of t, as part of the step.
        let spacing = 2.0 * f64::EPSILON * (self.t_new.abs() / self.h.abs()).max(1.0);
        for interval in 0..watch.intervals() {
            watch.search(interval, spacing, |theta, values| self.output(theta, values))?;
            let mut found = std::mem::take(&mut watch.found);
            for (theta, j) in &mut found {
                *theta = self.mend(*j, *theta, spacing, &mut watch.here)?;
            }
            found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
            let cut = self.go_through(&found, TOGETHER * spacing, watch, &mut record)?;
            watch.found = found;
            if cut.is_some() {
                return Ok(cut);
            }
            watch.leave(interval);
        }
        watch.turn_over();
        Ok(None)
    }

    /// The events of one interval, in order.
    fn go_through(
        &mut self,
        found: &[(f64, usize)],
        together: f64,
        watch: &mut EventTracker,
        record: &mut impl FnMut(usize, f64, &[f64]),
    ) -> Result<Option<Cut>, S::Error> {
        for (i, &(theta, j)) in found.iter().enumerate() {
            let t = self.time(theta);
            // The place looked at last is this one, if it is the only one.
            if found.len() > 1 || theta == 0.0 {
                self.place(theta, &mut watch.here)?;
            }
            self.met.copy_from_slice(self.state);
            record(j, t, &self.met.as_flattened()[..self.n]);
            let action =
                self.system.on_event(j, t, &mut self.state.as_flattened_mut()[..self.n])?;
            watch.passed(j);
            if action == Action::Continue {
                continue;
            }
            watch.fired[j] = true;
            // What was recorded just here must not happen again.
            for &(before, other) in &found[..i] {
                watch.fired[other] = theta - before <= together;
            }
            if theta > 0.0 {
                self.interpolant.meet(theta, self.met.as_flattened());
            }
            let mut cut = Cut { t, stop: Some(j).filter(|_| action == Action::Stop) };
            // What else has crossed here must happen now: behind the restart it has happened.
            for other in 0..watch.len() {
                // By rounding it may be found just behind.
                let mut near = found[i + 1..].iter();
                let is_near = !watch.is_border(other)
                    && near.any(|&(at, which)| which == other && at - theta <= together);
                let happens = is_near || watch.happens(other, watch.here[other]);
                if watch.fired[other] || !happens {
                    continue;
                }
                record(other, t, &self.met.as_flattened()[..self.n]);
                let state = &mut self.state.as_flattened_mut()[..self.n];
                let action = self.system.on_event(other, t, state)?;
                watch.fired[other] = true;
                cut.stop = cut.stop.or(Some(other).filter(|_| action == Action::Stop));
            }
            return Ok(Some(cut));
        }
        Ok(None)
    }

    /// State and event functions at a place already mended.
    fn place(&mut self, theta: f64, values: &mut [f64]) -> Result<(), S::Error> {
        if theta > 0.0 {
            return self.method(theta, values);
        }
        self.state.copy_from_slice(self.y);
        self.system.events(self.t, &self.state.as_flattened()[..self.n], values)
    }
}
