//! The crank-rocker that goes on as a slider-crank where friction jams it.
//!
//! What locks is not in the paper (section 3); the reading here, an assumption: joint C jams where
//! the transmission angle falls to its least; coupler and rocker then move as one rigid rod BD, and
//! the support D slides along the line of centres, until it is back in its place.

use std::f64::consts::{PI, TAU};

use libm::{acos, hypot};

use super::motion::{Assembly, position};
use crate::math::trig::sin_cos;

/// Between two looks at the crank, rad: a jam that begins and ends within that shows by its summit.
const LOOK: f64 = PI / 360.0;
/// Step of the differences for a moving ground's speed, as a part of a look.
const GROUND_STEP: f64 = 1.0e-3;
/// After an event, as a part of what is left of a look, before the next is looked for: the
/// function that told it is 0 there.
const ARMED: f64 = 1.0e-9;
/// Step of the slopes that tell whether there is a summit between two looks, as a part of one.
const SLOPE: f64 = 1.0e-6;
/// Steps toward that summit.
const SUMMIT: u32 = 40;
/// A rod within so much of its own length of not reaching the line of centres: a dead point.
const DEAD: f64 = 1.0e-12;

/// On which side C jams.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// γ₂₃ near π: D slides inward.
    Outer,
    /// γ₂₃ near 0: D slides outward.
    Inner,
}

/// What happens.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// C jams, so that D slides.
    Jam,
    /// D is back in its place, so that the rocker swings.
    Return,
    /// The rod just reaches the line of centres: the run ends.
    DeadPoint,
    /// The run ends in a slide that has not returned within a turn.
    NoReturn,
}

/// A moment at which something happens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// What.
    pub kind: Kind,
    /// On which side.
    pub side: Side,
    /// Time, s.
    pub t: f64,
    /// Crank angle, rad.
    pub phi1: f64,
    /// Distance of D from A, m.
    pub l4: f64,
    /// The ground given at that time, m.
    pub ground: f64,
    /// dl₄/dt before and after, m/s; NaN at the end of a run.
    pub ground_speed: [f64; 2],
    /// Speed of rocker or rod before and after, rad/s; NaN at the end of a run.
    pub rod_speed: [f64; 2],
}

/// One position: A is the origin, D on the negative x-axis.
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
    /// Places of B and C, m.
    pub places: [[f64; 2]; 2],
}

/// Why there is no run.
#[derive(Debug, Clone, PartialEq)]
pub enum Refused<E> {
    /// Motion is not passed on at the start: the side and the transmission angle.
    Blocked(Side, f64),
    /// The coupler does not reach at the start: BD.
    OutOfReach(f64),
    /// What the ground's function said.
    Ground(E),
}

/// What is followed.
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
    /// Turns to be followed, above 0.
    pub turns: f64,
}

/// Follows the mechanism with the ground as a function of time (m, positive).
///
/// # Errors
///
/// [`Refused`].
pub fn run<E>(
    case: &Case,
    ground: impl FnMut(f64) -> Result<f64, E>,
) -> Result<(Vec<Row>, Vec<Event>), Refused<E>> {
    let mut follower =
        Follower { case: *case, given: ground, last: None, rows: Vec::new(), events: Vec::new() };
    follower.run()?;
    Ok((follower.rows, follower.events))
}

struct Follower<F> {
    case: Case,
    given: F,
    /// The ground's last value.
    last: Option<(f64, f64)>,
    rows: Vec<Row>,
    events: Vec<Event>,
}

/// Nothing slides, or D does.
type Mode = Option<Side>;

impl<E, F: FnMut(f64) -> Result<f64, E>> Follower<F> {
    fn run(&mut self) -> Result<(), Refused<E>> {
        let (first, side) = self.over(0.0)?;
        if first.is_nan() || first >= 0.0 {
            return Err(self.refuse(side)?);
        }
        let end = TAU * self.case.turns / self.case.speed.abs();
        let looks = (end * self.case.speed.abs() / LOOK).ceil().max(2.0);
        let mut mode = None;
        self.row(0.0, mode)?;
        let (mut before, mut look) = (0.0, 0.0);
        while look < looks {
            look += 1.0;
            let after = end * look / looks;
            let mut at = before;
            // More than one thing may happen between two looks.
            while let Some(moment) = self.next_event(at, after, mode)? {
                at = moment;
                self.row(at, mode)?;
                let dead = self.pass(at, &mut mode)?;
                if dead {
                    return Ok(());
                }
                self.row(at, mode)?;
            }
            self.row(after, mode)?;
            before = after;
        }
        let since = self.events.last().map_or(end, |event| event.t);
        if let Some(side) = mode
            && end - since > TAU / self.case.speed.abs()
        {
            self.note(Kind::NoReturn, end, side, [[f64::NAN; 2]; 2])?;
        }
        Ok(())
    }

