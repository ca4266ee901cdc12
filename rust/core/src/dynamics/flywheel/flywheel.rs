//! Flywheels: from the energy of a turn to the speed, and from the fluctuation of that to the
//! flywheel.
//!
//! With K the flywheel's inertia and C = (I(0) + K) ω0² the energy integral (I. M. Matsyuk & E. M.
//! Shlyakhov, equation 3) is ω² = (2 W + C) / (I + K). So ω ≤ p everywhere means
//! C ≤ p² K + min(p² I − 2 W), ω ≥ r means C ≥ r² K + max(r² I − 2 W), and both are reached: two
//! equations, linear in K and C (the tangents of F. Wittenbauer's diagram, Graphische Dynamik, 1923).

use super::cycle::{Cycle, Extreme, within_period};
use crate::dynamics::tables::error::TableError;
use crate::math::quadrature::integral;
use crate::math::root;

/// Steps toward an extreme of the speed, at most; it takes some five.
const STEPS: u32 = 64;

/// What the mean speed is, by which the fluctuation is divided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Mean {
    /// Half the sum of the greatest and the least.
    #[default]
    Extremes,
    /// The turn by its time.
    Period,
}

/// A machine with a flywheel in steady motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Flywheel {
    /// One turn without it.
    pub turn: Cycle,
    /// Its moment of inertia, kg·m².
    pub inertia: f64,
    /// Speed where the turn begins, rad/s.
    pub speed0: f64,
    /// The greatest speed and its place, rad/s and rad.
    pub greatest: Extreme,
    /// The least.
    pub least: Extreme,
    /// C.
    constant: f64,
    /// Time from the beginning of the turn to every knot, s.
    times: Vec<f64>,
}

impl Flywheel {
    /// The flywheel with which the speed varies by this part of its mean (rad/s).
    ///
    /// # Errors
    ///
    /// A fluctuation or mean that cannot be, or one that needs no flywheel.
    pub fn sized(turn: Cycle, fluctuation: f64, mean: f64, by: Mean) -> Result<Self, TableError> {
        if !(fluctuation > 0.0 && fluctuation < 2.0) {
            return Err(TableError::BadFluctuation { value: fluctuation });
        }
        check_speed("mean_speed", mean)?;
        let range = fluctuation * mean;
        let least = match by {
            Mean::Extremes => Some(mean - 0.5 * range),
            Mean::Period => {
                let lack = |least: f64| {
                    let [inertia, constant] = tangents(&turn, [least, least + range]);
                    turn.period() / duration(&turn, inertia, constant) - mean
                };
                root::find_root(lack, mean - 0.5 * range)
            }
        };
        let met = least.map(|least| tangents(&turn, [least, least + range]));
        if let Some([inertia, constant]) = met
            && inertia >= 0.0
        {
            return Self::of(turn, inertia, constant, ("mean_speed", mean));
        }
        let without = Self::driven(turn, 0.0, mean, by)?.fluctuation(by);
        Err(TableError::AlreadyMet { without, wanted: fluctuation })
    }

    /// A given flywheel at a given mean speed, rad/s.
    ///
    /// # Errors
    ///
    /// A flywheel or mean that cannot be, or a mean at which the machine would stop.
    pub fn driven(turn: Cycle, inertia: f64, mean: f64, by: Mean) -> Result<Self, TableError> {
        check_inertia(&turn, inertia)?;
        check_speed("mean_speed", mean)?;
        // Below, the speed would not be real everywhere.
        let [greatest, least] = turn.extremes(0.0, 2.0);
        let guess = mean * mean * (turn.inertia(turn.start()) + inertia);
        if guess <= f64::EPSILON * greatest.value.abs().max(least.value.abs()) {
            // Beside such energies that of the mean speed is rounding.
            return Err(TableError::NoMean { mean });
        }
        let lack = |above: f64| {
            let constant = least.value + above;
            let own = match by {
                Mean::Extremes => {
                    let [a, b] = speeds(&turn, inertia, constant);
                    0.5 * (a.value + b.value)
                }
                Mean::Period => turn.period() / duration(&turn, inertia, constant),
            };
            own - mean
        };
        let above = root::find_root(lack, guess).ok_or(TableError::NoMean { mean })?;
        Self::of(turn, inertia, least.value + above, ("mean_speed", mean))
    }

    /// A given flywheel with a given speed (rad/s) where the turn begins.
    ///
    /// # Errors
    ///
    /// A flywheel or speed that cannot be, or with which the machine stops on the way.
    pub fn given(turn: Cycle, inertia: f64, speed0: f64) -> Result<Self, TableError> {
        check_inertia(&turn, inertia)?;
        check_speed("speed0", speed0)?;
        let constant = (turn.inertia(turn.start()) + inertia) * speed0 * speed0;
        let [_, least] = turn.extremes(0.0, 2.0);
        if constant <= least.value {
            let missing = 0.5 * (least.value - constant);
            return Err(TableError::Stalls { speed0, at: least.at, missing });
        }
        Self::of(turn, inertia, constant, ("speed0", speed0))
    }

