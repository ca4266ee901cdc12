//! Flywheels: the speed from the energy of a cycle, and the flywheel from the fluctuation of the
//! speed.
//!
//! With K the flywheel's inertia and C = (I(0) + K) ω0² the energy integral (I. M. Matsyuk & E. M.
//! Shlyakhov, equation 3) is ω² = (2 W + C) / (I + K). So ω ≤ p everywhere means
//! C ≤ p² K + min(p² I − 2 W), ω ≥ r means C ≥ r² K + max(r² I − 2 W), and both bounds are reached:
//! two equations, linear in K and C (the tangents of F. Wittenbauer's diagram, Graphische Dynamik,
//! 1923).

use std::sync::atomic::AtomicBool;

use super::cycle::{Cycle, Extreme};
use crate::dynamics::tables::columns::wrap_to_period;
use crate::dynamics::tables::error::TableError;
use crate::dynamics::tables::passes::is_cancelled;
use crate::math::quadrature::integral;
use crate::math::root::illinois;

/// Iteration limit for an extreme speed and for the coordinate at a time; about five are needed.
const MAX_STEPS: u32 = 64;

/// Definition of the mean speed, by which the fluctuation is divided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Mean {
    /// Half the sum of the greatest and the least speed.
    #[default]
    Extremes,
    /// The period in rad divided by its time.
    Period,
}

/// A machine with a flywheel in steady motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Flywheel {
    /// The cycle without the flywheel.
    pub cycle: Cycle,
    /// Moment of inertia of the flywheel, kg·m².
    pub inertia: f64,
    /// Speed where the cycle begins, rad/s.
    pub speed0: f64,
    /// The greatest speed and its coordinate, rad/s and rad.
    pub greatest: Extreme,
    /// The least speed and its coordinate, rad/s and rad.
    pub least: Extreme,
    /// The energy constant C.
    constant: f64,
    /// Time from the start of the cycle to every knot, s.
    times: Vec<f64>,
}

impl Flywheel {
    /// Sizes the flywheel for a coefficient of speed fluctuation at a mean speed (rad/s).
    ///
    /// # Errors
    ///
    /// An invalid fluctuation or mean, or a fluctuation that needs no flywheel.
    pub fn for_fluctuation(
        cycle: Cycle,
        fluctuation: f64,
        mean: f64,
        by: Mean,
        cancel: &AtomicBool,
    ) -> Result<Self, TableError> {
        if !(fluctuation > 0.0 && fluctuation < 2.0) {
            return Err(TableError::BadFluctuation { value: fluctuation });
        }
        check_speed("mean_speed", mean)?;
        let range = fluctuation * mean;
        let slowest = match by {
            Mean::Extremes => Some(mean - 0.5 * range),
            Mean::Period => {
                let residual = |slowest: f64| {
                    let [inertia, constant] = tangents(&cycle, [slowest, slowest + range], cancel);
                    cycle.period() / duration(&cycle, [inertia, constant], cancel) - mean
                };
                illinois::find_root(residual, mean - 0.5 * range)
            }
        };
        let energy = slowest.map(|slowest| tangents(&cycle, [slowest, slowest + range], cancel));
        if let Some([inertia, constant]) = energy
            && inertia >= 0.0
        {
            if inertia.is_infinite() {
                return Err(TableError::NoFlywheel { wanted: fluctuation });
            }
            return Self::with_energy(cycle, inertia, constant, ("mean_speed", mean), cancel);
        }
        let without = Self::for_mean_speed(cycle, 0.0, mean, by, cancel)?.fluctuation(by);
        Err(TableError::AlreadyMet { without, wanted: fluctuation })
    }

