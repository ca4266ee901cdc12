//! One period of a motion along the coordinate, with its derivatives by what it begins with.
//!
//! With w = q̇² the equation of motion is w′ = (2 M − J′ w)/J. A change δw at the beginning grows
//! by the linearised equation δw′ = (∂M/∂q̇ / q̇ − J′)/J δw, a constant moment τ more adds 2 τ/J;
//! what they make of the time t′ = 1/q̇ is integrated along. So the matrix of the period is exact to
//! the tolerance (E. Hairer, S. P. Nørsett, G. Wanner I, I.14).

use super::error::SteadyError;
use super::options::SteadyOptions;
use crate::dynamics::run::callbacks::Callbacks;
use crate::dynamics::run::equation::Equation;
use crate::dynamics::run::error::RunError;
use crate::dynamics::run::model::ReducedModel;
use crate::ode::error::Error;
use crate::ode::integrator::Integrator;
use crate::ode::options::{Options, Output};
use crate::ode::solution::{End, Solution};
use crate::ode::system::{Action, Crossing, Fault, System};
use crate::query::evaluator::NearMiss;

/// Where a period begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Begin {
    /// q̇².
    pub speed2: f64,
    /// A constant moment on the driver besides its motors.
    pub moment: f64,
    /// Time.
    pub t: f64,
}

/// What a period comes to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Period {
    /// q̇² at its end.
    pub speed2: f64,
    /// Its time.
    pub time: f64,
    /// Work of the motors.
    pub drive: f64,
    /// Work of loads and motors, each counted positive.
    pub turnover: f64,
    /// Whether anything depends on the speed.
    pub depends: bool,
    /// Derivatives of the first two by `speed2` at the beginning and by the moment.
    pub speed2_by: [f64; 2],
    pub time_by: [f64; 2],
}

/// How a period came out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum PeriodOutcome {
    Whole(Period),
    /// The machine stops on the way.
    Stops {
        q: f64,
    },
}

/// The system of a period.
struct Cycle<'c, 'a, S, O> {
    equation: &'c mut Equation<'a, S, O>,
    sign: f64,
    moment: f64,
    depends: bool,
    table: bool,
    deadline: Option<std::time::Instant>,
}

/// What is left of q̇² where a machine comes to rest, as a part of it at the beginning: the time
/// grows as its root there, and steps become too narrow before it is none.
const AT_REST: f64 = 1.0e-4;

/// How far (rad) from a dead point a period that ends there may end.
const BESIDE: f64 = 1.0e-3;

/// Numbers of its state: w, t, work of motors, sum of all work, and derivatives.
const LEN: usize = 8;

impl<S: ReducedModel, O: Callbacks> System for Cycle<'_, '_, S, O> {
    type Error = RunError<O::Error>;

    fn rates(&mut self, q: f64, y: &[f64], rates: &mut [f64]) -> Result<(), Fault<Self::Error>> {
        let &[speed2, t, _, _, by_start, by_moment, ..] = y else { return Err(Fault::OutOfDomain) };
        let equation = &mut *self.equation;
        let is_moving = speed2 > 0.0;
        if !is_moving {
            return Err(Fault::OutOfDomain);
        }
        let speed = self.sign * speed2.sqrt();
        equation.place(&[q])?;
        equation.load(t, &[q], &[speed])?;
        let inertia = equation.inertia(q)?;
        let moment = equation.moment(0) + self.moment;
        let by_speed = equation.reduced.by_speed + equation.drive_by_speed;
        self.depends |= by_speed != 0.0;
        let rate = equation.reduced.rates[0];
        let growth = (by_speed / speed - rate) / inertia;
        rates[0] = (2.0 * moment - rate * speed2) / inertia;
        rates[1] = 1.0 / speed;
        rates[2] = equation.drive[0] + self.moment;
        let parts = [equation.reduced.stored[0], equation.reduced.applied[0], equation.drive[0]];
        rates[3] = self.sign * parts.map(f64::abs).iter().sum::<f64>();
        rates[4] = growth * by_start;
        rates[5] = growth * by_moment + 2.0 / inertia;
        let slower = -0.5 / (speed * speed2);
        rates[6] = slower * by_start;
        rates[7] = slower * by_moment;
        Ok(())
    }