    fn refuse(&mut self, side: Side) -> Result<Refused<E>, Refused<E>> {
        let s = self.distance(0.0)?;
        let [_, l2, l3] = self.case.lengths;
        if !((l2 - l3).abs() <= s && s <= l2 + l3) {
            return Ok(Refused::OutOfReach(s));
        }
        Ok(Refused::Blocked(side, self.gamma(s)))
    }

    fn ground(&mut self, t: f64) -> Result<f64, Refused<E>> {
        if let Some((at, value)) = self.last
            && at.to_bits() == t.to_bits()
        {
            return Ok(value);
        }
        let value = (self.given)(t).map_err(Refused::Ground)?;
        self.last = Some((t, value));
        Ok(value)
    }

    fn ground_speed(&mut self, t: f64) -> Result<f64, Refused<E>> {
        let h = GROUND_STEP * LOOK / self.case.speed.abs();
        let low = (t - h).max(0.0);
        Ok((self.ground(t + h)? - self.ground(low)?) / (t + h - low))
    }

    fn phi(&self, t: f64) -> f64 {
        self.case.phi0 + self.case.speed * t
    }

    /// BD where C jams.
    fn limit(&self, side: Side) -> f64 {
        let [_, l2, l3] = self.case.lengths;
        let product = 2.0 * l2 * l3 * sin_cos(self.case.gamma_min).1;
        let sign = if side == Side::Outer { 1.0 } else { -1.0 };
        (l2 * l2 + l3 * l3 + sign * product).sqrt()
    }

    /// BD with the rocker's support in its place.
    fn distance(&mut self, t: f64) -> Result<f64, Refused<E>> {
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

    /// How far BD is beyond the nearer limit, and which one.
    fn over(&mut self, t: f64) -> Result<(f64, Side), Refused<E>> {
        let s = self.distance(t)?;
        let (outer, inner) = (s - self.limit(Side::Outer), self.limit(Side::Inner) - s);
        Ok(if outer > inner { (outer, Side::Outer) } else { (inner, Side::Inner) })
    }

    /// Place of D while it slides; where the rod is too short its last.
    fn slide(&self, t: f64, side: Side) -> f64 {
        let (sine, cosine) = sin_cos(self.phi(t));
        let (l1, rod) = (self.case.lengths[0], self.limit(side));
        -l1 * cosine + ((rod - l1 * sine) * (rod + l1 * sine)).max(0.0).sqrt()
    }

    /// How far D is from its place, positive while it slides; negative where it cannot.
    fn away(&mut self, t: f64, side: Side) -> Result<f64, Refused<E>> {
        let (sine, _) = sin_cos(self.phi(t));
        if (self.case.lengths[0] * sine).abs() > self.limit(side) {
            return Ok(f64::NEG_INFINITY);
        }
        let gap = self.ground(t)? - self.slide(t, side);
        Ok(if side == Side::Outer { gap } else { -gap })
    }

    /// Positive where the mode has ended.
    fn ends(&mut self, t: f64, mode: Mode) -> Result<f64, Refused<E>> {
        match mode {
            None => Ok(self.over(t)?.0),
            Some(side) => Ok(-self.away(t, side)?),
        }
    }

    /// The first time in an interval at which the mode ends.
    fn next_event(&mut self, low: f64, high: f64, mode: Mode) -> Result<Option<f64>, Refused<E>> {
        let fresh = self.events.last().is_some_and(|event| event.t.to_bits() == low.to_bits());
        let start = if fresh { low + ARMED * (high - low) } else { low };
        if start >= high {
            return Ok(None);
        }
        if fresh && self.ends(start, mode)? > 0.0 {
            // It was entered for no more than that.
            return Ok(Some(start));
        }
        let mut top = high;
        let last = self.ends(high, mode)?;
        if last.is_nan() || last <= 0.0 {
            let step = SLOPE * (high - start);
            let rises = self.ends(start + step, mode)? > self.ends(start, mode)?;
            if !(rises && last < self.ends(high - step, mode)?) {
                return Ok(None);
            }
            top = self.summit(start, high, mode)?;
            if self.ends(top, mode)? <= 0.0 {
                return Ok(None);
            }
        }
        let (mut low, mut high) = (start, top);
        loop {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                return Ok(Some(high));
            }
            if self.ends(middle, mode)? > 0.0 { high = middle } else { low = middle }
        }
    }

