//! Motion of a crank-rocker that becomes a slider-crank where friction jams it.
//!
//! The paper (section 3) does not say what locks. This module assumes that joint C jams where the
//! transmission angle falls to its least value. Coupler and rocker then move as one rigid rod BD,
//! and the support D slides along the line of centres until it has returned to its position.

use std::f64::consts::{PI, TAU};

use libm::{acos, hypot};

use super::motion::{Assembly, position};
use crate::math::root::bisection::{TO_ROUNDING, bisect};
use crate::math::root::golden_section::{Bracket, golden_section};
use crate::math::trig::sin_cos;

/// Crank angle between samples, rad. A jam that begins and ends between two samples is found by its
/// peak.
const SAMPLE_STEP: f64 = PI / 360.0;
/// Step of the difference quotient for the speed of the ground, as a fraction of a sample step.
const GROUND_STEP: f64 = 1.0e-3;
/// Offset of the search after an event, as a fraction of the remaining sample step: the event
/// function is 0 at the event itself.
const EVENT_OFFSET: f64 = 1.0e-9;
/// Step of the slopes that show a peak between two samples, as a fraction of the interval.
const SLOPE_STEP: f64 = 1.0e-6;
/// Dead point: the rod is within this fraction of its length of not reaching the line of centres.
const DEAD_POINT_RTOL: f64 = 1.0e-12;

/// Side on which C jams.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// γ₂₃ near π: D slides inward.
    Outer,
    /// γ₂₃ near 0: D slides outward.
    Inner,
}

/// Kind of an event.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// C jams, so that D slides.
    Jam,
    /// D is back at its position, so that the rocker swings again.
    Return,
    /// The rod just reaches the line of centres: the run ends.
    DeadPoint,
    /// The run ends while D has been sliding for more than a turn.
    NoReturn,
}

/// An event of the run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// Its kind.
    pub kind: Kind,
    /// The side that jams.
    pub side: Side,
    /// Time, s.
    pub t: f64,
    /// Crank angle, rad.
    pub phi1: f64,
    /// Distance of D from A, m.
    pub l4: f64,
    /// Prescribed ground at that time, m.
    pub ground: f64,
    /// dl₄/dt before and after, m/s; NaN at the end of a run.
    pub ground_speed: [f64; 2],
    /// Angular velocity of the rocker or rod before and after, rad/s; NaN at the end of a run.
    pub rod_speed: [f64; 2],
}

/// One position of the run. A is the origin, D lies on the negative x-axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Time, s.
    pub t: f64,
    /// Distance of D from A, m.
    pub l4: f64,
    /// Transmission angle, rad.
    pub gamma: f64,
    /// Whether D slides.
    pub sliding: bool,
    /// Positions of B and C, m.
    pub positions: [[f64; 2]; 2],
}

/// Why a run cannot start or go on.
#[derive(Debug, Clone, PartialEq)]
pub enum Refused<E> {
    /// Blocked at the start: the side and the transmission angle, rad.
    Blocked(Side, f64),
    /// The coupler does not reach the rocker at the start: BD, m.
    OutOfReach(f64),
    /// An error of the ground's function.
    Ground(E),
}

/// A run to compute.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Case {
    /// Crank, coupler and rocker, m.
    pub lengths: [f64; 3],
    /// Least transmission angle, rad, above 0.
    pub gamma_min: f64,
    /// Speed of the crank, rad/s, not 0.
    pub speed: f64,
    /// Crank angle at the time 0, rad.
    pub phi0: f64,
    /// Turns of the crank, above 0.
    pub turns: f64,
}

/// Computes the motion, with the ground as a function of time (m, positive).
///
/// # Errors
///
/// [`Refused`].
pub fn run<E>(
    case: &Case,
    ground: impl FnMut(f64) -> Result<f64, E>,
) -> Result<(Vec<Row>, Vec<Event>), Refused<E>> {
    let mut simulation =
        Simulation { case: *case, ground, cached: None, rows: Vec::new(), events: Vec::new() };
    simulation.run()?;
    Ok((simulation.rows, simulation.events))
}

struct Simulation<F> {
    case: Case,
    /// Length of the ground as a function of time.
    ground: F,
    /// Last time and value of the ground.
    cached: Option<(f64, f64)>,
    rows: Vec<Row>,
    events: Vec<Event>,
}

/// `None` as a crank-rocker, or the side while D slides.
type Mode = Option<Side>;

impl<E, F: FnMut(f64) -> Result<f64, E>> Simulation<F> {
    fn run(&mut self) -> Result<(), Refused<E>> {
        let (excess, side) = self.jam_excess(0.0)?;
        if excess.is_nan() || excess >= 0.0 {
            return Err(self.start_error(side)?);
        }
        let end = TAU * self.case.turns / self.case.speed.abs();
        let samples = (end * self.case.speed.abs() / SAMPLE_STEP).ceil().max(2.0);
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
            && end - since > TAU / self.case.speed.abs()
        {
            self.record_event(Kind::NoReturn, end, side, [[f64::NAN; 2]; 2])?;
        }
        Ok(())
    }