    /// The motion with a given flywheel at a mean speed, rad/s.
    ///
    /// # Errors
    ///
    /// An invalid flywheel or mean, or a mean speed at which the machine would stop.
    pub fn for_mean_speed(
        cycle: Cycle,
        inertia: f64,
        mean: f64,
        by: Mean,
        cancel: &AtomicBool,
    ) -> Result<Self, TableError> {
        check_inertia(&cycle, inertia, cancel)?;
        check_speed("mean_speed", mean)?;
        // With a smaller constant the speed would not be real everywhere.
        let [greatest, least] = cycle.extremes(0.0, 2.0, cancel);
        let guess = mean * mean * (cycle.inertia(cycle.start()) + inertia);
        if guess <= f64::EPSILON * greatest.value.abs().max(least.value.abs()) {
            // The kinetic energy at this mean speed is below the rounding of the work.
            return Err(TableError::NoMean { mean });
        }
        let residual = |above: f64| {
            let constant = least.value + above;
            let mean_of_motion = match by {
                Mean::Extremes => {
                    let [a, b] = speeds(&cycle, [inertia, constant], cancel);
                    0.5 * (a.value + b.value)
                }
                Mean::Period => cycle.period() / duration(&cycle, [inertia, constant], cancel),
            };
            mean_of_motion - mean
        };
        let above = illinois::find_root(residual, guess).ok_or(TableError::NoMean { mean })?;
        Self::with_energy(cycle, inertia, least.value + above, ("mean_speed", mean), cancel)
    }

    /// The motion with a given flywheel and initial speed (rad/s).
    ///
    /// # Errors
    ///
    /// An invalid flywheel or speed, or a speed at which the machine stops within the cycle.
    pub fn for_initial_speed(
        cycle: Cycle,
        inertia: f64,
        speed0: f64,
        cancel: &AtomicBool,
    ) -> Result<Self, TableError> {
        check_inertia(&cycle, inertia, cancel)?;
        check_speed("speed0", speed0)?;
        let constant = (cycle.inertia(cycle.start()) + inertia) * speed0 * speed0;
        let [_, least] = cycle.extremes(0.0, 2.0, cancel);
        if constant <= least.value {
            let missing = 0.5 * (least.value - constant);
            return Err(TableError::Stalls { speed0, at: least.at, missing });
        }
        Self::with_energy(cycle, inertia, constant, ("speed0", speed0), cancel)
    }

    /// The motion with the energy constant C; `name` and `speed`: the user's argument, for errors.
    fn with_energy(
        cycle: Cycle,
        inertia: f64,
        constant: f64,
        (name, speed): (&'static str, f64),
        cancel: &AtomicBool,
    ) -> Result<Self, TableError> {
        check_inertia(&cycle, inertia, cancel)?;
        if !constant.is_finite() {
            return Err(TableError::Infinite { name, speed, flywheel: inertia });
        }
        let speed0 = (constant / (cycle.inertia(cycle.start()) + inertia)).sqrt();
        let [least, greatest] = speeds(&cycle, [inertia, constant], cancel);
        let mut times = vec![0.0];
        let mut sum = 0.0;
        for (piece, ends) in cycle.knots().windows(2).enumerate() {
            if is_cancelled(piece, cancel) {
                break;
            }
            sum += time_within(&cycle, [inertia, constant], piece, ends[1] - ends[0]);
            times.push(sum);
        }
        if !(sum.is_finite() && least.value > 0.0) {
            return Err(TableError::NoMean { mean: 0.5 * (least.value + greatest.value) });
        }
        Ok(Self { cycle, inertia, speed0, greatest, least, constant, times })
    }

    /// Time of a cycle, s.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.times[self.times.len() - 1]
    }

    /// The mean speed, rad/s.
    #[must_use]
    pub fn mean(&self, by: Mean) -> f64 {
        match by {
            Mean::Extremes => 0.5 * (self.greatest.value + self.least.value),
            Mean::Period => self.cycle.period() / self.period(),
        }
    }

    /// Coefficient of speed fluctuation: (greatest − least) / mean speed.
    #[must_use]
    pub fn fluctuation(&self, by: Mean) -> f64 {
        (self.greatest.value - self.least.value) / self.mean(by)
    }

    /// Speed at a coordinate, rad/s.
    #[must_use]
    pub fn speed(&self, phi: f64) -> f64 {
        let (piece, x, _) = self.cycle.locate(phi);
        speed_within(&self.cycle, [self.inertia, self.constant], piece, x)
    }

    /// Time at which a coordinate is reached, s; 0 at the start of the table.
    #[must_use]
    pub fn time(&self, phi: f64) -> f64 {
        let (piece, x, periods) = self.cycle.locate(phi);
        let since = time_within(&self.cycle, [self.inertia, self.constant], piece, x);
        periods * self.period() + self.times[piece] + since
    }

