//! The equation of motion as a system of differential equations, in time or in the coordinate.

use std::time::Instant;

use super::callbacks::Callbacks;
use super::equation::{Equation, just_inside};
use super::error::RunError;
use super::lane_equation::{Configuration, MAX_DRIFT, ROUNDINGS};

use super::model::ReducedModel;
use super::options::{EventKind, EventSpec, RunOptions};
use super::stick_slip::{Change, Phase};
use super::variable::Variable;
use crate::dynamics::friction::motion::SlidingState;
use crate::ode::system::{Action, Attempt, Crossing, Fault, System};
use crate::state::status::Rejection;

/// The cause of an early end of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Ended {
    /// The end of a table over the coordinate.
    Table(usize),
    /// The end of a motor's table.
    Motor(usize),
    /// A dead point.
    DeadPoint,
    /// The time limit.
    TimeLimit,
}

/// A machine in motion. In time its state is q, q̇ and the work that the potential energy does not
/// include; in the coordinate it is q̇², the time and that work: d(q̇²)/dq = (2 M − J′ q̇²)/J.
pub(crate) struct RunSystem<'a, S, O> {
    pub equation: Equation<'a, S, O>,
    pub along: Variable,
    pub events: &'a [EventSpec],
    pub deadline: Option<Instant>,
    pub ended: Option<Ended>,
    /// Sign of the speed, for a run along the coordinate.
    pub sign: f64,
    pub(super) phase: Phase,
    /// All changes of the phase, one for each event of friction.
    pub(super) changes: Vec<Change>,
    /// The greatest speed with which it has hit an obstacle.
    pub(super) hardest_hit: f64,
    pub(super) drivers: usize,
    /// Whether friction locks it ahead.
    pub(super) locks_ahead: bool,
    /// Initial kinetic and potential energy, once known.
    energy: Option<[f64; 2]>,
    /// Within this distance of a dead point a driver at rest may be at it.
    reach: f64,
    /// The relative tolerance, and that of the first driver's coordinate, rad or m.
    relative: f64,
    pub(super) tolerance: f64,
    /// Kinetic and potential energy less work: at the start of a step, and at the end of the last
    /// trial step.
    total: f64,
    trial_total: f64,
}

/// Kinetic energy below this part of the energies of a motion counts as zero: the balance is kept
/// far better.
const AT_REST: f64 = 1.0e-6;
/// Bounds of the distance (rad, or of the size) within which to look for a dead point: it is a
/// thousand relative tolerances.
/// The lower bound holds for one driver: with several, no balance of energies distinguishes a dead point
/// from a motion that passes near one.
const MIN_REACH: f64 = 1.0e-3;
const MAX_REACH: f64 = 0.05;
/// Step (rad, or of the size) to both sides for the change of a condition.
const CONDITION_STEP: f64 = 1.0e-6;
impl<'a, S: ReducedModel, O: Callbacks> RunSystem<'a, S, O> {
    /// `size`: the unit of the tolerance of the first driver's coordinate.
    pub(crate) fn new(equation: Equation<'a, S, O>, options: &RunOptions<'a>, size: f64) -> Self {
        let drivers = options.q.len();
        let least_reach = if drivers == 1 { MIN_REACH } else { 0.0 };
        Self {
            equation,
            along: options.along,
            events: options.events,
            deadline: options.deadline,
            ended: None,
            sign: options.speed[0].signum(),
            phase: Phase::Smooth,
            changes: Vec::new(),
            hardest_hit: 0.0,
            drivers,
            locks_ahead: false,
            energy: None,
            reach: (1.0e3 * options.relative).clamp(least_reach, MAX_REACH),
            relative: options.relative,
            tolerance: options.relative * size,
            total: f64::NAN,
            trial_total: f64::NAN,
        }
    }

    /// Stores the initial energy, from which `is_at_dead_point` takes the balance.
    pub(crate) fn store_initial_energy(
        &mut self,
        options: &RunOptions<'_>,
    ) -> Result<(), RunError<O::Error>> {
        match self.equation.set_configuration(options.q) {
            Ok(()) => {}
            Err(Fault::Error(error)) => return Err(error),
            Err(Fault::OutOfDomain) => return Err(self.equation.no_initial_position(options.q)),
        }
        let reduced = &self.equation.reduced;
        self.energy = Some([reduced.kinetic(options.speed), reduced.potential]);
        Ok(())
    }

    /// Takes the configuration at the end of an accepted step, and the total energy there.
    pub(super) fn take(&mut self, configuration: Configuration, total: f64) {
        let reduced = &mut self.equation.reduced;
        reduced.inertia[0] = configuration.inertia;
        reduced.d_inertia[0] = configuration.d_inertia;
        reduced.conservative[0] = configuration.conservative;
        reduced.potential = configuration.potential;
        self.trial_total = total;
    }

