//! Shooting: finds the initial speed with which a period closes.

use super::error::SteadyError;
use super::period::{Period, PeriodOutcome, PeriodStart};
use super::steady::{NOISE, Shooting};
use crate::dynamics::run::callbacks::Callbacks;
use crate::dynamics::run::model::ReducedModel;

/// Limit of Newton steps; about five are needed.
const MAX_STEPS: u32 = 60;
/// A Newton step smaller than this is the last: the remaining error is its square.
const CONVERGED_RTOL: f64 = 1.0e-9;
/// Greatest fall of speed² in one step: the search is for the first motion below the idle speed, the stable
/// one.
const MAX_FALL: f64 = 0.7;
/// With more relative noise in speed² than this, the motor does not determine the speed: the end of
/// a period then depends on its start alone.
const MAX_RELATIVE_NOISE: f64 = 1.0e-5;
/// Imbalance allowed where nothing depends on the speed, as a part of the period's work: motors are
/// given with a few digits.
const BALANCE_RTOL: f64 = 1.0e-2;

type Solution<E> = Result<(PeriodStart, Period), SteadyError<E>>;

impl<S: ReducedModel, O: Callbacks> Shooting<'_, '_, S, O> {
    /// Finds the periodic motion, from a guess of speed² and moment, if any.
    pub(crate) fn solve(&mut self, guess: Option<PeriodStart>) -> Solution<O::Error> {
        let motors = self.equation.motors;
        let idle = motors.iter().find_map(crate::dynamics::motor::Motor::idle_speed);
        let speed = self.options.speed.or(idle).ok_or(SteadyError::NeedsSpeed)?;
        let start = guess.unwrap_or(PeriodStart { speed2: speed * speed, moment: 0.0, t: 0.0 });
        if motors.is_empty() {
            return self.solve_prescribed_speed(speed, start);
        }
        let (start, first) = self.slowest_full_period(start)?;
        if first.depends_on_speed {
            return self.solve_free_speed(start, first);
        }
        let gain = self.energy_gain(start, &first);
        if gain.abs() > BALANCE_RTOL * first.turnover {
            let motor = first.drive / self.options.span;
            let needed = motor - gain / self.options.span;
            return Err(SteadyError::Unbalanced { motor, needed });
        }
        match self.options.speed {
            Some(speed) => self.solve_prescribed_speed(speed, start),
            None => Err(SteadyError::NeedsSpeed),
        }
    }

    /// Kinetic energy gained over a period.
    fn energy_gain(&mut self, start: PeriodStart, period: &Period) -> f64 {
        let _ = self
            .equation
            .begin(self.options.q, &[self.options.span.signum() * start.speed2.sqrt()]);
        let inertia = match self.equation.set_configuration(&[self.options.q]) {
            Ok(()) => self.equation.reduced.inertia[0],
            Err(_) => f64::NAN,
        };
        0.5 * inertia * (period.speed2 - start.speed2)
    }

    /// The slowest start at or above this one, by powers of 4, that gets through the period.
    fn slowest_full_period(&mut self, mut start: PeriodStart) -> Solution<O::Error> {
        let from = start.speed2.sqrt();
        let mut stop = self.options.q;
        for _ in 0..MAX_STEPS {
            match self.run_period(start)? {
                PeriodOutcome::Whole(period) => return Ok((start, period)),
                PeriodOutcome::Stops { q } => {
                    stop = q;
                    start.speed2 *= 4.0;
                }
            }
        }
        Err(SteadyError::Stops { q: stop, from })
    }

