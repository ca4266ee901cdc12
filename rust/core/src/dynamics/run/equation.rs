//! The equation of motion of a machine at one place: J q̈ + ½ J′ q̇² = M (I. M. Matsyuk & E. M.
//! Shlyakhov, equation 3, differentiated; of several drivers Lagrange's equations).

use nalgebra::{Cholesky, DMatrix, DVector};

use super::callbacks::Callbacks;
use super::error::{RunError, beyond};
use super::model::ReducedModel;
use super::table_cursor::Reader;
use crate::dynamics::motor::Motor;
use crate::dynamics::reduced::Reduced;
use crate::dynamics::tables::table::{Cell, Table};
use crate::dynamics::value::Numbers;
use crate::ode::system::Fault;
use crate::state::status::Status;

/// Part of the speed by which functions from outside are varied to find their slopes: the cube root
/// of the unit roundoff, where rounding and curvature are equal.
const VARIED: f64 = 6.0e-6;

type Stop<E> = Fault<RunError<E>>;

/// The numbers just within two others, ascending.
pub(crate) fn within(from: f64, to: f64) -> [f64; 2] {
    let (low, high) = (from.min(to).next_up(), from.max(to).next_down());
    [low.min(high), high.max(low)]
}

/// The machine with everything that is read at a place.
pub(crate) struct Equation<'a, S, O> {
    pub source: S,
    pub outside: O,
    pub tables: &'a [Table],
    pub motors: &'a [Motor],
    /// Inertia added to the first driver's, and a constant moment on it.
    pub flywheel: f64,
    pub extra: f64,
    pub reader: Reader,
    /// The piece of every motor's own table.
    pub cells: Vec<Cell>,
    pub reduced: Reduced,
    /// Moments of the motors on the drivers.
    pub drive: Vec<f64>,
    /// Derivative of the first by the speed.
    pub drive_by_speed: f64,
    /// Between which times or coordinates functions from outside are asked now: just within breaks,
    /// where they may jump.
    pub times: [f64; 2],
    pub coordinates: [f64; 2],
    /// Whether slopes of functions from outside are asked for.
    pub slopes: bool,
    /// Why there was nothing at the last place that was refused, and where.
    pub refused: Option<(Status, Vec<f64>)>,
    readings: Vec<[f64; 2]>,
    given: Vec<[f64; 2]>,
    numbers: Vec<f64>,
    varied: Vec<f64>,
}

impl<'a, S: ReducedModel, O: Callbacks> Equation<'a, S, O> {
    pub(crate) fn new(
        source: S,
        outside: O,
        tables: &'a [Table],
        motors: &'a [Motor],
        drivers: usize,
    ) -> Self {
        let count = outside.count();
        Self {
            source,
            outside,
            tables,
            motors,
            flywheel: 0.0,
            extra: 0.0,
            reader: Reader::new(),
            cells: vec![Cell::default(); motors.len()],
            reduced: Reduced::new(drivers),
            drive: vec![0.0; drivers],
            drive_by_speed: 0.0,
            times: [f64::NEG_INFINITY, f64::INFINITY],
            coordinates: [f64::NEG_INFINITY, f64::INFINITY],
            slopes: false,
            refused: None,
            readings: vec![[f64::NAN; 2]; tables.len()],
            given: vec![[0.0; 2]; count],
            numbers: vec![0.0; count],
            varied: vec![0.0; count],
        }
    }

    /// Looks tables up where a motion begins.
    pub(crate) fn begin(&mut self, q: f64, speed: &[f64]) -> Result<(), RunError<O::Error>> {
        self.look_up(q)?;
        for (motor, cell) in self.motors.iter().zip(&mut self.cells) {
            if let Some(table) = motor.table() {
                let own = motor.ratio * speed[motor.driver];
                *cell = table
                    .cell(own)
                    .ok_or_else(|| beyond("motor's table over its speed", table, own))?;
            }
        }
        Ok(())
    }