    /// Kinetic and potential energy less work at the start of a step, and the relative tolerance.
    pub(super) fn watched(&self) -> [f64; 2] {
        [self.total, self.relative]
    }

    /// Kinetic and potential energy less work at the last position, and the tolerance of that sum; `noise`: the
    /// relative rounding error of the inertia.
    fn balance(&self, y: &[f64], noise: f64) -> (f64, f64) {
        let n = self.drivers;
        let own_speed = [self.sign * y[0].max(0.0).sqrt()];
        let (speed, work) = match self.along {
            Variable::Time => (&y[n..2 * n], y[2 * n]),
            Variable::Coordinate => (&own_speed[..], y[2]),
        };
        let (reduced, model) = (&self.equation.reduced, &self.equation.model);
        let kinetic = reduced.kinetic(speed);
        // Speeds are accurate to the relative tolerance, coordinates to that part of their unit.
        let by_coordinate = |driver: usize| {
            let change = reduced.centrifugal(driver, speed) - reduced.conservative[driver];
            change.abs() * model.unit(driver)
        };
        let by_coordinates: f64 = (0..n).map(by_coordinate).sum();
        let size = kinetic.abs() + reduced.potential.abs() + work.abs();
        let allowed = MAX_DRIFT * self.relative * (2.0 * kinetic + by_coordinates)
            + ROUNDINGS * f64::EPSILON * size
            + noise * kinetic;
        (kinetic + reduced.potential - work, allowed)
    }

    /// Whether a driver at rest after some work is at a dead point: one is near, and by the energy
    /// balance kinetic energy is left, so the mechanism itself still moves.
    pub(crate) fn is_at_dead_point(&mut self, q: &[f64], work: f64) -> bool {
        if !self.equation.model.is_near_dead_point(q, self.reach) {
            return false;
        }
        let Some([kinetic, potential]) = self.energy else { return true };
        if self.equation.set_configuration(q).is_err() {
            return true;
        }
        let change = self.equation.reduced.potential - potential;
        let size = kinetic.abs().max(work.abs()).max(change.abs());
        kinetic + work - change > AT_REST * size
    }

    /// Length of the state.
    pub(crate) fn len(&self) -> usize {
        2 * self.drivers + 1
    }

    /// The initial state.
    pub(crate) fn initial_state(options: &RunOptions<'_>) -> Vec<f64> {
        match options.along {
            Variable::Time => [options.q, options.speed, &[0.0]].concat(),
            Variable::Coordinate => vec![options.speed[0] * options.speed[0], options.t, 0.0],
        }
    }

    /// Boundaries of table pieces are the first events: those of tables over q and stations (in a run
    /// along q they are breaks), then those of motors.
    fn has_table_boundaries(&self) -> bool {
        let has_tables = !self.equation.tables.is_empty() || self.equation.model.has_stations();
        self.along == Variable::Time && has_tables
    }

    /// Next comes the event that may be a dead point: for a single driver its rest, for several the
    /// least distance from a singular position.
    fn has_dead_points(&self) -> bool {
        self.along == Variable::Time
            && !self.has_stick_slip()
            && self.equation.model.has_dead_points()
    }

    /// In its place comes the event that friction stops a machine, or no longer holds it.
    fn has_stick_slip(&self) -> bool {
        self.along == Variable::Time && self.phase != Phase::Smooth
    }

    /// Index of that event.
    pub(crate) fn friction_event(&self) -> Option<usize> {
        let before = self.crossings().len() - self.events.len();
        self.has_stick_slip().then(|| before - 1)
    }

    /// The direction of crossing of each event function.
    pub(crate) fn crossings(&self) -> Vec<Crossing> {
        let tables =
            usize::from(self.has_table_boundaries()) + self.equation.motors_with_table().count();
        let crossing = if self.drivers == 1 { Crossing::Either } else { Crossing::Rising };
        let directions = self.events.iter().map(|event| event.crossing);
        std::iter::repeat_n(Crossing::Boundary, 2 * tables)
            .chain(std::iter::repeat_n(crossing, usize::from(self.has_dead_points())))
            .chain(std::iter::repeat_n(Crossing::Rising, usize::from(self.has_stick_slip())))
            .chain(directions)
            .collect()
    }

    /// The greatest speed, in units of its coordinate.
    pub(super) fn fastest(&self, speed: &[f64]) -> f64 {
        let relative = |(i, v): (usize, &f64)| v.abs() / self.equation.model.unit(i);
        speed.iter().enumerate().map(relative).fold(0.0, f64::max)
    }