    /// The coordinate at a time, rad.
    #[must_use]
    pub fn angle(&self, time: f64) -> f64 {
        let [time, periods] = wrap_to_period(time, 0.0, self.period());
        let piece = self.times.partition_point(|&t| t <= time).clamp(1, self.times.len() - 1) - 1;
        let [low, high] = [self.cycle.knots()[piece], self.cycle.knots()[piece + 1]];
        let (since, width) = (time - self.times[piece], high - low);
        let state = [self.inertia, self.constant];
        let mut x = since / (self.times[piece + 1] - self.times[piece]) * width;
        // Newton's method. The time grows with x, so the piece is all the bracket that it needs.
        for _ in 0..MAX_STEPS {
            let residual = since - time_within(&self.cycle, state, piece, x);
            let next =
                (x + residual * speed_within(&self.cycle, state, piece, x)).clamp(0.0, width);
            if (next - x).abs() <= f64::EPSILON * high.abs().max(low.abs()) {
                break;
            }
            x = next;
        }
        low + x + periods * self.cycle.period()
    }
}

fn check_speed(name: &'static str, value: f64) -> Result<(), TableError> {
    if value > 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(TableError::BadSpeed { name, value })
    }
}

/// Checks that the flywheel is valid and the total inertia positive everywhere.
fn check_inertia(cycle: &Cycle, flywheel: f64, cancel: &AtomicBool) -> Result<(), TableError> {
    if !(flywheel >= 0.0 && flywheel.is_finite()) {
        return Err(TableError::BadInertia { value: flywheel });
    }
    let least = cycle.least_inertia(cancel);
    let value = least.value + flywheel;
    if value > 0.0 { Ok(()) } else { Err(TableError::NoInertia { flywheel, value, at: least.at }) }
}

/// The flywheel and the constant C with which these are the extreme speeds.
fn tangents(cycle: &Cycle, [least, greatest]: [f64; 2], cancel: &AtomicBool) -> [f64; 2] {
    let [low, high] = [least * least, greatest * greatest];
    let [above, _] = cycle.extremes(high, 2.0, cancel);
    let [_, below] = cycle.extremes(low, 2.0, cancel);
    let inertia = (below.value - above.value) / (high - low);
    [inertia, high * inertia + above.value]
}

/// Least and greatest speed. Dinkelbach's iteration: a quotient of two functions is extreme where
/// their difference, with that quotient as a factor, is (W. Dinkelbach, On nonlinear fractional
/// programming, 1967).
fn speeds(cycle: &Cycle, [inertia, constant]: [f64; 2], cancel: &AtomicBool) -> [Extreme; 2] {
    [0, 1].map(|which| {
        let mut best = Extreme::default();
        let mut speed2 = constant / (cycle.inertia(cycle.start()) + inertia);
        for step in 0..MAX_STEPS {
            // `extremes` has the opposite sign, so the other extreme is the one.
            let at = cycle.extremes(speed2, 2.0, cancel)[1 - which].at;
            let quotient = (2.0 * cycle.work(at) + constant) / (cycle.inertia(at) + inertia);
            // The last step changes the coordinate only.
            best = Extreme { at, value: quotient.sqrt() };
            let better = if which == 1 { quotient > speed2 } else { quotient < speed2 };
            if step > 0 && !better {
                break;
            }
            speed2 = quotient;
        }
        best
    })
}

fn speed_within(cycle: &Cycle, [flywheel, constant]: [f64; 2], piece: usize, x: f64) -> f64 {
    let [inertia, work] = cycle.inertia_and_work(piece, x);
    ((2.0 * work + constant) / (inertia + flywheel)).sqrt()
}

/// Time from a knot to a point in the piece behind it.
fn time_within(cycle: &Cycle, state: [f64; 2], piece: usize, x: f64) -> f64 {
    integral(&|x| 1.0 / speed_within(cycle, state, piece, x), 0.0, x)
}

/// Time of a cycle.
fn duration(cycle: &Cycle, state: [f64; 2], cancel: &AtomicBool) -> f64 {
    let pieces = cycle.knots().windows(2).enumerate();
    let going = pieces.take_while(|&(piece, _)| !is_cancelled(piece, cancel));
    going.map(|(piece, ends)| time_within(cycle, state, piece, ends[1] - ends[0])).sum()
}
