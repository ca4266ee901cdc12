//! Steady states of machines and of tables, and the flywheel for a target fluctuation.

use super::error::SteadyError;
use super::options::SteadyOptions;
use super::steady::{NOISE, Shooting, Steady};
use crate::dynamics::flywheel::cycle::Extreme;
use crate::dynamics::flywheel::flywheel::Mean;
use crate::dynamics::machine::Machine;
use crate::dynamics::run::callbacks::Callbacks;
use crate::dynamics::run::equation::Equation;
use crate::dynamics::run::error::{RunError, check_counts};
use crate::dynamics::run::model::{MechanismModel, ReducedModel};
use crate::dynamics::run::tabulated::TabulatedMachine;
use crate::math::derivatives::DerivativeTables;
use crate::math::root::illinois;
use crate::plan::mechanism::Mechanism;

/// Relative accuracy of the flywheel: the motions themselves are not more accurate.
const FLYWHEEL_RTOL: f64 = 1.0e-12;
/// The greatest possible fluctuation, reached when the least speed is zero.
const MAX_FLUCTUATION: f64 = 2.0;

/// Margin for the extremes of the inertia between the samples.
const SAMPLING_MARGIN: f64 = 1.01;
/// A multiplier nearer to 1 than this means that nothing depends on the speed.
const UNDAMPED: f64 = 1.0e-6;

/// A target coefficient of speed fluctuation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FluctuationTarget {
    /// The coefficient.
    pub fluctuation: f64,
    /// The mean speed that it refers to.
    pub mean: Mean,
}

impl Machine {
    /// The periodic motion of a design, with the flywheel of the options and, for a `target`, the
    /// further flywheel that gives its fluctuation.
    ///
    /// # Errors
    ///
    /// Why no such motion was found.
    pub fn steady<O: Callbacks>(
        &self,
        mechanism: &Mechanism,
        dimensions: &[f64],
        options: &SteadyOptions<'_>,
        target: Option<FluctuationTarget>,
        mut callbacks: O,
    ) -> Result<Steady, SteadyError<O::Error>> {
        let needed = mechanism.dimensions().len();
        check_counts(&[("dimensions", needed, dimensions.len())]).map_err(SteadyError::Run)?;
        let derivatives = DerivativeTables::new(1, 2);
        if mechanism.q0().len() != 1 || mechanism.plan().driven_slide(0).is_some() {
            return Err(SteadyError::NotRotary);
        }
        size_flywheel(options, target, |options, guess| {
            let mut model = MechanismModel::new(self, mechanism, dimensions, &derivatives);
            let equation = Equation::new(&mut model, &mut callbacks, &self.tables, &self.motors, 1);
            solve_period(equation, options, guess)
        })
    }
}

impl TabulatedMachine {
    /// The periodic motion of a tabulated machine; see [`Machine::steady`].
    ///
    /// # Errors
    ///
    /// Why no such motion was found.
    pub fn steady<O: Callbacks>(
        &self,
        options: &SteadyOptions<'_>,
        target: Option<FluctuationTarget>,
        mut callbacks: O,
    ) -> Result<Steady, SteadyError<O::Error>> {
        self.check().map_err(SteadyError::Run)?;
        size_flywheel(options, target, |options, guess| {
            let mut model = self;
            let equation = Equation::new(&mut model, &mut callbacks, &self.tables, &self.motors, 1);
            solve_period(equation, options, guess)
        })
    }
}

fn solve_period<S: ReducedModel, O: Callbacks>(
    equation: Equation<'_, S, O>,
    options: SteadyOptions<'_>,
    guess: Option<&Steady>,
) -> Result<Steady, SteadyError<O::Error>> {
    let mut shooting = Shooting::new(equation, options)?;
    let (start, period) = shooting.solve(guess.map(Steady::start))?;
    shooting.run(start, &period)
}

