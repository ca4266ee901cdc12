//! The equation of motion as a system of differential equations, along the time or the coordinate.

use std::time::Instant;

use super::callbacks::Callbacks;
use super::equation::{Equation, within};
use super::error::RunError;
use super::model::ReducedModel;
use super::options::{EventKind, EventSpec, RunOptions, Variable};
use crate::ode::system::{Action, Crossing, Fault, System};
use crate::state::status::Status;

/// What ended a run of itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Ended {
    /// A table over the coordinate.
    Table(usize),
    /// The table of a motor.
    Motor(usize),
    /// A dead point.
    Dead,
    /// The clock.
    Late,
}

/// A machine on its way. Along the time its state is q, q̇ and the work done by all that is not
/// told by the potential energy; along the coordinate q̇², the time and that work:
/// d(q̇²)/dq = (2 M − J′ q̇²)/J.
pub(crate) struct RunSystem<'a, S, O> {
    pub equation: Equation<'a, S, O>,
    pub along: Variable,
    pub watches: &'a [EventSpec],
    pub deadline: Option<Instant>,
    pub ended: Option<Ended>,
    /// Sign of the speed, along the coordinate.
    pub sign: f64,
    drivers: usize,
    /// Energy at the beginning, kinetic and potential, if it is known.
    energy: Option<[f64; 2]>,
    /// What is as near to a dead point may be at it.
    near: f64,
    /// The relative tolerance.
    relative: f64,
    /// Kinetic and potential energy less work where a step begins, and at the end of the last that
    /// was tried.
    total: f64,
    tried: f64,
}

/// In so many tolerances the energy may change over a step, as its error is estimated.
const DRIFT: f64 = 3.0;
/// Roundings of the energies themselves that are not counted as such.
const ROUNDINGS: f64 = 64.0;

/// Part of the energies of a motion below which what is left of the kinetic energy is none: the
/// balance is kept far better.
const AT_REST: f64 = 1.0e-6;
/// Distance from a dead point (rad, or of the size) within which one is looked for; with loose
/// tolerances a thousand of them, up to the second.
const NEAR: f64 = 1.0e-3;
const FAR: f64 = 0.05;
/// How far (rad, or of the size) to both sides the change of a condition is looked for.
const LOOK: f64 = 1.0e-6;

impl<'a, S: ReducedModel, O: Callbacks> RunSystem<'a, S, O> {
    pub(crate) fn new(equation: Equation<'a, S, O>, task: &RunOptions<'a>) -> Self {
        Self {
            equation,
            along: task.along,
            watches: task.watches,
            deadline: task.deadline,
            ended: None,
            sign: task.speed[0].signum(),
            drivers: task.q.len(),
            energy: None,
            near: (1.0e3 * task.relative).clamp(NEAR, FAR),
            relative: task.relative,
            total: f64::NAN,
            tried: f64::NAN,
        }
    }

    /// Takes the energy at the beginning, from which what is kinetic is told later.
    pub(crate) fn begin(&mut self, task: &RunOptions<'_>) -> Result<(), RunError<O::Error>> {
        match self.equation.place(task.q) {
            Ok(()) => {}
            Err(Fault::Error(error)) => return Err(error),
            Err(Fault::OutOfDomain) => return Err(RunError::NothingThere { q: task.q.to_vec() }),
        }
        let reduced = &self.equation.reduced;
        self.energy = Some([reduced.kinetic(task.speed), reduced.potential]);
        Ok(())
    }

    /// Kinetic and potential energy less work at the place found last, and its tolerance.
    fn balance(&self, y: &[f64]) -> (f64, f64) {
        let n = self.drivers;
        let alone = [self.sign * y[0].max(0.0).sqrt()];
        let (speed, work) = match self.along {
            Variable::Time => (&y[n..2 * n], y[2 * n]),
            Variable::Coordinate => (&alone[..], y[2]),
        };
        let (reduced, source) = (&self.equation.reduced, &self.equation.source);
        let kinetic = reduced.kinetic(speed);
        // Speeds are good to the tolerance, coordinates to as much of their unit.
        let by_place = |driver: usize| {
            let change = reduced.centrifugal(driver, speed) - reduced.stored[driver];
            change.abs() * source.unit(driver)
        };
        let by_places: f64 = (0..n).map(by_place).sum();
        let size = kinetic.abs() + reduced.potential.abs() + work.abs();
        let allowed = DRIFT * self.relative * (2.0 * kinetic + by_places)
            + ROUNDINGS * f64::EPSILON * size
            + source.noise() * kinetic;
        (kinetic + reduced.potential - work, allowed)
    }

