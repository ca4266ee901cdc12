//! The equation of motion of a machine at one state: J q̈ + ½ J′ q̇² = M (I. M. Matsyuk & E. M.
//! Shlyakhov, equation 3, differentiated; with several drivers Lagrange's equations).

use std::f64::consts::TAU;

use nalgebra::{Cholesky, DMatrix, DVector};

use super::callbacks::Callbacks;
use super::error::{RunError, outside_table};
use super::model::ReducedModel;
use super::station_cursor::StationCursor;
use super::table_cursor::{MAX_COORDINATE, MAX_KNOTS, TableCursor, same_within};
use crate::dynamics::friction::motion::{Drive, SlidingState};
use crate::dynamics::motor::Motor;
use crate::dynamics::reduced::Reduced;
use crate::dynamics::stations::STEP;
use crate::dynamics::tables::table::{Cell, Table};
use crate::dynamics::value::Numbers;
use crate::ode::system::Fault;
use crate::query::failure::Failure;
use crate::state::status::Rejection;

/// Relative change of the speed for the difference quotient of callbacks: the cube root of the unit
/// roundoff, which balances rounding and curvature.
const SLOPE_STEP: f64 = 6.0e-6;

/// Halvings of an interval in search of a position that can be reached.
const HALVINGS: u32 = 40;

type EquationFault<E> = Fault<RunError<E>>;

/// The ends of an interval moved inward by one ulp, ascending.
pub(crate) fn just_inside(from: f64, to: f64) -> [f64; 2] {
    let (low, high) = (from.min(to).next_up(), from.max(to).next_down());
    [low.min(high), high.max(low)]
}

/// A machine with the values of tables, callbacks and motors at the current state.
pub(crate) struct Equation<'a, S, O> {
    pub model: &'a mut S,
    pub callbacks: O,
    pub tables: &'a [Table],
    pub motors: &'a [Motor],
    /// Inertia added to the first driver's, and a constant moment on it.
    pub flywheel: f64,
    pub extra_moment: f64,
    pub cursor: TableCursor,
    stations: StationCursor,
    /// The sense in which the only driver moves, +1 or −1, for loads that depend on it; 0 before a
    /// motion begins.
    pub sense: f64,
    /// The current piece of each motor's own table.
    pub motor_cells: Vec<Cell>,
    pub reduced: Reduced,
    /// Moments of the motors on the drivers.
    pub drive: Vec<f64>,
    /// Derivative of the first driver's by its speed.
    pub d_drive_d_speed: f64,
    /// Moment of friction on the only driver, at the last state.
    pub friction: f64,
    /// Whether friction left no acceleration at the last state.
    pub is_locked: bool,
    /// Ranges of time and coordinate in which callbacks are evaluated: just inside the breaks,
    /// where they may jump.
    pub times: [f64; 2],
    pub coordinates: [f64; 2],
    /// Whether derivatives of the callbacks by the speed are needed.
    pub wants_slopes: bool,
    /// The last position that was rejected: how it failed, and its coordinates.
    pub rejected: Option<(Rejection, Vec<f64>)>,
    readings: Vec<[f64; 2]>,
    external: Vec<[f64; 2]>,
    numbers: Vec<f64>,
    varied: Vec<f64>,
}

impl<'a, S: ReducedModel, O: Callbacks> Equation<'a, S, O> {
    pub(crate) fn new(
        model: &'a mut S,
        callbacks: O,
        tables: &'a [Table],
        motors: &'a [Motor],
        drivers: usize,
    ) -> Self {
        let count = callbacks.count();
        let unit = model.unit(0);
        Self {
            model,
            callbacks,
            tables,
            motors,
            flywheel: 0.0,
            extra_moment: 0.0,
            cursor: TableCursor::new(unit),
            stations: StationCursor::default(),
            sense: 0.0,
            motor_cells: vec![Cell::default(); motors.len()],
            reduced: Reduced::new(drivers),
            drive: vec![0.0; drivers],
            d_drive_d_speed: 0.0,
            friction: 0.0,
            is_locked: false,
            times: [f64::NEG_INFINITY, f64::INFINITY],
            coordinates: [f64::NEG_INFINITY, f64::INFINITY],
            wants_slopes: false,
            rejected: None,
            readings: vec![[f64::NAN; 2]; tables.len()],
            external: vec![[0.0; 2]; count],
            numbers: vec![0.0; count],
            varied: vec![0.0; count],
        }
    }

