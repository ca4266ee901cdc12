//! Periodic motions of machines and of tables, and the flywheel that evens them.

use super::error::SteadyError;
use super::options::SteadyOptions;
use super::steady::{NOISE, Shooting, Steady};
use crate::dynamics::flywheel::cycle::Extreme;
use crate::dynamics::flywheel::flywheel::Mean;
use crate::dynamics::machine::Machine;
use crate::dynamics::run::callbacks::Callbacks;
use crate::dynamics::run::equation::Equation;
use crate::dynamics::run::error::{RunError, counted};
use crate::dynamics::run::model::{MechanismModel, ReducedModel, TabulatedMachine};
use crate::math::derivatives::DerivativeTables;
use crate::math::root;
use crate::plan::mechanism::Mechanism;

/// Part of the flywheel to which it is found: the motions themselves are known no better.
const FOUND: f64 = 1.0e-12;
/// The greatest fluctuation there can be, where the least speed is none.
const GREATEST: f64 = 2.0;

/// How far sampled inertias may be off between the samples.
const SAMPLED: f64 = 1.01;
/// A multiplier this near 1 is that of a machine in which nothing depends on the speed.
const UNDAMPED: f64 = 1.0e-6;

/// What a periodic motion is asked to have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FluctuationTarget {
    /// Its fluctuation.
    pub fluctuation: f64,
    /// By which mean that is divided.
    pub mean: Mean,
}

impl Machine {
    /// The periodic motion of a design, with the flywheel that gives a wanted fluctuation or (none
    /// wanted) that of the search.
    ///
    /// # Errors
    ///
    /// Why there is none.
    pub fn steady<O: Callbacks>(
        &self,
        mechanism: &Mechanism,
        dimensions: &[f64],
        search: &SteadyOptions<'_>,
        wanted: Option<FluctuationTarget>,
        mut outside: O,
    ) -> Result<Steady, SteadyError<O::Error>> {
        let needed = mechanism.dimensions().len();
        counted(&[("dimensions", needed, dimensions.len())]).map_err(SteadyError::Run)?;
        let jets = DerivativeTables::new(1, 2);
        if mechanism.q0().len() != 1 || mechanism.plan().driven_slide(0).is_some() {
            return Err(SteadyError::Other("a periodic motion is of one driver that turns".into()));
        }
        even(search, wanted, |search, guess| {
            let source = MechanismModel::new(self, mechanism, dimensions, &jets);
            let equation = Equation::new(source, &mut outside, &self.tables, &self.motors, 1);
            find(equation, search, guess)
        })
    }
}

impl TabulatedMachine {
    /// The same of a table.
    ///
    /// # Errors
    ///
    /// Why there is none.
    pub fn steady<O: Callbacks>(
        &self,
        search: &SteadyOptions<'_>,
        wanted: Option<FluctuationTarget>,
        mut outside: O,
    ) -> Result<Steady, SteadyError<O::Error>> {
        self.check().map_err(SteadyError::Run)?;
        even(search, wanted, |search, guess| {
            let equation = Equation::new(self, &mut outside, &self.tables, &self.motors, 1);
            find(equation, search, guess)
        })
    }
}

fn find<S: ReducedModel, O: Callbacks>(
    equation: Equation<'_, S, O>,
    search: SteadyOptions<'_>,
    guess: Option<&Steady>,
) -> Result<Steady, SteadyError<O::Error>> {
    let mut shooting = Shooting::new(equation, search)?;
    let (begin, period) = shooting.find(guess.map(Steady::begin))?;
    shooting.run(begin, &period)
}

