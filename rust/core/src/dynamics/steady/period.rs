//! One period of a motion along the coordinate, with its derivatives by the initial values.
//!
//! With w = q̇² the equation of motion is w′ = (2 M − J′ w)/J. A perturbation δw grows by the
//! linearised equation δw′ = (∂M/∂q̇ / q̇ − J′)/J δw, and an additional constant moment τ adds 2
//! τ/J; their effect on the time, t′ = 1/q̇, is integrated along. So the matrix of the period is
//! exact to the tolerance (E. Hairer, S. P. Nørsett, G. Wanner I, I.14).

use super::error::SteadyError;
use super::options::SteadyOptions;
use crate::dynamics::run::callbacks::Callbacks;
use crate::dynamics::run::equation::Equation;
use crate::dynamics::run::error::RunError;
use crate::dynamics::run::model::ReducedModel;
use crate::dynamics::run::variable::Variable;
use crate::ode::integrator::Integrator;
use crate::ode::options::{Options, Output};
use crate::ode::solution::{End, Solution};
use crate::ode::system::{Action, Crossing, Fault, System};
use crate::query::evaluator::NearMiss;

/// Initial values of a period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PeriodStart {
    /// q̇².
    pub speed2: f64,
    /// A constant moment on the driver besides its motors, N·m.
    pub moment: f64,
    /// Time, s.
    pub t: f64,
}

/// Result of a period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Period {
    /// q̇² at its end.
    pub speed2: f64,
    /// Its duration, s.
    pub time: f64,
    /// Work of the motors and the constant moment.
    pub drive: f64,
    /// Work of loads and motors, with absolute values of all powers.
    pub turnover: f64,
    /// Whether loads or motors depend on the speed.
    pub depends_on_speed: bool,
    /// Derivatives of `speed2` and `time` by the initial `speed2` and by the moment.
    pub speed2_by: [f64; 2],
    pub time_by: [f64; 2],
}

/// Outcome of a period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum PeriodOutcome {
    Whole(Period),
    /// The machine stops within the period.
    Stops {
        q: f64,
    },
}

/// The differential equations of a period.
struct PeriodSystem<'c, 'a, S, O> {
    equation: &'c mut Equation<'a, S, O>,
    sign: f64,
    moment: f64,
    depends_on_speed: bool,
    table_ended: bool,
    deadline: Option<std::time::Instant>,
}

/// The machine counts as stopped when q̇² falls below this part of its initial value: there the
/// time grows like the square root, and steps become too narrow before q̇² is zero.
const AT_REST: f64 = 1.0e-4;

/// A period that ends within this distance (rad) of a dead point ends because of it.
const BESIDE: f64 = 1.0e-3;

/// Length of the state: w, t, work of motors, sum of all work, and four derivatives.
const LEN: usize = 8;

impl<S: ReducedModel, O: Callbacks> System for PeriodSystem<'_, '_, S, O> {
    type Error = RunError<O::Error>;

    fn rates(&mut self, q: f64, y: &[f64], rates: &mut [f64]) -> Result<(), Fault<Self::Error>> {
        let &[speed2, t, _, _, by_start, by_moment, ..] = y else { return Err(Fault::OutOfDomain) };
        let equation = &mut *self.equation;
        let is_moving = speed2 > 0.0;
        if !is_moving {
            return Err(Fault::OutOfDomain);
        }
        let speed = self.sign * speed2.sqrt();
        equation.set_configuration(&[q])?;
        equation.apply_loads(t, &[q], &[speed])?;
        let inertia = equation.inertia(q)?;
        let moment = equation.moment(0) + self.moment;
        let d_moment_d_speed = equation.reduced.d_moment_d_speed + equation.d_drive_d_speed;
        self.depends_on_speed |= d_moment_d_speed != 0.0;
        let d_inertia = equation.reduced.d_inertia[0];
        let growth = (d_moment_d_speed / speed - d_inertia) / inertia;
        rates[0] = (2.0 * moment - d_inertia * speed2) / inertia;
        rates[1] = 1.0 / speed;
        rates[2] = equation.drive[0] + self.moment;
        let parts =
            [equation.reduced.conservative[0], equation.reduced.applied[0], equation.drive[0]];
        rates[3] = self.sign * parts.map(f64::abs).iter().sum::<f64>();
        rates[4] = growth * by_start;
        rates[5] = growth * by_moment + 2.0 / inertia;
        let slower = -0.5 / (speed * speed2);
        rates[6] = slower * by_start;
        rates[7] = slower * by_moment;
        Ok(())
    }

    fn begin_interval(&mut self, from: f64, to: f64, _: &[f64]) -> Result<(), Self::Error> {
        self.equation.enter_interval(from, to)
    }

