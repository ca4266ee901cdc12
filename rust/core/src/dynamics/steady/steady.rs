//! The periodic motion of a machine: what is asked, and what is made of the beginning that was found.

use super::error::SteadyError;
use super::options::SteadyOptions;
use super::period::{Begin, Period, PeriodOutcome, period};
use crate::dynamics::run::callbacks::Callbacks;
use crate::dynamics::run::equation::Equation;
use crate::dynamics::run::error::RunError;
use crate::dynamics::run::integrate::{breaks_of, run};
use crate::dynamics::run::model::ReducedModel;
use crate::dynamics::run::options::{EventKind, EventSpec, RunOptions, Variable};
use crate::dynamics::run::trajectory::{Run, StopReason};
use crate::ode::integrator::Integrator;
use crate::ode::system::Crossing;

/// Errors of a period, as multiples of the tolerance.
pub(crate) const NOISE: f64 = 100.0;
/// Part of the work of a period that may be lost in them.
const UNKNOWN: f64 = 0.05;
/// Part of the work of a period to which it is in balance.
const BALANCE: f64 = 1.0e-6;
/// At how many places of a period the machine is compared with itself a period on.
const LOOKS: u32 = 5;
/// Part of the greatest inertia that is rounding.
const NO_INERTIA: f64 = 64.0 * f64::EPSILON;
/// How far two periods, one after the other, may differ.
const SAME: f64 = 1.0e-7;

/// A periodic motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Steady {
    /// One period, along the coordinate; its events are the extremes of the speed.
    pub run: Run,
    /// What a small change of the energy at the beginning has become at the end: stable below 1.
    pub multiplier: f64,
    /// The constant moment on the driver that was found for the speed; 0 if the motors told it.
    pub moment: f64,
    /// Work of the motors in a period, J.
    pub drive: f64,
    /// Inertia added to the driver's, kg·m².
    pub flywheel: f64,
    /// Whether the mean speed was prescribed and the moment found for it.
    pub prescribed: bool,
}

impl Steady {
    /// What a search near it begins with.
    pub(crate) fn begin(&self) -> Begin {
        let speed = self.run.moments.speed.first().copied().unwrap_or(f64::NAN);
        Begin { speed2: speed * speed, moment: self.moment, t: 0.0 }
    }
}

/// A search and its work space.
pub(crate) struct Shooting<'s, 'a, S, O> {
    pub equation: Equation<'a, S, O>,
    pub search: SteadyOptions<'s>,
    /// Whether the motion has the mean speed of the search.
    pub prescribed: bool,
    integrator: Option<Integrator>,
    /// Where the period at hand begins, and its breaks.
    from: f64,
    breaks: Vec<f64>,
}

impl<'s, 'a, S: ReducedModel, O: Callbacks> Shooting<'s, 'a, S, O> {
    pub(crate) fn new(
        mut equation: Equation<'a, S, O>,
        search: SteadyOptions<'s>,
    ) -> Result<Self, SteadyError<O::Error>> {
        equation.flywheel = search.flywheel;
        equation.slopes = true;
        let mut own = Self {
            equation,
            search,
            prescribed: false,
            integrator: None,
            from: search.q,
            breaks: Vec::new(),
        };
        own.begin_at(search.q)?;
        own.compare()?;
        Ok(own)
    }

    /// Refuses a machine that is another one a period on.
    fn compare(&mut self) -> Result<(), SteadyError<O::Error>> {
        let SteadyOptions { q: from, span, .. } = self.search;
        let mut inertia = |q: f64| {
            let is_there = self.equation.find(q) && self.equation.place(&[q]).is_ok();
            if is_there { self.equation.reduced.inertia[0] } else { f64::NAN }
        };
        let looks = (0..LOOKS).map(|part| {
            let here = from + span * f64::from(part) / f64::from(LOOKS);
            let q = [here, here + span];
            (q, q.map(&mut inertia))
        });
        let looks: Vec<_> = looks.collect();
        self.equation.refused = None;
        if looks[0].1[0].is_nan() {
            return Err(SteadyError::Run(RunError::NothingThere { q: vec![from] }));
        }
        // Where somewhere nothing is, the period will tell; beyond, all may be other.
        if looks.iter().any(|(_, pair)| pair.iter().any(|value| value.is_nan())) {
            return Ok(());
        }
        let most = looks.iter().fold(0.0_f64, |most, (_, [inertia, _])| most.max(inertia.abs()));
        let none = looks.iter().find(|(_, [inertia, _])| *inertia <= NO_INERTIA * most);
        if let Some(&([q, _], [value, _])) = none {
            return Err(SteadyError::Run(RunError::NoInertia { q, value }));
        }
        let other = looks.into_iter().find(|(_, [a, b])| (b - a).abs() > SAME * a.abs());
        other.map_or(Ok(()), |(q, inertia)| Err(SteadyError::AnotherOne { q, inertia }))
    }