/// Finds the motion of the mean speed that the search asks for, if motors and loads leave it open.
///
/// `find` meets the mean over the period. The mean of the extremes grows with it: where nothing
/// depends on the speed, q̇² J gains the same energy everywhere.
fn at_mean<E>(
    search: &SteadyOptions<'_>,
    guess: Option<&Steady>,
    find: &mut impl FnMut(SteadyOptions<'_>, Option<&Steady>) -> Result<Steady, SteadyError<E>>,
) -> Result<Steady, SteadyError<E>> {
    let first = find(*search, guess);
    let (Some(speed), Mean::Extremes) = (search.speed, search.mean) else { return first };
    match &first {
        Ok(steady) if steady.prescribed => {}
        Err(SteadyError::NotMet { .. }) => {}
        _ => return first,
    }
    let not_met = || SteadyError::NotMet { speed, mean: search.mean };
    let wanted = speed.abs();
    let (mut first, mut best, mut failed) = (Some(first), None, None);
    let mut least_error = f64::INFINITY;
    let excess = |over_period: f64| {
        if failed.is_some() {
            return f64::NAN;
        }
        let made = first.take().unwrap_or_else(|| {
            let speed = Some(over_period.copysign(speed));
            find(SteadyOptions { speed, ..*search }, best.as_ref())
        });
        match made {
            Ok(steady) if steady.least_mean_of_extremes() > wanted => {
                failed = Some(not_met());
                f64::NAN
            }
            Ok(steady) => {
                let error = steady.mean(Mean::Extremes) - wanted;
                if error.abs() < least_error {
                    (best, least_error) = (Some(steady), error.abs());
                }
                // What is nearer than the motions themselves is met.
                if error.abs() <= search.relative * wanted { 0.0 } else { error }
            }
            // Too slow to be carried through the turn.
            Err(SteadyError::Stops { .. } | SteadyError::NotMet { .. }) => -wanted,
            Err(error) => {
                failed = Some(error);
                f64::NAN
            }
        }
    };
    root::find_root_to(excess, wanted, search.relative);
    if let Some(error) = failed {
        return Err(error);
    }
    let is_met = least_error <= NOISE * search.relative * wanted;
    best.filter(|_| is_met).ok_or_else(not_met)
}

fn even<E>(
    search: &SteadyOptions<'_>,
    wanted: Option<FluctuationTarget>,
    mut find: impl FnMut(SteadyOptions<'_>, Option<&Steady>) -> Result<Steady, SteadyError<E>>,
) -> Result<Steady, SteadyError<E>> {
    let mut find =
        |search: SteadyOptions<'_>, guess: Option<&Steady>| at_mean(&search, guess, &mut find);
    let Some(FluctuationTarget { fluctuation, mean }) = wanted else { return find(*search, None) };
    // Without a flywheel it may stop; then it fluctuates as much as can be.
    let without = match find(*search, None) {
        Ok(steady) => Some(steady),
        Err(
            SteadyError::Stops { .. }
            | SteadyError::CannotCarry { .. }
            | SteadyError::NotMet { .. },
        ) => None,
        // The flywheel may be all the inertia there is.
        Err(SteadyError::Run(RunError::NoInertia { .. })) => None,
        Err(error) => return Err(error),
    };
    let own = without.as_ref().map_or(GREATEST, |steady| steady.fluctuation(mean));
    if own <= fluctuation {
        return Err(SteadyError::AlreadyMet { without: own, wanted: fluctuation });
    }
    // The fluctuation is about inverse to the inertia.
    let size = find_inertia(without.as_ref());
    let guess = size * (own / fluctuation - 1.0).max(0.1);
    let (mut last, mut failed) = (without, None);
    let lack = |flywheel: f64| {
        if failed.is_some() {
            return f64::NAN;
        }
        let search = SteadyOptions { flywheel: search.flywheel + flywheel, ..*search };
        match find(search, last.as_ref()) {
            Ok(steady) => {
                let own = steady.fluctuation(mean);
                last = Some(steady);
                fluctuation - own
            }
            Err(
                SteadyError::Stops { .. }
                | SteadyError::CannotCarry { .. }
                | SteadyError::NotMet { .. },
            ) => fluctuation - GREATEST,
            Err(error) => {
                failed = Some(error);
                f64::NAN
            }
        }
    };
    let found = root::find_root_to(lack, guess, FOUND);
    match (found, failed, last) {
        (_, Some(error), _) => Err(error),
        (Some(flywheel), None, last) => {
            let search = SteadyOptions { flywheel: search.flywheel + flywheel, ..*search };
            find(search, last.as_ref())
        }
        (None, None, _) => Err(SteadyError::NoFlywheel { wanted: fluctuation }),
    }
}

/// The inertia where a motion begins, kg·m².
fn find_inertia(steady: Option<&Steady>) -> f64 {
    let of = |steady: &Steady| {
        let speed = steady.run.moments.speed.first()?;
        Some(2.0 * steady.run.energies.first()?[0] / (speed * speed))
    };
    steady.and_then(of).filter(|size| size.is_finite()).unwrap_or(1.0)
}

impl Steady {
    /// The least and the greatest speed, without its sign, and where they are.
    #[must_use]
    pub fn extremes(&self) -> [Extreme; 2] {
        let moments = &self.run.moments;
        let within = moments.q.iter().copied().zip(moments.speed.iter().copied());
        let between = self.run.events.iter().map(|one| (one.q[0], one.speed[0]));
        let mut extremes = [f64::INFINITY, 0.0].map(|value| Extreme { at: f64::NAN, value });
        for (at, speed) in between.chain(within) {
            let own = Extreme { at, value: speed.abs() };
            if own.value < extremes[0].value {
                extremes[0] = own;
            }
            if own.value > extremes[1].value {
                extremes[1] = own;
            }
        }
        extremes
    }

    /// Below which no motion of this machine has its mean of the extremes; 0 if that is not known.
    ///
    /// At a lower energy level q̇² falls everywhere by C/J, at most until the least is 0: the
    /// greatest is then still q̇² − (least q̇²) J/J′.
    fn least_mean_of_extremes(&self) -> f64 {
        if (self.multiplier - 1.0).abs() > UNDAMPED {
            return 0.0;
        }
        let moments = self.run.moments.speed.iter().zip(&self.run.energies);
        let inertias = moments.map(|(speed, [kinetic, _])| 2.0 * kinetic / (speed * speed));
        let [least, most] = inertias.fold([f64::INFINITY, 0.0_f64], |[least, most], inertia| {
            [least.min(inertia), most.max(inertia)]
        });
        let [slow, fast] = self.extremes().map(|extreme| extreme.value * extreme.value);
        0.5 * (fast - SAMPLED * slow * most / least).max(0.0).sqrt()
    }

    /// Time of a period, s.
    #[must_use]
    pub fn period(&self) -> f64 {
        width(&self.run.moments.t)
    }

    /// The mean speed without its sign, rad/s.
    #[must_use]
    pub fn mean(&self, by: Mean) -> f64 {
        let [least, greatest] = self.extremes();
        match by {
            Mean::Extremes => 0.5 * (least.value + greatest.value),
            Mean::Period => width(&self.run.moments.q).abs() / self.period(),
        }
    }

    /// How much the speed varies, as a part of its mean.
    #[must_use]
    pub fn fluctuation(&self, by: Mean) -> f64 {
        let [least, greatest] = self.extremes();
        (greatest.value - least.value) / self.mean(by)
    }
}

/// From the first number to the last.
fn width(list: &[f64]) -> f64 {
    match list {
        [first, .., last] => last - first,
        _ => f64::NAN,
    }
}