    fn events(&mut self, _: f64, y: &[f64], values: &mut [f64]) -> Result<(), Self::Error> {
        let speed = self.sign * y[0].max(0.0).sqrt();
        self.equation.motor_table_margins(&[speed], values);
        Ok(())
    }

    fn on_event(&mut self, event: usize, _: f64, y: &mut [f64]) -> Result<Action, Self::Error> {
        let which = self.equation.motors_with_table().nth(event / 2).unwrap_or(0);
        let Some((_, speed)) = self.equation.advance_motor_table(which, event % 2 == 1) else {
            self.table_ended = true;
            return Ok(Action::Stop);
        };
        y[0] = speed * speed;
        Ok(Action::Restart)
    }

    fn cancelled(&mut self) -> bool {
        self.deadline.is_some_and(|deadline| std::time::Instant::now() >= deadline)
            || self.equation.callbacks.cancelled()
    }
}

/// The error of a period that ends at a dead point, with the dyad or group that folds there.
fn dead_point<S: ReducedModel, O: Callbacks>(
    equation: &Equation<'_, S, O>,
    q: f64,
) -> SteadyError<O::Error> {
    let beside = equation.failure().filter(|failure| (failure.q[0] - q).abs() <= BESIDE);
    SteadyError::DeadPoint { q, group: beside.and_then(|failure| failure.reason.group().cloned()) }
}

/// Integrates one period.
pub(crate) fn period<S: ReducedModel, O: Callbacks>(
    equation: &mut Equation<'_, S, O>,
    integrator: &mut Option<Integrator>,
    options: &SteadyOptions<'_>,
    (from, breaks): (f64, &[f64]),
    start: PeriodStart,
) -> Result<PeriodOutcome, SteadyError<O::Error>> {
    let sign = options.span.signum();
    let speed = sign * start.speed2.sqrt();
    equation.begin(from, &[speed]).map_err(SteadyError::Run)?;
    let events = vec![Crossing::Boundary; 2 * equation.motors_with_table().count()];
    let deadline = options.deadline;
    let mut system = PeriodSystem {
        equation,
        sign,
        moment: start.moment,
        depends_on_speed: false,
        table_ended: false,
        deadline,
    };
    let free = f64::INFINITY;
    let r = options.relative;
    let relative = [r, r, 0.0, 0.0, r, r, r, r];
    let scale = 1.0 / speed.abs();
    let absolute = [r * 1e-3 * start.speed2, r * scale, free, free, r, free, free, free];
    let ode_options = Options {
        relative: &relative,
        absolute: &absolute,
        max_steps: options.max_steps,
        breaks,
        events: &events,
        output: Output::End,
        ..Options::default()
    };
    let y0 = [start.speed2, start.t, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
    let integrator = integrator.get_or_insert_with(|| Integrator::new(options.method, LEN));
    let solved = integrator.run(&mut system, from, &y0, from + options.span, &ode_options);
    let (table_ended, depends_on_speed) = (system.table_ended, system.depends_on_speed);
    let Solution { t: q, y, end, .. } = solved.map_err(|error| {
        SteadyError::Run(RunError::of_integrator(error, Variable::Coordinate, from))
    })?;
    match end {
        End::Reached => {}
        End::DomainBoundary { .. } | End::Stalled { .. }
            if system.equation.model.is_near_dead_point(&[q], BESIDE) =>
        {
            return Err(dead_point(system.equation, q));
        }
        End::DomainBoundary { .. } | End::Stalled { .. } if y[0] <= AT_REST * start.speed2 => {
            return Ok(PeriodOutcome::Stops { q });
        }
        End::Event { .. } if table_ended => {
            return Err(SteadyError::MotorTableEnds { q, speed: sign * y[0].max(0.0).sqrt() });
        }
        End::DomainBoundary { .. } => {
            let near = system.equation.is_near_miss().then(|| system.equation.model.near_miss(q));
            return Err(match near.flatten() {
                Some(NearMiss { dyad, miss, q }) => SteadyError::NearChangePoint { dyad, miss, q },
                None => dead_point(system.equation, q),
            });
        }
        End::Cancelled { .. } => return Err(SteadyError::Cancelled { q }),
        End::StepLimit { t: q, .. } => return Err(SteadyError::TooManySteps { q }),
        End::Stalled { .. } | End::Event { .. } => return Err(SteadyError::Stalled { q }),
    }
    Ok(PeriodOutcome::Whole(Period {
        speed2: y[0],
        time: y[1] - start.t,
        drive: y[2],
        turnover: y[3].abs(),
        depends_on_speed,
        speed2_by: [y[4], y[5]],
        time_by: [y[6], y[7]],
    }))
}