    /// Whether a driver that rests at coordinates after some work is at a dead point: there is one
    /// as near as the coordinates are known, and by the balance kinetic energy is left, as the
    /// mechanism does not rest.
    pub(crate) fn is_dead(&mut self, q: &[f64], work: f64) -> bool {
        if !self.equation.source.is_beside_fold(q, self.near) {
            return false;
        }
        let Some([kinetic, potential]) = self.energy else { return true };
        if self.equation.place(q).is_err() {
            return true;
        }
        let change = self.equation.reduced.potential - potential;
        let size = kinetic.abs().max(work.abs()).max(change.abs());
        kinetic + work - change > AT_REST * size
    }

    /// How many numbers the state has.
    pub(crate) fn len(&self) -> usize {
        2 * self.drivers + 1
    }

    /// The state at the beginning.
    pub(crate) fn start(task: &RunOptions<'_>) -> Vec<f64> {
        match task.along {
            Variable::Time => [task.q, task.speed, &[0.0]].concat(),
            Variable::Coordinate => vec![task.speed[0] * task.speed[0], task.t, 0.0],
        }
    }

    /// Events at the borders of pieces come first: those of tables over q (along q they are breaks),
    /// then those of motors.
    fn has_table_borders(&self) -> bool {
        self.along == Variable::Time && !self.equation.tables.is_empty()
    }

    /// Behind them is the event that may be a dead point: of one driver its rest, of several the
    /// least distance from a singular position.
    fn has_dead_points(&self) -> bool {
        self.along == Variable::Time && self.equation.source.has_dead_points()
    }

    /// What makes each event function an event.
    pub(crate) fn crossings(&self) -> Vec<Crossing> {
        let tables = usize::from(self.has_table_borders()) + self.equation.tabled().count();
        let turning = if self.drivers == 1 { Crossing::Either } else { Crossing::Rising };
        let own = self.watches.iter().map(|watch| watch.crossing);
        std::iter::repeat_n(Crossing::Boundary, 2 * tables)
            .chain(std::iter::repeat_n(turning, usize::from(self.has_dead_points())))
            .chain(own)
            .collect()
    }

    /// How the distance from a singular position grows along the motion.
    fn receding(&mut self, q: &[f64], speed: &[f64]) -> f64 {
        let own = speed.iter().enumerate().map(|(i, v)| v.abs() / self.equation.source.unit(i));
        let fastest = own.fold(0.0_f64, f64::max);
        let [back, ahead] = [-LOOK, LOOK].map(|part| {
            let beside: Vec<f64> =
                q.iter().zip(speed).map(|(q, v)| q + part * v / fastest).collect();
            self.equation.source.flatness(&beside)
        });
        ahead - back
    }

    fn on_turning(&mut self, y: &[f64]) -> Action {
        let n = self.drivers;
        let dead = if n == 1 {
            self.is_dead(&y[..1], y[2])
        } else {
            self.equation.source.is_beside_fold(&y[..n], self.near)
        };
        if !dead {
            return Action::Continue;
        }
        self.equation.refused = Some((Status::Singular, y[..n].to_vec()));
        self.ended = Some(Ended::Dead);
        Action::Stop
    }

    /// Which watch an event is.
    pub(crate) fn watch(&self, event: usize) -> Option<usize> {
        event.checked_sub(self.crossings().len() - self.watches.len())
    }

    fn occasion(
        &mut self,
        occasion: &EventKind,
        t: f64,
        q: &[f64],
        speed: &[f64],
    ) -> Result<f64, RunError<O::Error>> {
        let equation = &mut self.equation;
        Ok(match *occasion {
            EventKind::Coordinate { driver, value } => q[driver] - value,
            EventKind::Speed { driver, value } => speed[driver] - value,
            EventKind::Angle(angle, value) => equation.source.angle(q, &angle) - value,
            EventKind::Outside(which) => {
                equation.outside.event(which, t, q, speed).map_err(RunError::Outside)?
            }
            EventKind::Extreme => {
                let there = equation.place(q).and_then(|()| equation.load(t, q, speed));
                match there {
                    Ok(()) => equation.moment(0) - equation.reduced.centrifugal(0, speed),
                    Err(Fault::OutOfDomain) => f64::NAN,
                    Err(Fault::Error(error)) => return Err(error),
                }
            }
        })
    }
}