    /// The motors that have tables over their speed.
    pub(crate) fn tabled(&self) -> impl Iterator<Item = usize> + use<'a, S, O> {
        let motors = self.motors;
        (0..motors.len()).filter(move |&motor| motors[motor].table().is_some())
    }

    /// How far these are from the ends of their pieces, two numbers each.
    pub(crate) fn motor_borders(&self, speed: &[f64], values: &mut [f64]) {
        for (pair, which) in values.chunks_exact_mut(2).zip(self.tabled()) {
            let motor = &self.motors[which];
            let ends = motor.table().map(|table| table.ends(self.cells[which]));
            let own = motor.ratio * speed[motor.driver];
            let [low, high] = ends.unwrap_or([f64::NAN; 2]);
            pair.copy_from_slice(&[own - low, high - own]);
        }
    }

    /// A motor goes on to the next piece of its table: the driver and its speed there, inside that
    /// piece; none if the table ends.
    pub(crate) fn pass_motor(&mut self, which: usize, up: bool) -> Option<(usize, f64)> {
        let motor = &self.motors[which];
        let table = motor.table()?;
        let cell = &mut self.cells[which];
        let knot = table.ends(*cell)[usize::from(up)];
        *cell = table.next(*cell, up)?;
        let mut speed = knot / motor.ratio;
        // By its rounding the motor's own speed may be before the knot.
        let is_before = |speed: f64| {
            let own = motor.ratio * speed;
            if up { own < knot } else { own > knot }
        };
        while is_before(speed) {
            speed = if up == (motor.ratio > 0.0) { speed.next_up() } else { speed.next_down() };
        }
        Some((motor.driver, speed))
    }

    /// Looks tables up in the middle of a stretch between knots.
    pub(crate) fn enter(&mut self, from: f64, to: f64) -> Result<(), RunError<O::Error>> {
        self.coordinates = within(from, to);
        self.look_up(0.5 * (from + to))
    }

    fn look_up(&mut self, q: f64) -> Result<(), RunError<O::Error>> {
        let tables = self.tables;
        self.reader.place(tables, q).map_err(|which| beyond("table over q", &tables[which], q))
    }

    /// Looks tables up at a coordinate, unless they are in their pieces there; whether they are
    /// there.
    pub(crate) fn find(&mut self, q: f64) -> bool {
        (self.reader.low..=self.reader.high).contains(&q)
            || self.reader.place(self.tables, q).is_ok()
    }

    /// Whether the last place that was refused is beside a near miss of a change point.
    pub(crate) fn is_near_miss(&self) -> bool {
        matches!(self.refused, Some((Status::NearSingular, _)))
    }

    /// Inertia, weights and springs at coordinates.
    #[inline]
    pub(crate) fn place(&mut self, q: &[f64]) -> Result<(), Stop<O::Error>> {
        self.reader.read(self.tables, q[0], &mut self.readings);
        let numbers = Numbers { tables: &self.readings, given: &[] };
        if let Err(status) = self.source.place(q, numbers, &mut self.reduced) {
            self.refused = Some((status, q.to_vec()));
            return Err(Fault::OutOfDomain);
        }
        self.reduced.inertia[0] += self.flywheel;
        Ok(())
    }

    /// All other loads and motors there, at speeds.
    #[inline]
    pub(crate) fn load(&mut self, t: f64, q: &[f64], speed: &[f64]) -> Result<(), Stop<O::Error>> {
        if !self.numbers.is_empty() {
            self.call(t, q, speed).map_err(|error| Fault::Error(RunError::Outside(error)))?;
        }
        let numbers = Numbers { tables: &self.readings, given: &self.given };
        self.source.load(speed, numbers, &mut self.reduced);
        self.drive.fill(0.0);
        self.drive[0] = self.extra;
        self.drive_by_speed = 0.0;
        for (motor, &cell) in self.motors.iter().zip(&self.cells) {
            let [moment, slope] = motor.moment(speed[motor.driver], cell, numbers);
            self.drive[motor.driver] += moment;
            self.drive_by_speed += slope;
        }
        Ok(())
    }

    fn call(&mut self, t: f64, q: &[f64], speed: &[f64]) -> Result<(), O::Error> {
        let (one, [from, to]) =
            ([q[0].clamp(self.coordinates[0], self.coordinates[1])], self.times);
        let t = t.clamp(from, to);
        let q = if q.len() == 1 { &one } else { q };
        self.outside.numbers(t, q, speed, &mut self.numbers)?;
        for (pair, &number) in self.given.iter_mut().zip(&self.numbers) {
            *pair = [number, 0.0];
        }
        if !self.slopes {
            return Ok(());
        }
        let [low, high] = [1.0 - VARIED, 1.0 + VARIED].map(|part| speed[0] * part);
        self.outside.numbers(t, q, &[low], &mut self.numbers)?;
        self.outside.numbers(t, q, &[high], &mut self.varied)?;
        for ((pair, below), above) in self.given.iter_mut().zip(&self.numbers).zip(&self.varied) {
            pair[1] = (above - below) / (high - low);
        }
        Ok(())
    }

    /// Moment of all that acts on a driver, motors among it.
    pub(crate) fn moment(&self, driver: usize) -> f64 {
        self.reduced.moment(driver) + self.drive[driver]
    }

    /// Power of all that is not told by the potential energy, W.
    pub(crate) fn power(&self, speed: &[f64]) -> f64 {
        let of =
            |(driver, v): (usize, &f64)| (self.reduced.applied[driver] + self.drive[driver]) * v;
        speed.iter().enumerate().map(of).sum()
    }

    /// The reduced inertia of the one driver.
    #[inline]
    pub(crate) fn inertia(&self, q: f64) -> Result<f64, Stop<O::Error>> {
        let value = self.reduced.inertia[0];
        // NaN as well is none.
        if value > 0.0 { Ok(value) } else { Err(Fault::Error(RunError::NoInertia { q, value })) }
    }

    /// Accelerations of the drivers there.
    pub(crate) fn accelerations(
        &self,
        q: &[f64],
        speed: &[f64],
        out: &mut [f64],
    ) -> Result<(), Stop<O::Error>> {
        let n = speed.len();
        let net = |driver| self.moment(driver) - self.reduced.centrifugal(driver, speed);
        if n == 1 {
            out[0] = net(0) / self.inertia(q[0])?;
            return Ok(());
        }
        let matrix = DMatrix::from_row_slice(n, n, &self.reduced.inertia);
        let least = matrix.diagonal().min();
        let Some(factors) = Cholesky::new(matrix) else {
            return Err(Fault::Error(RunError::NoInertia { q: q[0], value: least.min(0.0) }));
        };
        let solved = factors.solve(&DVector::from_fn(n, |driver, _| net(driver)));
        out.copy_from_slice(solved.as_slice());
        Ok(())
    }
}
