//! A run of the crank-rocker: samples in time, and the events between them.
//!
//! Positions are closed forms in time, so there is no differential equation for [`crate::ode`]: an
//! event is a root of a function of time, located between samples.

use std::f64::consts::TAU;

use super::case::{Case, Event, JammingError, Kind, Row, Side};
use super::jamming::{JammingLinkage, Mode, SAMPLE_STEP};
use crate::math::root::bisection::{TO_ROUNDING, bisect};
use crate::math::root::golden_section::{Bracket, golden_section};

/// Offset of the search after an event, as a fraction of the remaining sample step: the event
/// function is 0 at the event itself.
const EVENT_OFFSET: f64 = 1.0e-9;
/// Step of the slopes that show a peak between two samples, as a fraction of the interval.
const SLOPE_STEP: f64 = 1.0e-6;

/// Computes the motion, with the ground as a function of time (m, positive).
///
/// # Errors
///
/// [`JammingError`].
pub fn run<E>(
    case: &Case,
    ground: impl FnMut(f64) -> Result<f64, E>,
) -> Result<(Vec<Row>, Vec<Event>), JammingError<E>> {
    let linkage = JammingLinkage::new(*case, ground);
    let mut simulation = Simulation { linkage, rows: Vec::new(), events: Vec::new() };
    simulation.run()?;
    Ok((simulation.rows, simulation.events))
}

struct Simulation<F> {
    linkage: JammingLinkage<F>,
    rows: Vec<Row>,
    events: Vec<Event>,
}

impl<E, F: FnMut(f64) -> Result<f64, E>> Simulation<F> {
    fn run(&mut self) -> Result<(), JammingError<E>> {
        let (excess, side) = self.linkage.jam_excess(0.0)?;
        if excess.is_nan() || excess >= 0.0 {
            return Err(self.linkage.start_error(side)?);
        }
        let end = TAU * self.linkage.case.turns / self.linkage.case.speed.abs();
        let samples = (end * self.linkage.case.speed.abs() / SAMPLE_STEP).ceil().max(2.0);
        let mut mode = None;
        self.record_row(0.0, mode)?;
        let (mut before, mut sample) = (0.0, 0.0);
        while sample < samples {
            sample += 1.0;
            let after = end * sample / samples;
            let mut t = before;
            // Several events may occur between two samples.
            while let Some(event) = self.next_event(t, after, mode)? {
                t = event;
                self.record_row(t, mode)?;
                let is_dead_point = self.apply_event(t, &mut mode)?;
                if is_dead_point {
                    return Ok(());
                }
                self.record_row(t, mode)?;
            }
            self.record_row(after, mode)?;
            before = after;
        }
        let since = self.events.last().map_or(end, |event| event.t);
        if let Some(side) = mode
            && end - since > TAU / self.linkage.case.speed.abs()
        {
            self.record_event(Kind::NoReturn, end, side, [[f64::NAN; 2]; 2])?;
        }
        Ok(())
    }

    /// First time in an interval at which the mode ends.
    fn next_event(
        &mut self,
        low: f64,
        high: f64,
        mode: Mode,
    ) -> Result<Option<f64>, JammingError<E>> {
        let after_event =
            self.events.last().is_some_and(|event| event.t.to_bits() == low.to_bits());
        let start = if after_event { low + EVENT_OFFSET * (high - low) } else { low };
        if start >= high {
            return Ok(None);
        }
        if after_event && self.linkage.mode_end(start, mode)? > 0.0 {
            // The mode just entered ends at once.
            return Ok(Some(start));
        }
        let mut past_end = high;
        let last = self.linkage.mode_end(high, mode)?;
        if last.is_nan() || last <= 0.0 {
            let step = SLOPE_STEP * (high - start);
            let rises =
                self.linkage.mode_end(start + step, mode)? > self.linkage.mode_end(start, mode)?;
            if !(rises && last < self.linkage.mode_end(high - step, mode)?) {
                return Ok(None);
            }
            past_end = self.peak(start, high, mode)?;
            if self.linkage.mode_end(past_end, mode)? <= 0.0 {
                return Ok(None);
            }
        }
        let has_ended = |t| Ok(self.linkage.mode_end(t, mode)? > 0.0);
        let [event, _] = bisect([past_end, start], TO_ROUNDING, has_ended)?;
        Ok(Some(event))
    }

    /// A time at which an event function that rises and falls is positive, or its maximum (golden
    /// section).
    fn peak(&mut self, low: f64, high: f64, mode: Mode) -> Result<f64, JammingError<E>> {
        let has_ended = |bracket: &Bracket| bracket.inner.iter().any(|point| point.1 > 0.0);
        let bracket = golden_section([low, high], has_ended, |t| self.linkage.mode_end(t, mode))?;
        Ok(bracket.best().0)
    }

    /// Applies an event to the mode and records it. Returns whether the run ends.
    fn apply_event(&mut self, t: f64, mode: &mut Mode) -> Result<bool, JammingError<E>> {
        let Some(side) = *mode else {
            let side = self.linkage.jam_excess(t)?.1;
            let speeds = self.linkage.speeds(t, side)?;
            self.record_event(Kind::Jam, t, side, speeds)?;
            *mode = Some(side);
            return Ok(false);
        };
        if self.linkage.is_at_dead_point(t, side) {
            self.record_event(Kind::DeadPoint, t, side, [[f64::NAN; 2]; 2])?;
            return Ok(true);
        }
        let [[ground, slide], [rocker, rod]] = self.linkage.speeds(t, side)?;
        self.record_event(Kind::Return, t, side, [[slide, ground], [rod, rocker]])?;
        *mode = None;
        Ok(false)
    }

    fn record_event(
        &mut self,
        kind: Kind,
        t: f64,
        side: Side,
        [ground_speed, rod_speed]: [[f64; 2]; 2],
    ) -> Result<(), JammingError<E>> {
        let ground = self.linkage.ground(t)?;
        let l4 = if kind == Kind::Jam { ground } else { self.linkage.sliding_ground(t, side) };
        let phi1 = self.linkage.phi(t);
        self.events.push(Event { kind, side, t, phi1, l4, ground, ground_speed, rod_speed });
        Ok(())
    }

    fn record_row(&mut self, t: f64, mode: Mode) -> Result<(), JammingError<E>> {
        let row = self.linkage.row(t, mode)?;
        self.rows.push(row);
        Ok(())
    }
}