impl<S: ReducedModel, O: Callbacks> System for RunSystem<'_, S, O> {
    type Error = RunError<O::Error>;

    fn rates(&mut self, x: f64, y: &[f64], rates: &mut [f64]) -> Result<(), Fault<Self::Error>> {
        let (n, equation) = (self.drivers, &mut self.equation);
        match self.along {
            Variable::Time => {
                let (q, speed) = (&y[..n], &y[n..2 * n]);
                equation.place(q)?;
                equation.load(x, q, speed)?;
                rates[..n].copy_from_slice(speed);
                equation.accelerations(q, speed, &mut rates[n..2 * n])?;
                rates[2 * n] = equation.power(speed);
            }
            Variable::Coordinate => {
                // At rest the way ends.
                let is_moving = y[0] > 0.0;
                if !is_moving {
                    equation.refused = None;
                    return Err(Fault::OutOfDomain);
                }
                let speed = [self.sign * y[0].sqrt()];
                equation.place(&[x])?;
                equation.load(y[1], &[x], &speed)?;
                let inertia = equation.inertia(x)?;
                // The quotient does not wait for the state.
                let inverse = 1.0 / inertia;
                rates[0] = (2.0 * equation.moment(0) - equation.reduced.rates[0] * y[0]) * inverse;
                rates[1] = 1.0 / speed[0];
                rates[2] = equation.reduced.applied[0] + equation.drive[0];
            }
        }
        Ok(())
    }

    fn begin_interval(&mut self, from: f64, to: f64, _: &[f64]) -> Result<(), Self::Error> {
        if self.along == Variable::Coordinate {
            return self.equation.enter(from, to);
        }
        // The pieces of tables were found at the knots.
        self.equation.times = within(from, to);
        Ok(())
    }

    fn events(&mut self, x: f64, y: &[f64], values: &mut [f64]) -> Result<(), Self::Error> {
        let (n, mut values) = (self.drivers, values);
        let (one, alone) = ([x], [self.sign * y[0].max(0.0).sqrt()]);
        let (t, q, speed) = match self.along {
            Variable::Time => (x, &y[..n], &y[n..2 * n]),
            Variable::Coordinate => (y[1], &one[..], &alone[..]),
        };
        if self.has_table_borders() {
            let reader = &self.equation.reader;
            (values[0], values[1]) = (y[0] - reader.low, reader.high - y[0]);
            values = &mut values[2..];
        }
        let (borders, rest) = values.split_at_mut(2 * self.equation.tabled().count());
        self.equation.motor_borders(speed, borders);
        values = rest;
        if self.has_dead_points() {
            values[0] = if n == 1 { speed[0] } else { self.receding(q, speed) };
            values = &mut values[1..];
        }
        for (value, watch) in values.iter_mut().zip(self.watches) {
            *value = self.occasion(&watch.occasion, t, q, speed)?;
        }
        Ok(())
    }

    fn on_event(&mut self, event: usize, _: f64, y: &mut [f64]) -> Result<Action, Self::Error> {
        if let Some(watch) = self.watch(event) {
            let stops = self.watches[watch].stops;
            return Ok(if stops { Action::Stop } else { Action::Continue });
        }
        let up = event % 2 == 1;
        let mut event = event;
        if self.has_table_borders() {
            if event < 2 {
                return Ok(match self.equation.reader.pass(self.equation.tables, up) {
                    Ok(knot) => {
                        y[0] = knot;
                        Action::Restart
                    }
                    Err(which) => {
                        self.ended = Some(Ended::Table(which));
                        Action::Stop
                    }
                });
            }
            event -= 2;
        }
        let Some(which) = self.equation.tabled().nth(event / 2) else {
            return Ok(self.on_turning(y));
        };
        let Some((driver, speed)) = self.equation.pass_motor(which, up) else {
            self.ended = Some(Ended::Motor(which));
            return Ok(Action::Stop);
        };
        match self.along {
            Variable::Time => y[self.drivers + driver] = speed,
            Variable::Coordinate => y[0] = speed * speed,
        }
        Ok(Action::Restart)
    }

    fn watch_invariant(&mut self, _: f64, y: &[f64]) {
        self.total = self.balance(y).0;
    }

    fn drift(&mut self, _: f64, y: &[f64]) -> f64 {
        let (total, allowed) = self.balance(y);
        self.tried = total;
        // Where the energy is not a number nothing is known of it.
        let drift = (total - self.total).abs() / allowed;
        if drift.is_finite() { drift } else { 0.0 }
    }

    fn keep_invariant(&mut self) {
        self.total = self.tried;
    }

    fn cancelled(&mut self) -> bool {
        if self.deadline.is_some_and(|deadline| Instant::now() >= deadline) {
            self.ended = Some(Ended::Late);
            return true;
        }
        self.equation.outside.cancelled()
    }
}
