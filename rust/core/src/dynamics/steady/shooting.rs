//! The search for a periodic motion: the speed at the beginning of a period with which it is the same
//! at the end.

use super::error::SteadyError;
use super::period::{Begin, Period, PeriodOutcome};
use super::steady::{NOISE, Shooting};
use crate::dynamics::run::callbacks::Callbacks;
use crate::dynamics::run::model::ReducedModel;

/// Steps toward the periodic motion, at most; it takes some five.
const STEPS: u32 = 60;
/// A step by less than this part is the last: what is left is its square.
const SETTLED: f64 = 1.0e-9;
/// By how much speed² may fall in one step: what is looked for is the first motion below the idle
/// speed, which is the stable one.
const FALL: f64 = 0.7;
/// A speed that is known to no more than this part is not told by the motor: a period's end then
/// depends on its beginning alone.
const KNOWN: f64 = 1.0e-5;
/// Part of the work of a period that may be left over then: motors are given with so many digits.
const BALANCED: f64 = 1.0e-2;

type Found<E> = Result<(Begin, Period), SteadyError<E>>;

impl<S: ReducedModel, O: Callbacks> Shooting<'_, '_, S, O> {
    /// Finds the periodic motion, from a guess (speed² and moment) if there is one.
    pub(crate) fn find(&mut self, guess: Option<Begin>) -> Found<O::Error> {
        let motors = self.equation.motors;
        let idle = motors.iter().find_map(crate::dynamics::motor::Motor::idle_speed);
        let speed = self.search.speed.or(idle).ok_or(SteadyError::NeedsSpeed)?;
        let begin = guess.unwrap_or(Begin { speed2: speed * speed, moment: 0.0, t: 0.0 });
        if motors.is_empty() {
            return self.at_speed(speed, begin);
        }
        let (begin, first) = self.passing(begin)?;
        if first.depends {
            return self.self_found(begin, first);
        }
        let left = self.left_over(begin, &first);
        if left.abs() > BALANCED * first.turnover {
            let motor = first.drive / self.search.span;
            let needed = motor - left / self.search.span;
            return Err(SteadyError::Unbalanced { motor, needed });
        }
        match self.search.speed {
            Some(speed) => self.at_speed(speed, begin),
            None => Err(SteadyError::NeedsSpeed),
        }
    }

    /// Energy that a period gains.
    fn left_over(&mut self, begin: Begin, period: &Period) -> f64 {
        let _ =
            self.equation.begin(self.search.q, &[self.search.span.signum() * begin.speed2.sqrt()]);
        let inertia = match self.equation.place(&[self.search.q]) {
            Ok(()) => self.equation.reduced.inertia[0],
            Err(_) => f64::NAN,
        };
        0.5 * inertia * (period.speed2 - begin.speed2)
    }

    /// The slowest beginning at or above this one, by powers of 4, that goes through the period.
    fn passing(&mut self, mut begin: Begin) -> Found<O::Error> {
        let from = begin.speed2.sqrt();
        let mut stop = self.search.q;
        for _ in 0..STEPS {
            match self.pass(begin)? {
                PeriodOutcome::Whole(period) => return Ok((begin, period)),
                PeriodOutcome::Stops { q } => {
                    stop = q;
                    begin.speed2 *= 4.0;
                }
            }
        }
        Err(SteadyError::Stops { q: stop, from })
    }