    /// At a speed that was asked for by name.
    fn of(
        turn: Cycle,
        inertia: f64,
        constant: f64,
        (name, speed): (&'static str, f64),
    ) -> Result<Self, TableError> {
        check_inertia(&turn, inertia)?;
        if !constant.is_finite() {
            return Err(TableError::Infinite { name, speed, flywheel: inertia });
        }
        let speed0 = (constant / (turn.inertia(turn.start()) + inertia)).sqrt();
        let [least, greatest] = speeds(&turn, inertia, constant);
        let mut times = vec![0.0];
        let mut sum = 0.0;
        for (piece, ends) in turn.knots().windows(2).enumerate() {
            sum += time_within(&turn, [inertia, constant], piece, ends[1] - ends[0]);
            times.push(sum);
        }
        if !(sum.is_finite() && least.value > 0.0) {
            return Err(TableError::NoMean { mean: 0.5 * (least.value + greatest.value) });
        }
        Ok(Self { turn, inertia, speed0, greatest, least, constant, times })
    }

    /// Time of a turn, s.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.times[self.times.len() - 1]
    }

    /// The mean speed, rad/s.
    #[must_use]
    pub fn mean(&self, by: Mean) -> f64 {
        match by {
            Mean::Extremes => 0.5 * (self.greatest.value + self.least.value),
            Mean::Period => self.turn.period() / self.period(),
        }
    }

    /// How much the speed varies, as a part of its mean.
    #[must_use]
    pub fn fluctuation(&self, by: Mean) -> f64 {
        (self.greatest.value - self.least.value) / self.mean(by)
    }

    /// Speed at a coordinate, rad/s.
    #[must_use]
    pub fn speed(&self, phi: f64) -> f64 {
        let (piece, x, _) = self.turn.place(phi);
        speed_within(&self.turn, [self.inertia, self.constant], piece, x)
    }

    /// Time at which a coordinate is reached, s; 0 where the table begins.
    #[must_use]
    pub fn time(&self, phi: f64) -> f64 {
        let (piece, x, whole) = self.turn.place(phi);
        let within = time_within(&self.turn, [self.inertia, self.constant], piece, x);
        whole * self.period() + self.times[piece] + within
    }

    /// The coordinate at a time, rad.
    #[must_use]
    pub fn angle(&self, time: f64) -> f64 {
        let [within, whole] = within_period(time, 0.0, self.period());
        let piece = self.times.partition_point(|&t| t <= within).clamp(1, self.times.len() - 1) - 1;
        let [low, high] = [self.turn.knots()[piece], self.turn.knots()[piece + 1]];
        let (since, width) = (within - self.times[piece], high - low);
        let state = [self.inertia, self.constant];
        let mut x = since / (self.times[piece + 1] - self.times[piece]) * width;
        for _ in 0..STEPS {
            let lack = since - time_within(&self.turn, state, piece, x);
            let next = (x + lack * speed_within(&self.turn, state, piece, x)).clamp(0.0, width);
            if (next - x).abs() <= f64::EPSILON * high.abs().max(low.abs()) {
                break;
            }
            x = next;
        }
        low + x + whole * self.turn.period()
    }
}

fn check_speed(name: &'static str, value: f64) -> Result<(), TableError> {
    if value > 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(TableError::BadSpeed { name, value })
    }
}

/// Refuses a flywheel that is none, or with which a machine has no inertia somewhere.
fn check_inertia(turn: &Cycle, flywheel: f64) -> Result<(), TableError> {
    if !(flywheel >= 0.0 && flywheel.is_finite()) {
        return Err(TableError::BadInertia { value: flywheel });
    }
    let least = turn.least_inertia();
    let value = least.value + flywheel;
    if value > 0.0 { Ok(()) } else { Err(TableError::NoInertia { flywheel, value, at: least.at }) }
}

/// Flywheel and C for which these are the extreme speeds.
fn tangents(turn: &Cycle, [least, greatest]: [f64; 2]) -> [f64; 2] {
    let [low, high] = [least * least, greatest * greatest];
    let [above, _] = turn.extremes(high, 2.0);
    let [_, below] = turn.extremes(low, 2.0);
    let inertia = (below.value - above.value) / (high - low);
    [inertia, high * inertia + above.value]
}

/// Least and greatest speed: a quotient of two functions is greatest where their difference is with
/// that quotient as a factor, and steps toward it end there (W. Dinkelbach, On nonlinear fractional
/// programming, 1967).
fn speeds(turn: &Cycle, inertia: f64, constant: f64) -> [Extreme; 2] {
    [0, 1].map(|which| {
        let mut best = Extreme::default();
        let mut speed2 = constant / (turn.inertia(turn.start()) + inertia);
        for step in 0..STEPS {
            // Of the difference the other one: its sign is turned.
            let at = turn.extremes(speed2, 2.0)[1 - which].at;
            let own = (2.0 * turn.work(at) + constant) / (turn.inertia(at) + inertia);
            // The last step tells nothing but the place.
            best = Extreme { at, value: own.sqrt() };
            let better = if which == 1 { own > speed2 } else { own < speed2 };
            if step > 0 && !better {
                break;
            }
            speed2 = own;
        }
        best
    })
}

fn speed_within(turn: &Cycle, [flywheel, constant]: [f64; 2], piece: usize, x: f64) -> f64 {
    let [inertia, work] = turn.within(piece, x);
    ((2.0 * work + constant) / (inertia + flywheel)).sqrt()
}

/// Time from a knot to a place in the piece behind it.
fn time_within(turn: &Cycle, state: [f64; 2], piece: usize, x: f64) -> f64 {
    integral(&|x| 1.0 / speed_within(turn, state, piece, x), 0.0, x)
}

/// Time of a turn.
fn duration(turn: &Cycle, inertia: f64, constant: f64) -> f64 {
    let pieces = turn.knots().windows(2).enumerate();
    pieces.map(|(i, ends)| time_within(turn, [inertia, constant], i, ends[1] - ends[0])).sum()
}