    /// Periods begin here from now on.
    fn begin_at(&mut self, q: f64) -> Result<(), SteadyError<O::Error>> {
        let SteadyOptions { span, breaks, .. } = self.search;
        let given: Vec<f64> = breaks.iter().map(|at| at + (q - self.search.q)).collect();
        self.from = q;
        self.breaks =
            breaks_of(self.equation.tables, &given, [q, q + span]).map_err(SteadyError::Run)?;
        Ok(())
    }

    pub(crate) fn pass(&mut self, begin: Begin) -> Result<PeriodOutcome, SteadyError<O::Error>> {
        let Self { equation, integrator, search, from, breaks, .. } = self;
        period(equation, integrator, search, (*from, breaks), begin)
    }

    /// The motion found, with all its moments.
    pub(crate) fn run(
        mut self,
        begin: Begin,
        period: &Period,
    ) -> Result<Steady, SteadyError<O::Error>> {
        // Once more, a period on: there the machine must be the same.
        let SteadyOptions {
            q, span, method, relative, max_steps, deadline, breaks, flywheel, ..
        } = self.search;
        self.begin_at(q + span)?;
        let later = self.pass(Begin { t: begin.t + period.time, ..begin })?;
        let part = SAME.max(NOISE * relative);
        let same = matches!(later, PeriodOutcome::Whole(own)
            if (own.speed2 - period.speed2).abs() <= part * period.speed2
            && (own.time - period.time).abs() <= part * period.time.abs());
        if !same {
            return Err(SteadyError::NotPeriodic);
        }
        self.equation.extra = begin.moment;
        let watches =
            [EventSpec { occasion: EventKind::Extreme, crossing: Crossing::Either, stops: false }];
        let task = RunOptions {
            along: Variable::Coordinate,
            t: 0.0,
            q: &[q],
            speed: &[span.signum() * begin.speed2.sqrt()],
            end: q + span,
            method,
            relative,
            absolute: None,
            max_step: f64::INFINITY,
            max_steps,
            deadline,
            breaks,
            watches: &watches,
            flywheel,
        };
        self.equation.slopes = false;
        let run = run(self.equation, &task, &[1.0]).map_err(|error| match error {
            crate::ode::error::Error::System(broken) => SteadyError::Run(broken),
            other => SteadyError::Other(other.to_string()),
        })?;
        match run.ending {
            StopReason::Reached => {}
            StopReason::Late | StopReason::Cancelled => return Err(SteadyError::Cancelled { q }),
            ref other => {
                return Err(SteadyError::Other(format!("the period ended early: {other:?}")));
            }
        }
        let ends = |list: &[f64]| list.last().zip(list.first()).map_or(f64::NAN, |(b, a)| b - a);
        let stored: Vec<f64> = run.energies.iter().map(|pair| pair[1]).collect();
        let left = ends(&run.moments.work) - ends(&stored);
        // At too great a speed the energy's own rounding is more than a period's work.
        let kinetic = run.energies.first().map_or(f64::NAN, |pair| pair[0]);
        let noise = NOISE * relative * kinetic;
        let idle = period.turnover <= 64.0 * f64::EPSILON * kinetic;
        let balanced = left.abs() <= BALANCE * period.turnover + noise;
        if !(balanced && (idle || noise <= UNKNOWN * period.turnover)) {
            return Err(SteadyError::RunsAway { speed: begin.speed2.sqrt() });
        }
        let (multiplier, moment, drive) = (period.speed2_by[0], begin.moment, period.drive);
        Ok(Steady { run, multiplier, moment, drive, flywheel, prescribed: self.prescribed })
    }
}
