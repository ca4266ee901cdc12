//! Periodic motions: their checks, and the run over one period from the initial speed found.

use super::error::SteadyError;
use super::options::SteadyOptions;
use super::period::{Period, PeriodOutcome, PeriodStart, period};
use crate::dynamics::run::callbacks::Callbacks;
use crate::dynamics::run::equation::Equation;
use crate::dynamics::run::integrate::{breaks_of, run, stations_between};
use crate::dynamics::run::model::ReducedModel;
use crate::dynamics::run::options::{EventKind, EventSpec, RunOptions};
use crate::dynamics::run::trajectory::{Run, StopReason};
use crate::dynamics::run::variable::Variable;
use crate::ode::integrator::Integrator;
use crate::ode::system::Crossing;

/// Error of a period, in tolerances.
pub(crate) const NOISE: f64 = 100.0;
/// Largest error of a period's energy, as a part of its work.
const MAX_NOISE: f64 = 0.05;
/// Largest imbalance of a period, as a part of its work.
const BALANCE_RTOL: f64 = 1.0e-6;
/// Number of coordinates at which the machine is compared with itself one period later.
const SAMPLES: u32 = 5;
/// Inertia below this part of the greatest is rounding.
const INERTIA_NOISE: f64 = 64.0 * f64::EPSILON;
/// Largest relative difference of two successive periods.
const PERIODIC_RTOL: f64 = 1.0e-7;

/// A periodic motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Steady {
    /// One period along the coordinate; its events are the extremes of the speed.
    pub run: Run,
    /// Floquet multiplier: factor by which a perturbation of the energy changes each period; stable
    /// below 1.
    pub multiplier: f64,
    /// The constant moment on the driver that keeps the prescribed speed; 0 if motors and loads
    /// determine the speed.
    pub moment: f64,
    /// Work of the motors and of that moment in a period, J.
    pub drive: f64,
    /// Inertia added to the driver's, kg·m².
    pub flywheel: f64,
    /// Whether the mean speed was prescribed and the moment found for it.
    pub prescribed: bool,
}

impl Steady {
    /// Initial values for a search near this motion.
    pub(crate) fn start(&self) -> PeriodStart {
        let speed = self.run.samples.speed.first().copied().unwrap_or(f64::NAN);
        PeriodStart { speed2: speed * speed, moment: self.moment, t: 0.0 }
    }
}

/// The search for a periodic motion, with its workspace.
pub(crate) struct Shooting<'s, 'a, S, O> {
    pub equation: Equation<'a, S, O>,
    pub options: SteadyOptions<'s>,
    /// Whether the motion has the mean speed of the options.
    pub prescribed: bool,
    integrator: Option<Integrator>,
    /// Start of the current period, and its breaks.
    from: f64,
    breaks: Vec<f64>,
}

impl<'s, 'a, S: ReducedModel, O: Callbacks> Shooting<'s, 'a, S, O> {
    pub(crate) fn new(
        mut equation: Equation<'a, S, O>,
        options: SteadyOptions<'s>,
    ) -> Result<Self, SteadyError<O::Error>> {
        equation.flywheel = options.flywheel;
        equation.wants_slopes = true;
        let mut shooting = Self {
            equation,
            options,
            prescribed: false,
            integrator: None,
            from: options.q,
            breaks: Vec::new(),
        };
        shooting.set_start(options.q)?;
        shooting.check_periodic()?;
        Ok(shooting)
    }

    /// Checks that the machine is the same one period later.
    fn check_periodic(&mut self) -> Result<(), SteadyError<O::Error>> {
        let SteadyOptions { q: from, span, .. } = self.options;
        let mut at_start = None;
        let mut inertia = |q: f64| {
            let is_reachable =
                self.equation.ensure_tables_at(q) && self.equation.set_configuration(&[q]).is_ok();
            let inertia = if is_reachable { self.equation.reduced.inertia[0] } else { f64::NAN };
            if q == from && inertia.is_nan() {
                at_start = Some(self.equation.no_initial_position(&[q]));
            }
            inertia
        };
        let samples = (0..SAMPLES).map(|part| {
            let here = from + span * f64::from(part) / f64::from(SAMPLES);
            let q = [here, here + span];
            (q, q.map(&mut inertia))
        });
        let samples: Vec<_> = samples.collect();
        self.equation.rejected = None;
        if let Some(error) = at_start {
            return Err(SteadyError::Run(error));
        }
        // The periods themselves report unreachable positions.
        if samples.iter().any(|(_, pair)| pair.iter().any(|value| value.is_nan())) {
            return Ok(());
        }
        let greatest =
            samples.iter().fold(0.0_f64, |greatest, (_, [inertia, _])| greatest.max(inertia.abs()));
        let massless =
            samples.iter().find(|(_, [inertia, _])| *inertia <= INERTIA_NOISE * greatest);
        if let Some(&([q, _], [value, _])) = massless {
            return Err(SteadyError::Run(self.equation.no_inertia(&[q], value, 0)));
        }
        let different =
            samples.into_iter().find(|(_, [a, b])| (b - a).abs() > PERIODIC_RTOL * a.abs());
        different.map_or(Ok(()), |(q, inertia)| Err(SteadyError::InertiaNotPeriodic { q, inertia }))
    }