/// Finds the motion with the mean speed of the options, if motors and loads leave the speed open.
///
/// `solve` meets the mean over the period. The mean of the extremes grows with it: where nothing
/// depends on the speed, q̇² J gains the same energy everywhere.
fn at_mean_speed<E>(
    options: &SteadyOptions<'_>,
    guess: Option<&Steady>,
    solve: &mut impl FnMut(SteadyOptions<'_>, Option<&Steady>) -> Result<Steady, SteadyError<E>>,
) -> Result<Steady, SteadyError<E>> {
    let first = solve(*options, guess);
    let (Some(speed), Mean::Extremes) = (options.speed, options.mean) else { return first };
    match &first {
        Ok(steady) if steady.prescribed => {}
        Err(SteadyError::MeanNotReached { .. }) => {}
        _ => return first,
    }
    let not_met = || SteadyError::MeanNotReached { speed, mean: options.mean };
    let wanted_mean = speed.abs();
    let (mut first, mut best, mut failed) = (Some(first), None, None);
    let mut least_error = f64::INFINITY;
    let excess = |over_period: f64| {
        if failed.is_some() {
            return f64::NAN;
        }
        let result = first.take().unwrap_or_else(|| {
            let speed = Some(over_period.copysign(speed));
            solve(SteadyOptions { speed, ..*options }, best.as_ref())
        });
        match result {
            Ok(steady) if steady.least_mean_of_extremes() > wanted_mean => {
                failed = Some(not_met());
                f64::NAN
            }
            Ok(steady) => {
                let error = steady.mean(Mean::Extremes) - wanted_mean;
                if error.abs() < least_error {
                    (best, least_error) = (Some(steady), error.abs());
                }
                // An error below the accuracy of the motions counts as zero.
                if error.abs() <= options.relative * wanted_mean { 0.0 } else { error }
            }
            // The motion is too slow to get through the turn.
            Err(SteadyError::Stops { .. } | SteadyError::MeanNotReached { .. }) => -wanted_mean,
            Err(error) => {
                failed = Some(error);
                f64::NAN
            }
        }
    };
    illinois::find_root_to(excess, wanted_mean, options.relative);
    if let Some(error) = failed {
        return Err(error);
    }
    let is_met = least_error <= NOISE * options.relative * wanted_mean;
    best.filter(|_| is_met).ok_or_else(not_met)
}

fn size_flywheel<E>(
    options: &SteadyOptions<'_>,
    target: Option<FluctuationTarget>,
    mut solve: impl FnMut(SteadyOptions<'_>, Option<&Steady>) -> Result<Steady, SteadyError<E>>,
) -> Result<Steady, SteadyError<E>> {
    let mut solve = |options: SteadyOptions<'_>, guess: Option<&Steady>| {
        at_mean_speed(&options, guess, &mut solve)
    };
    let Some(FluctuationTarget { fluctuation, mean }) = target else {
        return solve(*options, None);
    };
    // Without the flywheel the machine may stop; its fluctuation is then the greatest.
    let without = match solve(*options, None) {
        Ok(steady) => Some(steady),
        Err(
            SteadyError::Stops { .. }
            | SteadyError::CannotCarry { .. }
            | SteadyError::MeanNotReached { .. }
            // The flywheel may be the only inertia.
            | SteadyError::Run(RunError::NoInertia { .. }),
        ) => None,
        Err(error) => return Err(error),
    };
    let without_flywheel =
        without.as_ref().map_or(MAX_FLUCTUATION, |steady| steady.fluctuation(mean));
    if without_flywheel <= fluctuation {
        return Err(SteadyError::AlreadyMet { without: without_flywheel, wanted: fluctuation });
    }
    // The fluctuation is about inverse to the inertia.
    let size = initial_inertia(without.as_ref());
    let guess = size * (without_flywheel / fluctuation - 1.0).max(0.1);
    let (mut last, mut failed) = (without, None);
    let residual = |flywheel: f64| {
        if failed.is_some() {
            return f64::NAN;
        }
        let options = SteadyOptions { flywheel: options.flywheel + flywheel, ..*options };
        match solve(options, last.as_ref()) {
            Ok(steady) => {
                let reached = steady.fluctuation(mean);
                last = Some(steady);
                fluctuation - reached
            }
            Err(
                SteadyError::Stops { .. }
                | SteadyError::CannotCarry { .. }
                | SteadyError::MeanNotReached { .. },
            ) => fluctuation - MAX_FLUCTUATION,
            Err(error) => {
                failed = Some(error);
                f64::NAN
            }
        }
    };
    let root = illinois::find_root_to(residual, guess, FLYWHEEL_RTOL);
    match (root, failed, last) {
        (_, Some(error), _) => Err(error),
        (Some(flywheel), None, last) => {
            let options = SteadyOptions { flywheel: options.flywheel + flywheel, ..*options };
            solve(options, last.as_ref())
        }
        (None, None, _) => Err(SteadyError::NoFlywheel { wanted: fluctuation }),
    }
}

/// The inertia at the start of a motion, kg·m²; 1 without one.
fn initial_inertia(steady: Option<&Steady>) -> f64 {
    let at_start = |steady: &Steady| {
        let speed = steady.run.samples.speed.first()?;
        Some(2.0 * steady.run.energies.first()?[0] / (speed * speed))
    };
    steady.and_then(at_start).filter(|size| size.is_finite()).unwrap_or(1.0)
}

impl Steady {
    /// The least and the greatest absolute speed, with their coordinates.
    #[must_use]
    pub fn extremes(&self) -> [Extreme; 2] {
        let samples = &self.run.samples;
        let at_samples = samples.q.iter().copied().zip(samples.speed.iter().copied());
        let at_events = self.run.events.iter().map(|event| (event.q[0], event.speed[0]));
        let mut extremes = [f64::INFINITY, 0.0].map(|value| Extreme { at: f64::NAN, value });
        for (at, speed) in at_events.chain(at_samples) {
            let here = Extreme { at, value: speed.abs() };
            if here.value < extremes[0].value {
                extremes[0] = here;
            }
            if here.value > extremes[1].value {
                extremes[1] = here;
            }
        }
        extremes
    }

    /// A lower bound of the mean of the extremes over all motions of this machine; 0 if unknown.
    ///
    /// At a lower energy level q̇² falls everywhere by C/J, at most until the least is 0: the
    /// greatest is then still q̇² − (least q̇²) J/J′.
    fn least_mean_of_extremes(&self) -> f64 {
        if (self.multiplier - 1.0).abs() > UNDAMPED {
            return 0.0;
        }
        let samples = self.run.samples.speed.iter().zip(&self.run.energies);
        let inertias = samples.map(|(speed, [kinetic, _])| 2.0 * kinetic / (speed * speed));
        let [low, high] = inertias.fold([f64::INFINITY, 0.0_f64], |[low, high], inertia| {
            [low.min(inertia), high.max(inertia)]
        });
        let [slow, fast] = self.extremes().map(|extreme| extreme.value * extreme.value);
        0.5 * (fast - SAMPLING_MARGIN * slow * high / low).max(0.0).sqrt()
    }

    /// Time of a period, s.
    #[must_use]
    pub fn period(&self) -> f64 {
        width(&self.run.samples.t)
    }

    /// The mean absolute speed, rad/s.
    #[must_use]
    pub fn mean(&self, by: Mean) -> f64 {
        let [least, greatest] = self.extremes();
        match by {
            Mean::Extremes => 0.5 * (least.value + greatest.value),
            Mean::Period => width(&self.run.samples.q).abs() / self.period(),
        }
    }

    /// Coefficient of speed fluctuation: (greatest − least) / mean speed.
    #[must_use]
    pub fn fluctuation(&self, by: Mean) -> f64 {
        let [least, greatest] = self.extremes();
        (greatest.value - least.value) / self.mean(by)
    }
}

/// The last number minus the first.
fn width(list: &[f64]) -> f64 {
    match list {
        [first, .., last] => last - first,
        _ => f64::NAN,
    }
}