    /// Whether the distance from a singular position grows (> 0) or falls along the motion.
    fn singularity_trend(&mut self, q: &[f64], speed: &[f64]) -> f64 {
        let fastest = self.fastest(speed);
        let [back, ahead] = [-CONDITION_STEP, CONDITION_STEP].map(|step| {
            let beside: Vec<f64> =
                q.iter().zip(speed).map(|(q, v)| q + step * v / fastest).collect();
            self.equation.model.inverse_condition(&beside)
        });
        ahead - back
    }

    fn on_possible_dead_point(&mut self, y: &[f64]) -> Action {
        let n = self.drivers;
        let at_dead_point = if n == 1 {
            self.is_at_dead_point(&y[..1], y[2])
        } else {
            self.equation.model.is_near_dead_point(&y[..n], self.reach)
        };
        if !at_dead_point {
            return Action::Continue;
        }
        self.equation.rejected = Some((Rejection::DeadPoint { step: None }, y[..n].to_vec()));
        self.ended = Some(Ended::DeadPoint);
        Action::Stop
    }

    /// Index of the `EventSpec` of an event.
    pub(crate) fn event_index(&self, event: usize) -> Option<usize> {
        event.checked_sub(self.crossings().len() - self.events.len())
    }

    fn event_value(
        &mut self,
        kind: &EventKind,
        t: f64,
        q: &[f64],
        speed: &[f64],
    ) -> Result<f64, RunError<O::Error>> {
        let equation = &mut self.equation;
        Ok(match *kind {
            EventKind::Coordinate { driver, value } => q[driver] - value,
            EventKind::Speed { driver, value } => speed[driver] - value,
            EventKind::Angle(angle, value) => equation.model.angle(q, &angle) - value,
            EventKind::Callback(which) => {
                equation.callbacks.event(which, t, q, speed).map_err(RunError::Callback)?
            }
            EventKind::Extreme => {
                if let Phase::Slip(sense) = self.phase {
                    equation.sense = sense;
                }
                let outcome =
                    equation.set_configuration(q).and_then(|()| equation.apply_loads(t, q, speed));
                match outcome {
                    Ok(()) => match self.phase {
                        Phase::Smooth => {
                            equation.moment(0) - equation.reduced.centrifugal(0, speed)
                        }
                        Phase::Stick => f64::NAN,
                        Phase::Slip(sense) => {
                            let speed = speed[0];
                            let state = SlidingState { speed, sense, is_static: false };
                            equation.accelerate_with_friction(q[0], state).unwrap_or(f64::NAN)
                        }
                    },
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
        if let Phase::Slip(sense) = self.phase {
            equation.sense = sense;
        }
        match self.along {
            Variable::Time => {
                let (q, speed) = (&y[..n], &y[n..2 * n]);
                equation.set_configuration(q)?;
                equation.apply_loads(x, q, speed)?;
                rates[..n].copy_from_slice(speed);
                match self.phase {
                    Phase::Smooth => equation.accelerations(q, speed, &mut rates[n..2 * n])?,
                    Phase::Slip(sense) => {
                        let state = SlidingState { speed: speed[0], sense, is_static: false };
                        rates[1] = equation.accelerate_with_friction(q[0], state)?;
                    }
                    Phase::Stick => {
                        rates.fill(0.0);
                        return Ok(());
                    }
                }
                rates[2 * n] = equation.power(speed);
            }
            Variable::Coordinate => {
                // A run along the coordinate ends at rest.
                let is_moving = y[0] > 0.0;
                if !is_moving {
                    equation.rejected = None;
                    return Err(Fault::OutOfDomain);
                }
                let speed = [self.sign * y[0].sqrt()];
                equation.set_configuration(&[x])?;
                equation.apply_loads(y[1], &[x], &speed)?;
                if let Phase::Slip(sense) = self.phase {
                    let state = SlidingState { speed: speed[0], sense, is_static: false };
                    rates[0] = 2.0 * equation.accelerate_with_friction(x, state)?;
                    rates[1] = 1.0 / speed[0];
                    rates[2] = equation.power(&speed) / speed[0];
                    return Ok(());
                }
                let inertia = equation.inertia(x)?;
                // The quotient does not wait for the state.
                let inverse = 1.0 / inertia;
                rates[0] =
                    (2.0 * equation.moment(0) - equation.reduced.d_inertia[0] * y[0]) * inverse;
                rates[1] = 1.0 / speed[0];
                rates[2] = equation.reduced.applied[0] + equation.drive[0];
            }
        }
        Ok(())
    }

    fn step_to_boundary(
        &mut self,
        x: f64,
        y: &[f64],
        last: Attempt,
    ) -> Result<Option<f64>, Self::Error> {
        self.aim_at_boundary(x, y, last)
    }

    fn begin_interval(&mut self, from: f64, to: f64, _: &[f64]) -> Result<(), Self::Error> {
        if self.along == Variable::Coordinate {
            return self.equation.enter_interval(from, to);
        }
        // The table pieces were set when their knots were crossed.
        self.equation.times = just_inside(from, to);
        Ok(())
    }

    fn events(&mut self, x: f64, y: &[f64], values: &mut [f64]) -> Result<(), Self::Error> {
        let (n, mut values) = (self.drivers, values);
        let (own_q, own_speed) = ([x], [self.sign * y[0].max(0.0).sqrt()]);
        let (t, q, speed) = match self.along {
            Variable::Time => (x, &y[..n], &y[n..2 * n]),
            Variable::Coordinate => (y[1], &own_q[..], &own_speed[..]),
        };
        if self.has_table_boundaries() {
            let cursor = &self.equation.cursor;
            (values[0], values[1]) = (y[0] - cursor.low, cursor.high - y[0]);
            values = &mut values[2..];
        }
        let (margins, rest) = values.split_at_mut(2 * self.equation.motors_with_table().count());
        self.equation.motor_table_margins(speed, margins);
        values = rest;
        if self.has_dead_points() {
            values[0] = if n == 1 { speed[0] } else { self.singularity_trend(q, speed) };
            values = &mut values[1..];
        }
        if self.has_stick_slip() {
            values[0] = match self.phase {
                Phase::Slip(sense) => -speed[0] * sense,
                _ => self.equation.slip_margin(t, q[0])?,
            };
            values = &mut values[1..];
        }
        for (value, spec) in values.iter_mut().zip(self.events) {
            *value = self.event_value(&spec.kind, t, q, speed)?;
        }
        Ok(())
    }

    fn on_event(&mut self, event: usize, t: f64, y: &mut [f64]) -> Result<Action, Self::Error> {
        if let Some(index) = self.event_index(event) {
            let EventSpec { stops, rebound, .. } = self.events[index];
            if let Some(restitution) = rebound {
                return self.rebound(restitution, t, y);
            }
            return Ok(if stops { Action::Stop } else { Action::Continue });
        }
        let up = event % 2 == 1;
        let mut event = event;
        if self.has_table_boundaries() {
            if event < 2 {
                return Ok(match self.equation.cross(up) {
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
        let Some(which) = self.equation.motors_with_table().nth(event / 2) else {
            if !self.has_stick_slip() || self.phase != Phase::Stick {
                let action = self.on_possible_dead_point(y);
                if action == Action::Stop || !self.has_stick_slip() {
                    return Ok(action);
                }
            }
            y[1] = 0.0;
            let (phase, change) = self.equation.next_phase(self.phase, t, y[0])?;
            self.phase = phase;
            self.changes.push(change);
            return Ok(Action::Restart);
        };
        let Some((driver, speed)) = self.equation.advance_motor_table(which, up) else {
            self.ended = Some(Ended::Motor(which));
            return Ok(Action::Stop);
        };
        match self.along {
            Variable::Time => y[self.drivers + driver] = speed,
            Variable::Coordinate => y[0] = speed * speed,
        }
        Ok(Action::Restart)
    }

    /// The speed, where only its sign is watched: a driver at rest may be at a dead point.
    fn event_component(&self) -> Option<usize> {
        let is_alone = self.events.is_empty()
            && !self.has_table_boundaries()
            && self.equation.motors_with_table().next().is_none();
        (self.drivers == 1 && is_alone && self.has_dead_points()).then_some(1)
    }

    fn may_cut(&self, event: usize) -> bool {
        self.event_index(event).is_none_or(|index| {
            let EventSpec { stops, rebound, .. } = self.events[index];
            stops || rebound.is_some()
        })
    }

    fn place(&mut self, _: f64, y: &[f64]) {
        // Its rates are known, so it exists.
        let _ = self.equation.set_configuration(&y[..self.drivers]);
    }

    fn watch_invariant(&mut self, _: f64, y: &[f64]) {
        self.total = self.balance(y, 0.0).0;
    }

    fn drift(&mut self, _: f64, y: &[f64]) -> f64 {
        let noise = self.equation.model.inertia_noise();
        let (total, allowed) = self.balance(y, noise);
        self.trial_total = total;
        // Without a finite energy there is nothing to check.
        let drift = (total - self.total).abs() / allowed;
        if drift.is_finite() { drift } else { 0.0 }
    }

    fn keep_invariant(&mut self) {
        self.total = self.trial_total;
    }

    fn cancelled(&mut self) -> bool {
        if self.deadline.is_some_and(|deadline| Instant::now() >= deadline) {
            self.ended = Some(Ended::TimeLimit);
            return true;
        }
        self.equation.callbacks.cancelled()
    }
}