    /// Why the mechanism cannot start.
    fn start_error(&mut self, side: Side) -> Result<Refused<E>, Refused<E>> {
        let s = self.pin_distance(0.0)?;
        let [_, l2, l3] = self.case.lengths;
        if !((l2 - l3).abs() <= s && s <= l2 + l3) {
            return Ok(Refused::OutOfReach(s));
        }
        Ok(Refused::Blocked(side, self.gamma(s)))
    }

    fn ground(&mut self, t: f64) -> Result<f64, Refused<E>> {
        if let Some((at, value)) = self.cached
            && at.to_bits() == t.to_bits()
        {
            return Ok(value);
        }
        let value = (self.ground)(t).map_err(Refused::Ground)?;
        self.cached = Some((t, value));
        Ok(value)
    }

    fn ground_speed(&mut self, t: f64) -> Result<f64, Refused<E>> {
        let h = GROUND_STEP * SAMPLE_STEP / self.case.speed.abs();
        let low = (t - h).max(0.0);
        Ok((self.ground(t + h)? - self.ground(low)?) / (t + h - low))
    }

    fn phi(&self, t: f64) -> f64 {
        self.case.phi0 + self.case.speed * t
    }

    /// BD where C jams.
    fn jam_distance(&self, side: Side) -> f64 {
        let [_, l2, l3] = self.case.lengths;
        let product = 2.0 * l2 * l3 * sin_cos(self.case.gamma_min).1;
        let sign = if side == Side::Outer { 1.0 } else { -1.0 };
        (l2 * l2 + l3 * l3 + sign * product).sqrt()
    }

    /// BD of the crank-rocker, with D at its position.
    fn pin_distance(&mut self, t: f64) -> Result<f64, Refused<E>> {
        let l4 = self.ground(t)?;
        let (sine, cosine) = sin_cos(self.phi(t));
        let l1 = self.case.lengths[0];
        Ok(hypot(l4 + l1 * cosine, l1 * sine))
    }

    fn gamma(&self, s: f64) -> f64 {
        let [_, l2, l3] = self.case.lengths;
        let cosine = (l2 * l2 + l3 * l3 - s * s) / (2.0 * l2 * l3);
        let angle = acos(cosine.clamp(-1.0, 1.0));
        angle.min(PI - angle)
    }

    /// How far BD is beyond the nearer jam distance, and the side.
    fn jam_excess(&mut self, t: f64) -> Result<(f64, Side), Refused<E>> {
        let s = self.pin_distance(t)?;
        let (outer, inner) =
            (s - self.jam_distance(Side::Outer), self.jam_distance(Side::Inner) - s);
        Ok(if outer > inner { (outer, Side::Outer) } else { (inner, Side::Inner) })
    }

    /// Distance AD while D slides; where the rod is too short, its last value.
    fn sliding_ground(&self, t: f64, side: Side) -> f64 {
        let (sine, cosine) = sin_cos(self.phi(t));
        let (l1, rod) = (self.case.lengths[0], self.jam_distance(side));
        -l1 * cosine + ((rod - l1 * sine) * (rod + l1 * sine)).max(0.0).sqrt()
    }

    /// Displacement of D from its position, positive while it slides; −∞ where the rod is too
    /// short.
    fn displacement(&mut self, t: f64, side: Side) -> Result<f64, Refused<E>> {
        let (sine, _) = sin_cos(self.phi(t));
        if (self.case.lengths[0] * sine).abs() > self.jam_distance(side) {
            return Ok(f64::NEG_INFINITY);
        }
        let gap = self.ground(t)? - self.sliding_ground(t, side);
        Ok(if side == Side::Outer { gap } else { -gap })
    }

    /// Event function: positive where the mode has ended.
    fn mode_end(&mut self, t: f64, mode: Mode) -> Result<f64, Refused<E>> {
        match mode {
            None => Ok(self.jam_excess(t)?.0),
            Some(side) => Ok(-self.displacement(t, side)?),
        }
    }