    /// Looks up the tables at the start of a motion.
    pub(crate) fn begin(&mut self, q: f64, speed: &[f64]) -> Result<(), RunError<O::Error>> {
        self.look_up(q)?;
        self.sense = speed[0].signum();
        if speed[0] == 0.0 {
            self.sense = 0.0;
        }
        for (motor, cell) in self.motors.iter().zip(&mut self.motor_cells) {
            if let Some(table) = motor.table() {
                let motor_speed = motor.ratio * speed[motor.driver];
                *cell = table.cell(motor_speed).ok_or_else(|| {
                    outside_table("motor's table over its speed", table, motor_speed)
                })?;
            }
        }
        Ok(())
    }

    /// Indices of the motors with a table over their speed.
    pub(crate) fn motors_with_table(&self) -> impl Iterator<Item = usize> + use<'a, S, O> {
        let motors = self.motors;
        (0..motors.len()).filter(move |&motor| motors[motor].table().is_some())
    }

    /// Distances of these motors' speeds from both ends of their pieces: two numbers per motor.
    pub(crate) fn motor_table_margins(&self, speed: &[f64], values: &mut [f64]) {
        for (pair, which) in values.chunks_exact_mut(2).zip(self.motors_with_table()) {
            let motor = &self.motors[which];
            let ends = motor.table().map(|table| table.ends(self.motor_cells[which]));
            let motor_speed = motor.ratio * speed[motor.driver];
            let [low, high] = ends.unwrap_or([f64::NAN; 2]);
            pair.copy_from_slice(&[motor_speed - low, high - motor_speed]);
        }
    }

    /// Moves a motor to the next piece of its table. Returns its driver and that driver's speed at
    /// the knot, inside the new piece; `None` if the table ends.
    pub(crate) fn advance_motor_table(&mut self, which: usize, up: bool) -> Option<(usize, f64)> {
        let motor = &self.motors[which];
        let table = motor.table()?;
        let cell = &mut self.motor_cells[which];
        let knot = table.ends(*cell)[usize::from(up)];
        *cell = table.next(*cell, up)?;
        let mut speed = knot / motor.ratio;
        // Rounding may leave the motor's speed short of the knot.
        let is_before = |speed: f64| {
            let motor_speed = motor.ratio * speed;
            if up { motor_speed < knot } else { motor_speed > knot }
        };
        while is_before(speed) {
            speed = if up == (motor.ratio > 0.0) { speed.next_up() } else { speed.next_down() };
        }
        Some((motor.driver, speed))
    }

    /// Looks up the tables in the middle of an interval between knots.
    pub(crate) fn enter_interval(&mut self, from: f64, to: f64) -> Result<(), RunError<O::Error>> {
        self.coordinates = just_inside(from, to);
        self.look_up(0.5 * (from + to))?;
        self.hold_between(from, to).map_err(|which| self.outside_curve(which))
    }

    /// Fixes the pieces and directions of loads that follow other coordinates between two stations.
    fn hold_between(&mut self, from: f64, to: f64) -> Result<(), (usize, f64)> {
        if !self.model.has_stations() {
            return Ok(());
        }
        // Beyond a dead point no position exists, or one of another motion.
        let mut beyond = self.reached_from(from, to);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (from + beyond);
            if self.model.hold(middle)? {
                break;
            }
            beyond = middle;
        }
        Ok(())
    }

    /// How far toward a coordinate, at most a turn, the mechanism moves without a gap: to the first position
    /// that it cannot reach, in steps like those of the search for stations.
    fn reached_from(&mut self, from: f64, to: f64) -> f64 {
        let unit = self.model.unit(0);
        let way = (to - from).clamp(-TAU * unit, TAU * unit);
        let steps = (way.abs() / (STEP * unit)).ceil().max(1.0);
        let mut at = 0.0;
        while at < steps {
            at += 1.0;
            let q = from + way * (at / steps);
            if self.model.inverse_condition(&[q]).is_nan() {
                return q;
            }
        }
        from + way
    }

    /// The error of a motion that begins where a table over another coordinate has no value, or ends.
    fn outside_at(&mut self, q: f64, ahead: (usize, f64)) -> RunError<O::Error> {
        let outside = self.model.hold(q).err().unwrap_or(ahead);
        self.outside_curve(outside)
    }

    fn outside_curve(&self, (which, at): (usize, f64)) -> RunError<O::Error> {
        match self.model.table_over(which) {
            Some(table) => outside_table("table over a slide or link", table, at),
            None => RunError::Options("a curve is missing".into()),
        }
    }

    /// Enters the interval between stations around a coordinate, or ahead of it where it is at a station. An
    /// error is the index of the table that ends there, and the missing value.
    fn face(&mut self, q: f64, up: bool) -> Result<(), (usize, f64)> {
        if !self.model.has_stations() {
            return Ok(());
        }
        let unit = self.model.unit(0);
        let model = &mut *self.model;
        let [low, high] = self.stations.around(q, up, unit, |range| model.stations(range));
        self.cursor.update_interval(self.tables);
        (self.cursor.low, self.cursor.high) =
            (self.cursor.low.max(low), self.cursor.high.min(high));
        if up { self.hold_between(q, high) } else { self.hold_between(q, low) }
    }

    /// Enters the interval between stations where a motion in time begins.
    pub(crate) fn begin_in_time(&mut self, q: f64, speed: f64) -> Result<(), RunError<O::Error>> {
        let is_far = q.abs() > MAX_COORDINATE * self.model.unit(0);
        if is_far {
            self.model.ignore_reversals();
        }
        if is_far && self.model.has_stations() {
            return Err(RunError::TooManyKnots { most: MAX_KNOTS, from: q, to: q });
        }
        self.face(q, speed >= 0.0).map_err(|outside| self.outside_at(q, outside))
    }

    /// Enters the first interval between stations of a motion along the coordinate.
    pub(crate) fn begin_along(
        &mut self,
        [from, to]: [f64; 2],
        stations: &[f64],
    ) -> Result<(), RunError<O::Error>> {
        let first = if to >= from { stations.first() } else { stations.last() };
        self.hold_between(from, first.copied().unwrap_or(to))
            .map_err(|outside| self.outside_at(from, outside))
    }

    /// Where a motion along the coordinate meets the end of a table over another coordinate, after its first
    /// interval between stations; and the index of that table, after those over the driver.
    pub(crate) fn first_uncovered(
        &mut self,
        [from, to]: [f64; 2],
        stations: &[f64],
    ) -> Option<(f64, usize)> {
        if !self.model.has_tables_over() {
            return None;
        }
        let mut places: Vec<f64> = stations.to_vec();
        if to < from {
            places.reverse();
        }
        places.push(to);
        places.windows(2).find_map(|pair| {
            let (which, _) = self.hold_between(pair[0], pair[1]).err()?;
            Some((pair[0], self.tables.len() + which))
        })
    }

    /// Turns to the sense of a motion that may begin at a coordinate, which may be a station. A table
    /// that ends there ends the motion later.
    pub(crate) fn turn_to(&mut self, q: f64, sense: f64) {
        self.sense = sense;
        let [low, high] = [self.cursor.low, self.cursor.high];
        let edge = if sense > 0.0 { high } else { low };
        let near = same_within(q, self.model.unit(0));
        if self.stations.has_begun() && (q - edge).abs() <= near {
            let _ = self.face(q, sense > 0.0);
        }
    }

    /// Passes on to the next interval between knots and stations. Returns the coordinate, inside it, or
    /// the index of the table that ends there: those of curves follow those over the driver.
    pub(crate) fn cross(&mut self, up: bool) -> Result<f64, usize> {
        let knot = self.cursor.cross(self.tables, up)?;
        self.face(knot, up).map_err(|(which, _)| self.tables.len() + which)?;
        Ok(knot)
    }

    fn look_up(&mut self, q: f64) -> Result<(), RunError<O::Error>> {
        let tables = self.tables;
        self.cursor
            .look_up(tables, q)
            .map_err(|which| outside_table("table over q", &tables[which], q))
    }

    /// Looks up the tables over the driver at a coordinate, unless their current pieces contain it. Returns false
    /// if a table does not.
    pub(crate) fn ensure_tables_at(&mut self, q: f64) -> bool {
        (self.cursor.low..=self.cursor.high).contains(&q)
            || self.cursor.look_up(self.tables, q).is_ok()
    }

    /// The failure at the last position that was rejected.
    pub(crate) fn failure(&self) -> Option<Failure> {
        let (rejection, q) = self.rejected.as_ref()?;
        self.model.failure(*rejection, q)
    }

    /// The error of a motion that cannot start at `q`.
    pub(crate) fn no_initial_position(&self, q: &[f64]) -> RunError<O::Error> {
        match self.failure() {
            Some(failure) => RunError::NoInitialPosition(failure),
            None => self.no_inertia(q, f64::NAN, 0),
        }
    }

    /// The error of a reduced inertia of a driver that is not positive.
    pub(crate) fn no_inertia(&self, q: &[f64], value: f64, driver: usize) -> RunError<O::Error> {
        RunError::NoInertia { q: q.to_vec(), value, driver: self.model.driver_name(driver) }
    }

    /// Whether the last rejected position is beside a near miss of a change point.
    pub(crate) fn is_near_miss(&self) -> bool {
        matches!(
            self.rejected,
            Some((Rejection::NearMiss { .. } | Rejection::ZeroLength { .. }, _))
        )
    }

    /// Reduces inertia, weights and springs at coordinates.
    #[inline]
    pub(crate) fn set_configuration(&mut self, q: &[f64]) -> Result<(), EquationFault<O::Error>> {
        self.cursor.read(self.tables, q[0], &mut self.readings);
        let numbers = Numbers { tables: &self.readings, ..Numbers::default() };
        if let Err(rejection) = self.model.set_configuration(q, numbers, &mut self.reduced) {
            self.rejected = Some((rejection, q.to_vec()));
            return Err(Fault::OutOfDomain);
        }
        self.reduced.inertia[0] += self.flywheel;
        Ok(())
    }

    /// Reduces all other loads and the motors' moments at these speeds.
    #[inline]
    pub(crate) fn apply_loads(
        &mut self,
        t: f64,
        q: &[f64],
        speed: &[f64],
    ) -> Result<(), EquationFault<O::Error>> {
        if !self.numbers.is_empty() {
            self.evaluate_callbacks(t, q, speed)
                .map_err(|error| Fault::Error(RunError::Callback(error)))?;
        }
        let (tables, external) = (&self.readings[..], &self.external[..]);
        let numbers = Numbers { tables, external, ..Numbers::default() };
        self.model.apply_loads(q, speed, self.sense, numbers, &mut self.reduced);
        self.drive.fill(0.0);
        self.drive[0] = self.extra_moment;
        self.d_drive_d_speed = 0.0;
        for (motor, &cell) in self.motors.iter().zip(&self.motor_cells) {
            let [moment, slope] = motor.moment(speed[motor.driver], cell, numbers);
            self.drive[motor.driver] += moment;
            self.d_drive_d_speed += slope;
        }
        Ok(())
    }

    fn evaluate_callbacks(&mut self, t: f64, q: &[f64], speed: &[f64]) -> Result<(), O::Error> {
        let (clamped, [from, to]) =
            ([q[0].clamp(self.coordinates[0], self.coordinates[1])], self.times);
        let t = t.clamp(from, to);
        let q = if q.len() == 1 { &clamped } else { q };
        self.callbacks.numbers(t, q, speed, &mut self.numbers)?;
        for (pair, &number) in self.external.iter_mut().zip(&self.numbers) {
            *pair = [number, 0.0];
        }
        if !self.wants_slopes {
            return Ok(());
        }
        let [low, high] = [1.0 - SLOPE_STEP, 1.0 + SLOPE_STEP].map(|part| speed[0] * part);
        self.callbacks.numbers(t, q, &[low], &mut self.numbers)?;
        self.callbacks.numbers(t, q, &[high], &mut self.varied)?;
        for ((pair, below), above) in self.external.iter_mut().zip(&self.numbers).zip(&self.varied)
        {
            pair[1] = (above - below) / (high - low);
        }
        Ok(())
    }

    /// Finds the acceleration and the moment of friction of the only driver at the state whose loads were
    /// applied last.
    pub(crate) fn accelerate_with_friction(
        &mut self,
        q: f64,
        state: SlidingState,
    ) -> Result<f64, EquationFault<O::Error>> {
        self.friction = 0.0;
        if !self.model.has_friction() {
            self.is_locked = false;
            let free = self.moment(0) - self.reduced.centrifugal(0, &[state.speed]);
            return Ok(free / self.inertia(q)?);
        }
        let rotors: f64 = self.motors.iter().map(Motor::inertia).sum();
        let drive = Drive { effort: self.drive[0], inertia: rotors + self.flywheel };
        let (tables, external) = (&self.readings[..], &self.external[..]);
        let numbers = Numbers { tables, external, ..Numbers::default() };
        let friction_acceleration = self.model.acceleration_with_friction(state, drive, numbers);
        self.is_locked = friction_acceleration.is_none();
        let Some(acceleration) = friction_acceleration else {
            self.rejected = None;
            return Err(Fault::OutOfDomain);
        };
        let free = self.moment(0) - self.reduced.centrifugal(0, &[state.speed]);
        self.friction = self.inertia(q)? * acceleration - free;
        Ok(acceleration)
    }

    /// Moment of all loads, motors and friction on a driver.
    pub(crate) fn moment(&self, driver: usize) -> f64 {
        let friction = if driver == 0 { self.friction } else { 0.0 };
        self.reduced.moment(driver) + self.drive[driver] + friction
    }

    /// Power of loads and motors that the potential energy does not include, W.
    pub(crate) fn power(&self, speed: &[f64]) -> f64 {
        let driver_power =
            |(driver, v): (usize, &f64)| (self.reduced.applied[driver] + self.drive[driver]) * v;
        let friction = self.friction * speed[0];
        speed.iter().enumerate().map(driver_power).sum::<f64>() + friction
    }

    /// The reduced inertia of a single driver.
    #[inline]
    pub(crate) fn inertia(&self, q: f64) -> Result<f64, EquationFault<O::Error>> {
        let value = self.reduced.inertia[0];
        // NaN must fail too.
        if value > 0.0 { Ok(value) } else { Err(Fault::Error(self.no_inertia(&[q], value, 0))) }
    }

    /// Accelerations of the drivers.
    pub(crate) fn accelerations(
        &self,
        q: &[f64],
        speed: &[f64],
        out: &mut [f64],
    ) -> Result<(), EquationFault<O::Error>> {
        let n = speed.len();
        let net = |driver| self.moment(driver) - self.reduced.centrifugal(driver, speed);
        if n == 1 {
            out[0] = net(0) / self.inertia(q[0])?;
            return Ok(());
        }
        let matrix = DMatrix::from_row_slice(n, n, &self.reduced.inertia);
        let (driver, smallest) = matrix.diagonal().argmin();
        let Some(factors) = Cholesky::new(matrix) else {
            return Err(Fault::Error(self.no_inertia(q, smallest.min(0.0), driver)));
        };
        let solved = factors.solve(&DVector::from_fn(n, |driver, _| net(driver)));
        out.copy_from_slice(solved.as_slice());
        Ok(())
    }
}