    /// A place where a mode that rises and falls has ended, or the highest (golden section).
    fn summit(&mut self, low: f64, high: f64, mode: Mode) -> Result<f64, Refused<E>> {
        /// (√5 − 1)/2.
        const PART: f64 = 0.618_033_988_749_894_8;
        let (mut a, mut b) = (low, high);
        let (mut c, mut d) = (b - PART * (b - a), a + PART * (b - a));
        let (mut at_c, mut at_d) = (self.ends(c, mode)?, self.ends(d, mode)?);
        for _ in 0..SUMMIT {
            if at_c > 0.0 || at_d > 0.0 {
                break;
            }
            if at_c > at_d {
                (b, d, at_d) = (d, c, at_c);
                c = b - PART * (b - a);
                at_c = self.ends(c, mode)?;
            } else {
                (a, c, at_c) = (c, d, at_d);
                d = a + PART * (b - a);
                at_d = self.ends(d, mode)?;
            }
        }
        Ok(if at_c > at_d { c } else { d })
    }

    /// Goes through an event; whether the run ends.
    fn pass(&mut self, t: f64, mode: &mut Mode) -> Result<bool, Refused<E>> {
        let Some(side) = *mode else {
            let side = self.over(t)?.1;
            let speeds = self.speeds(t, side)?;
            self.note(Kind::Jam, t, side, speeds)?;
            *mode = Some(side);
            return Ok(false);
        };
        let (sine, _) = sin_cos(self.phi(t));
        if (self.case.lengths[0] * sine).abs() >= self.limit(side) * (1.0 - DEAD) {
            self.note(Kind::DeadPoint, t, side, [[f64::NAN; 2]; 2])?;
            return Ok(true);
        }
        let [[g, slide], [rocker, rod]] = self.speeds(t, side)?;
        self.note(Kind::Return, t, side, [[slide, g], [rod, rocker]])?;
        *mode = None;
        Ok(false)
    }

    /// Speeds of D and of the rocker or rod: as a crank-rocker, as a slider-crank.
    fn speeds(&mut self, t: f64, side: Side) -> Result<[[f64; 2]; 2], Refused<E>> {
        let (phi, l4, moving) = (self.phi(t), self.ground(t)?, self.ground_speed(t)?);
        let (sine, cosine) = sin_cos(phi);
        let ([l1, l2, l3], speed) = (self.case.lengths, self.case.speed);
        let (rod, across) = (self.limit(side), l1 * sine);
        let reach = (rod * rod - across * across).sqrt();
        let sliding = l1 * sine * speed * (1.0 - l1 * cosine / reach);
        let rates = |ground_speed: f64| {
            let found = position(phi, [l1, l2, l3, l4], Assembly::Printed, [speed, ground_speed]);
            found.map_or([f64::NAN; 2], |(_, rates)| [rates.of.phi3, rates.of.phi3_first])
        };
        let ([rocker, _], [_, rod]) = (rates(moving), rates(sliding));
        Ok([[moving, sliding], [rocker, rod]])
    }

    fn note(
        &mut self,
        kind: Kind,
        t: f64,
        side: Side,
        [ground_speed, rod_speed]: [[f64; 2]; 2],
    ) -> Result<(), Refused<E>> {
        let ground = self.ground(t)?;
        let l4 = if kind == Kind::Jam { ground } else { self.slide(t, side) };
        let phi1 = self.phi(t);
        self.events.push(Event { kind, side, t, phi1, l4, ground, ground_speed, rod_speed });
        Ok(())
    }

    fn row(&mut self, t: f64, mode: Mode) -> Result<(), Refused<E>> {
        let l4 = match mode {
            Some(side) => self.slide(t, side),
            None => self.ground(t)?,
        };
        let [l1, l2, l3] = self.case.lengths;
        let (sine, cosine) = sin_cos(self.phi(t));
        let b = [l1 * cosine, l1 * sine];
        let (along, across) = (b[0] + l4, b[1]);
        let s = mode.map_or_else(|| hypot(along, across), |side| self.limit(side));
        // The rocker is turned from DB by φ₃″.
        let turn = acos(((s * s + l3 * l3 - l2 * l2) / (2.0 * s * l3)).clamp(-1.0, 1.0));
        let (sine, cosine) = sin_cos(turn);
        let part = l3 / hypot(along, across);
        let c =
            [part * (along * cosine - across * sine) - l4, part * (along * sine + across * cosine)];
        let gamma = self.gamma(s);
        self.rows.push(Row { t, l4, gamma, sliding: mode.is_some(), places: [b, c] });
        Ok(())
    }
}