    /// Where motors or loads depend on the speed: a zero of the gain of speed² over a period,
    /// between a speed at which it falls and one at which it grows, by Newton's steps.
    fn self_found(&mut self, begin: Begin, first: Period) -> Found<O::Error> {
        let from = begin.speed2.sqrt();
        let idle = self.equation.motors.iter().find_map(crate::dynamics::motor::Motor::idle_speed);
        let idle2 = idle.map_or(0.0, |idle| idle * idle);
        let (mut begin, mut period) = (begin, first);
        // Where it falls from on, and where it grows or the machine stops.
        let (mut high, mut low) = (f64::INFINITY, 0.0);
        let (mut grows, mut stop) = (false, None);
        for _ in 0..2 * STEPS {
            let gain = period.speed2 - begin.speed2;
            let slope = period.speed2_by[0] - 1.0;
            let newton = begin.speed2 - gain / slope;
            // What the errors of a period make of it.
            let noise = NOISE * self.search.relative / slope.abs();
            let settled = SETTLED.max(noise) * begin.speed2;
            if slope < 0.0 && (newton - begin.speed2).abs() <= settled {
                if noise > KNOWN.max(10.0 * NOISE * self.search.relative) {
                    return Err(SteadyError::Weak { part: -slope });
                }
                let last = Begin { speed2: newton, ..begin };
                return match self.pass(last)? {
                    PeriodOutcome::Whole(period) => Ok((last, period)),
                    PeriodOutcome::Stops { q } => Err(SteadyError::Stops { q, from }),
                };
            }
            // Above the speed without load a motor brakes, if less and less.
            if gain < 0.0 && (slope < 0.0 || begin.speed2 > idle2) {
                high = begin.speed2;
            } else if gain >= 0.0 {
                (low, grows) = (begin.speed2, true);
            } else {
                // It falls, the more so the slower: below the unstable motion.
                low = begin.speed2;
            }
            let between = newton > low && newton < high && slope < 0.0;
            let mut next = match (between, high.is_finite()) {
                (true, _) => newton,
                (false, true) => 0.5 * (low + high),
                (false, false) => 2.0 * begin.speed2,
            };
            next = next.max(FALL * begin.speed2).min(4.0 * begin.speed2);
            loop {
                if high.is_finite() && high - low <= SETTLED * high {
                    return Err(match stop {
                        Some(q) if !grows => SteadyError::Stops { q, from },
                        _ => SteadyError::CannotCarry { from },
                    });
                }
                if !next.is_finite() || next > 1e30 * first.speed2.max(from * from) {
                    return Err(SteadyError::RunsAway { speed: begin.speed2.sqrt() });
                }
                begin.speed2 = next;
                match self.pass(begin)? {
                    PeriodOutcome::Whole(own) => {
                        period = own;
                        break;
                    }
                    PeriodOutcome::Stops { q } => {
                        (low, stop) = (next, Some(q));
                        next = if high.is_finite() { 0.5 * (low + high) } else { 2.0 * next };
                    }
                }
            }
        }
        Err(SteadyError::CannotCarry { from })
    }

    /// A motion of this mean speed over the period, and the constant moment that it takes.
    fn at_speed(&mut self, speed: f64, guess: Begin) -> Found<O::Error> {
        self.prescribed = true;
        let time = self.search.span / speed;
        let first =
            Begin { moment: guess.moment, speed2: guess.speed2.max(speed * speed), ..guess };
        let (mut begin, mut period) = self.passing(first)?;
        if guess.moment == 0.0 {
            // In balance at so great a speed that the machine does not stop.
            begin.moment -= self.left_over(begin, &period) / self.search.span;
            (begin, period) = self.passing(begin)?;
        }
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let gaps = [period.speed2 - begin.speed2, period.time - time];
            let ([a, b], [c, d]) =
                ([period.speed2_by[0] - 1.0, period.speed2_by[1]], period.time_by);
            let determinant = a * d - b * c;
            let by_start = (b * gaps[1] - d * gaps[0]) / determinant;
            let by_moment = (c * gaps[0] - a * gaps[1]) / determinant;
            let mut part = 1.0;
            let step = by_start.abs() / begin.speed2;
            if !step.is_finite() {
                break;
            }
            loop {
                let next = Begin {
                    speed2: begin.speed2 + part * by_start,
                    moment: begin.moment + part * by_moment,
                    ..begin
                };
                // Not to less than a fourth at once: there the machine may stop.
                let is_near = next.speed2 > 0.25 * begin.speed2;
                if is_near && let PeriodOutcome::Whole(own) = self.pass(next)? {
                    (begin, period) = (next, own);
                    break;
                }
                part *= 0.5;
                if part < 1e-6 {
                    let from = begin.speed2.sqrt();
                    return Err(SteadyError::Stops { q: self.search.q, from });
                }
            }
            // As long as it gets better, but not beyond what rounding lets it.
            let settled = SETTLED.max(self.search.relative);
            if step <= settled && (step >= 0.5 * last || step <= 1e-3 * settled) {
                let met = (period.time - time).abs() <= settled * time.abs()
                    && (period.speed2 - begin.speed2).abs() <= settled * begin.speed2;
                return if met {
                    Ok((begin, period))
                } else {
                    Err(SteadyError::NotMet { speed, mean: self.search.mean })
                };
            }
            last = step;
        }
        Err(SteadyError::NotMet { speed, mean: self.search.mean })
    }
}