    fn begin_interval(&mut self, from: f64, to: f64, _: &[f64]) -> Result<(), Self::Error> {
        self.equation.enter(from, to)
    }

    fn events(&mut self, _: f64, y: &[f64], values: &mut [f64]) -> Result<(), Self::Error> {
        let speed = self.sign * y[0].max(0.0).sqrt();
        self.equation.motor_borders(&[speed], values);
        Ok(())
    }

    fn on_event(&mut self, event: usize, _: f64, y: &mut [f64]) -> Result<Action, Self::Error> {
        let which = self.equation.tabled().nth(event / 2).unwrap_or(0);
        let Some((_, speed)) = self.equation.pass_motor(which, event % 2 == 1) else {
            self.table = true;
            return Ok(Action::Stop);
        };
        y[0] = speed * speed;
        Ok(Action::Restart)
    }

    fn cancelled(&mut self) -> bool {
        self.deadline.is_some_and(|deadline| std::time::Instant::now() >= deadline)
            || self.equation.outside.cancelled()
    }
}

/// Goes through one period.
pub(crate) fn period<S: ReducedModel, O: Callbacks>(
    equation: &mut Equation<'_, S, O>,
    integrator: &mut Option<Integrator>,
    search: &SteadyOptions<'_>,
    (from, breaks): (f64, &[f64]),
    begin: Begin,
) -> Result<PeriodOutcome, SteadyError<O::Error>> {
    let sign = search.span.signum();
    let speed = sign * begin.speed2.sqrt();
    equation.begin(from, &[speed]).map_err(SteadyError::Run)?;
    let events = vec![Crossing::Boundary; 2 * equation.tabled().count()];
    let deadline = search.deadline;
    let mut cycle =
        Cycle { equation, sign, moment: begin.moment, depends: false, table: false, deadline };
    let free = f64::INFINITY;
    let r = search.relative;
    let relative = [r, r, 0.0, 0.0, r, r, r, r];
    let scale = 1.0 / speed.abs();
    let absolute = [r * 1e-3 * begin.speed2, r * scale, free, free, r, free, free, free];
    let options = Options {
        relative: &relative,
        absolute: &absolute,
        max_steps: search.max_steps,
        breaks,
        events: &events,
        output: Output::End,
        ..Options::default()
    };
    let start = [begin.speed2, begin.t, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
    let integrator = integrator.get_or_insert_with(|| Integrator::new(search.method, LEN));
    let made = integrator.run(&mut cycle, from, &start, from + search.span, &options);
    let (table, depends) = (cycle.table, cycle.depends);
    let Solution { t: q, y, end, .. } = made.map_err(|error| match error {
        Error::System(broken) => SteadyError::Run(broken),
        other => SteadyError::Other(other.to_string()),
    })?;
    match end {
        End::Reached => {}
        End::DomainBoundary { .. } | End::Stalled { .. }
            if cycle.equation.source.is_beside_fold(&[q], BESIDE) =>
        {
            return Err(SteadyError::DeadPoint { q });
        }
        End::DomainBoundary { .. } | End::Stalled { .. } if y[0] <= AT_REST * begin.speed2 => {
            return Ok(PeriodOutcome::Stops { q });
        }
        End::Event { .. } if table => {
            return Err(SteadyError::MotorTableEnds { q, speed: sign * y[0].max(0.0).sqrt() });
        }
        End::DomainBoundary { .. } => {
            let near = cycle.equation.is_near_miss().then(|| cycle.equation.source.near_miss(q));
            return Err(match near.flatten() {
                Some(NearMiss { dyad, miss, q }) => SteadyError::NearChangePoint { dyad, miss, q },
                None => SteadyError::DeadPoint { q },
            });
        }
        End::Cancelled { .. } => return Err(SteadyError::Cancelled { q }),
        End::StepLimit { t: q, .. } => return Err(SteadyError::TooManySteps { q }),
        other => return Err(SteadyError::Other(other.to_string())),
    }
    Ok(PeriodOutcome::Whole(Period {
        speed2: y[0],
        time: y[1] - begin.t,
        drive: y[2],
        turnover: y[3].abs(),
        depends,
        speed2_by: [y[4], y[5]],
        time_by: [y[6], y[7]],
    }))
}