    /// First time in an interval at which the mode ends.
    fn next_event(&mut self, low: f64, high: f64, mode: Mode) -> Result<Option<f64>, Refused<E>> {
        let after_event =
            self.events.last().is_some_and(|event| event.t.to_bits() == low.to_bits());
        let start = if after_event { low + EVENT_OFFSET * (high - low) } else { low };
        if start >= high {
            return Ok(None);
        }
        if after_event && self.mode_end(start, mode)? > 0.0 {
            // The mode just entered ends at once.
            return Ok(Some(start));
        }
        let mut past_end = high;
        let last = self.mode_end(high, mode)?;
        if last.is_nan() || last <= 0.0 {
            let step = SLOPE_STEP * (high - start);
            let rises = self.mode_end(start + step, mode)? > self.mode_end(start, mode)?;
            if !(rises && last < self.mode_end(high - step, mode)?) {
                return Ok(None);
            }
            past_end = self.peak(start, high, mode)?;
            if self.mode_end(past_end, mode)? <= 0.0 {
                return Ok(None);
            }
        }
        let has_ended = |t| Ok(self.mode_end(t, mode)? > 0.0);
        let [event, _] = bisect([past_end, start], TO_ROUNDING, has_ended)?;
        Ok(Some(event))
    }

    /// A time at which an event function that rises and falls is positive, or its maximum (golden
    /// section).
    fn peak(&mut self, low: f64, high: f64, mode: Mode) -> Result<f64, Refused<E>> {
        let has_ended = |bracket: &Bracket| bracket.inner.iter().any(|point| point.1 > 0.0);
        let bracket = golden_section([low, high], has_ended, |t| self.mode_end(t, mode))?;
        Ok(bracket.best().0)
    }

    /// Applies an event to the mode and records it. Returns whether the run ends.
    fn apply_event(&mut self, t: f64, mode: &mut Mode) -> Result<bool, Refused<E>> {
        let Some(side) = *mode else {
            let side = self.jam_excess(t)?.1;
            let speeds = self.speeds(t, side)?;
            self.record_event(Kind::Jam, t, side, speeds)?;
            *mode = Some(side);
            return Ok(false);
        };
        let (sine, _) = sin_cos(self.phi(t));
        if (self.case.lengths[0] * sine).abs() >= self.jam_distance(side) * (1.0 - DEAD_POINT_RTOL)
        {
            self.record_event(Kind::DeadPoint, t, side, [[f64::NAN; 2]; 2])?;
            return Ok(true);
        }
        let [[ground, slide], [rocker, rod]] = self.speeds(t, side)?;
        self.record_event(Kind::Return, t, side, [[slide, ground], [rod, rocker]])?;
        *mode = None;
        Ok(false)
    }

    /// Velocities of D, and of rocker or rod: each as a crank-rocker and as a slider-crank.
    fn speeds(&mut self, t: f64, side: Side) -> Result<[[f64; 2]; 2], Refused<E>> {
        let (phi, l4, moving) = (self.phi(t), self.ground(t)?, self.ground_speed(t)?);
        let (sine, cosine) = sin_cos(phi);
        let ([l1, l2, l3], speed) = (self.case.lengths, self.case.speed);
        let (rod, across) = (self.jam_distance(side), l1 * sine);
        let reach = (rod * rod - across * across).sqrt();
        let sliding = l1 * sine * speed * (1.0 - l1 * cosine / reach);
        let rates = |ground_speed: f64| {
            let found = position(phi, [l1, l2, l3, l4], Assembly::Printed, [speed, ground_speed]);
            found.map_or([f64::NAN; 2], |(_, rates)| [rates.of.phi3, rates.of.phi3_first])
        };
        let ([rocker, _], [_, rod]) = (rates(moving), rates(sliding));
        Ok([[moving, sliding], [rocker, rod]])
    }

    fn record_event(
        &mut self,
        kind: Kind,
        t: f64,
        side: Side,
        [ground_speed, rod_speed]: [[f64; 2]; 2],
    ) -> Result<(), Refused<E>> {
        let ground = self.ground(t)?;
        let l4 = if kind == Kind::Jam { ground } else { self.sliding_ground(t, side) };
        let phi1 = self.phi(t);
        self.events.push(Event { kind, side, t, phi1, l4, ground, ground_speed, rod_speed });
        Ok(())
    }

    fn record_row(&mut self, t: f64, mode: Mode) -> Result<(), Refused<E>> {
        let l4 = match mode {
            Some(side) => self.sliding_ground(t, side),
            None => self.ground(t)?,
        };
        let [l1, l2, l3] = self.case.lengths;
        let (sine, cosine) = sin_cos(self.phi(t));
        let b = [l1 * cosine, l1 * sine];
        let (along, across) = (b[0] + l4, b[1]);
        let s = mode.map_or_else(|| hypot(along, across), |side| self.jam_distance(side));
        // φ₃″, from DB to the rocker.
        let phi3_second = acos(((s * s + l3 * l3 - l2 * l2) / (2.0 * s * l3)).clamp(-1.0, 1.0));
        let (sine, cosine) = sin_cos(phi3_second);
        let ratio = l3 / hypot(along, across);
        let c = [
            ratio * (along * cosine - across * sine) - l4,
            ratio * (along * sine + across * cosine),
        ];
        let gamma = self.gamma(s);
        self.rows.push(Row { t, l4, gamma, sliding: mode.is_some(), positions: [b, c] });
        Ok(())
    }
}