    /// Sets the coordinate where periods start.
    fn set_start(&mut self, q: f64) -> Result<(), SteadyError<O::Error>> {
        let SteadyOptions { span, breaks, .. } = self.options;
        let mut breaks: Vec<f64> = breaks.iter().map(|at| at + (q - self.options.q)).collect();
        let range = [q, q + span];
        let stations = stations_between(self.equation.model, range).map_err(SteadyError::Run)?;
        self.equation.begin_along(range, &stations).map_err(SteadyError::Run)?;
        breaks.extend(stations);
        self.from = q;
        let unit = self.equation.model.unit(0);
        self.breaks =
            breaks_of(self.equation.tables, &breaks, range, unit).map_err(SteadyError::Run)?;
        Ok(())
    }

    pub(crate) fn run_period(
        &mut self,
        start: PeriodStart,
    ) -> Result<PeriodOutcome, SteadyError<O::Error>> {
        let Self { equation, integrator, options, from, breaks, .. } = self;
        period(equation, integrator, options, (*from, breaks), start)
    }

    /// Integrates the motion found, with all its samples.
    pub(crate) fn run(
        mut self,
        start: PeriodStart,
        period: &Period,
    ) -> Result<Steady, SteadyError<O::Error>> {
        // A second period must repeat the first: the machine may depend on the time.
        let SteadyOptions {
            q, span, method, relative, max_steps, deadline, breaks, flywheel, ..
        } = self.options;
        self.set_start(q + span)?;
        let next = self.run_period(PeriodStart { t: start.t + period.time, ..start })?;
        let rtol = PERIODIC_RTOL.max(NOISE * relative);
        let same = matches!(next, PeriodOutcome::Whole(repeated)
            if (repeated.speed2 - period.speed2).abs() <= rtol * period.speed2
            && (repeated.time - period.time).abs() <= rtol * period.time.abs());
        if !same {
            return Err(SteadyError::NotPeriodic);
        }
        self.equation.extra_moment = start.moment;
        let events = [EventSpec {
            kind: EventKind::Extreme,
            crossing: Crossing::Either,
            stops: false,
            rebound: None,
        }];
        let run_options = RunOptions {
            along: Variable::Coordinate,
            t: 0.0,
            q: &[q],
            speed: &[span.signum() * start.speed2.sqrt()],
            end: q + span,
            method,
            relative,
            absolute: None,
            max_step: f64::INFINITY,
            max_steps,
            deadline,
            breaks,
            events: &events,
            flywheel,
        };
        self.equation.wants_slopes = false;
        let run = run(self.equation, &run_options, &[1.0]).map_err(SteadyError::Run)?;
        let end = run.samples.q.last().copied().unwrap_or(q);
        match run.stop_reason {
            StopReason::Reached => {}
            StopReason::TimeLimit | StopReason::Cancelled => {
                return Err(SteadyError::Cancelled { q: end });
            }
            // The shooting integrated the same period to its end.
            _ => return Err(SteadyError::TooManySteps { q: end }),
        }
        let change = |list: &[f64]| list.last().zip(list.first()).map_or(f64::NAN, |(b, a)| b - a);
        let stored: Vec<f64> = run.energies.iter().map(|pair| pair[1]).collect();
        let imbalance = change(&run.samples.work) - change(&stored);
        // At too high a speed the rounding of the energy exceeds the work of a period.
        let kinetic = run.energies.first().map_or(f64::NAN, |pair| pair[0]);
        let noise = NOISE * relative * kinetic;
        let idle = period.turnover <= 64.0 * f64::EPSILON * kinetic;
        let balanced = imbalance.abs() <= BALANCE_RTOL * period.turnover + noise;
        if !(balanced && (idle || noise <= MAX_NOISE * period.turnover)) {
            return Err(SteadyError::RunsAway { speed: start.speed2.sqrt() });
        }
        let (multiplier, moment, drive) = (period.speed2_by[0], start.moment, period.drive);
        Ok(Steady { run, multiplier, moment, drive, flywheel, prescribed: self.prescribed })
    }
}