    /// Finds the speed that motors and loads determine: a zero of the gain of speed² over a period,
    /// by Newton's method, bracketed by a speed at which it falls and one at which it grows. (Not
    /// `math::root`'s, because a machine that stops has no gain, and each slope comes with its value.)
    fn solve_free_speed(&mut self, start: PeriodStart, first: Period) -> Solution<O::Error> {
        let from = start.speed2.sqrt();
        let idle = self.equation.motors.iter().find_map(crate::dynamics::motor::Motor::idle_speed);
        let idle2 = idle.map_or(0.0, |idle| idle * idle);
        let (mut start, mut period) = (start, first);
        // The gain is negative from `high` on; at `low` it is positive or the machine stops.
        let (mut high, mut low) = (f64::INFINITY, 0.0);
        let (mut grows, mut stop) = (false, None);
        for _ in 0..2 * MAX_STEPS {
            let gain = period.speed2 - start.speed2;
            let slope = period.speed2_by[0] - 1.0;
            let newton = start.speed2 - gain / slope;
            // The relative error of speed² that the errors of a period cause.
            let noise = NOISE * self.options.relative / slope.abs();
            let settled = CONVERGED_RTOL.max(noise) * start.speed2;
            if slope < 0.0 && (newton - start.speed2).abs() <= settled {
                if noise > MAX_RELATIVE_NOISE.max(10.0 * NOISE * self.options.relative) {
                    return Err(SteadyError::PoorlyDetermined { part: -slope });
                }
                let last = PeriodStart { speed2: newton, ..start };
                return match self.run_period(last)? {
                    PeriodOutcome::Whole(period) => Ok((last, period)),
                    PeriodOutcome::Stops { q } => Err(SteadyError::Stops { q, from }),
                };
            }
            // Above the idle speed a motor brakes, even where its braking moment decreases with the
            // speed.
            if gain < 0.0 && (slope < 0.0 || start.speed2 > idle2) {
                high = start.speed2;
            } else if gain >= 0.0 {
                (low, grows) = (start.speed2, true);
            } else {
                // The slower, the faster it falls: this is below the unstable motion.
                low = start.speed2;
            }
            let is_bracketed = newton > low && newton < high && slope < 0.0;
            let mut next = match (is_bracketed, high.is_finite()) {
                (true, _) => newton,
                (false, true) => 0.5 * (low + high),
                (false, false) => 2.0 * start.speed2,
            };
            next = next.max(MAX_FALL * start.speed2).min(4.0 * start.speed2);
            loop {
                if high.is_finite() && high - low <= CONVERGED_RTOL * high {
                    return Err(match stop {
                        Some(q) if !grows => SteadyError::Stops { q, from },
                        _ => SteadyError::CannotCarry { from },
                    });
                }
                if !next.is_finite() || next > 1e30 * first.speed2.max(from * from) {
                    return Err(SteadyError::RunsAway { speed: start.speed2.sqrt() });
                }
                start.speed2 = next;
                match self.run_period(start)? {
                    PeriodOutcome::Whole(next_period) => {
                        period = next_period;
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

    /// Finds the motion with this mean speed over the period, and the constant moment it needs.
    fn solve_prescribed_speed(&mut self, speed: f64, guess: PeriodStart) -> Solution<O::Error> {
        self.prescribed = true;
        let time = self.options.span / speed;
        let first =
            PeriodStart { moment: guess.moment, speed2: guess.speed2.max(speed * speed), ..guess };
        let (mut start, mut period) = self.slowest_full_period(first)?;
        if guess.moment == 0.0 {
            // First the moment in balance, at a speed so high that the machine does not stop.
            start.moment -= self.energy_gain(start, &period) / self.options.span;
            (start, period) = self.slowest_full_period(start)?;
        }
        let mut last = f64::INFINITY;
        for _ in 0..MAX_STEPS {
            let gaps = [period.speed2 - start.speed2, period.time - time];
            let ([a, b], [c, d]) =
                ([period.speed2_by[0] - 1.0, period.speed2_by[1]], period.time_by);
            let determinant = a * d - b * c;
            let by_start = (b * gaps[1] - d * gaps[0]) / determinant;
            let by_moment = (c * gaps[0] - a * gaps[1]) / determinant;
            let mut damping = 1.0;
            let step = by_start.abs() / start.speed2;
            if !step.is_finite() {
                break;
            }
            loop {
                let next = PeriodStart {
                    speed2: start.speed2 + damping * by_start,
                    moment: start.moment + damping * by_moment,
                    ..start
                };
                // Not below a fourth at once: the machine may stop there.
                let is_near = next.speed2 > 0.25 * start.speed2;
                if is_near && let PeriodOutcome::Whole(next_period) = self.run_period(next)? {
                    (start, period) = (next, next_period);
                    break;
                }
                damping *= 0.5;
                if damping < 1e-6 {
                    let from = start.speed2.sqrt();
                    return Err(SteadyError::Stops { q: self.options.q, from });
                }
            }
            // Iterate while it improves, until rounding stops it.
            let settled = CONVERGED_RTOL.max(self.options.relative);
            if step <= settled && (step >= 0.5 * last || step <= 1e-3 * settled) {
                let closes = (period.time - time).abs() <= settled * time.abs()
                    && (period.speed2 - start.speed2).abs() <= settled * start.speed2;
                return if closes {
                    Ok((start, period))
                } else {
                    Err(SteadyError::MeanNotReached { speed, mean: self.options.mean })
                };
            }
            last = step;
        }
        Err(SteadyError::MeanNotReached { speed, mean: self.options.mean })
    }
}
