//! Bodies, loads and motors of a mechanism, referred to its drivers.

use std::sync::atomic::{AtomicBool, Ordering};

use super::body::Body;
use super::kinematics::Pose;
use super::load::Load;
use super::motor::Motor;
use super::reduced::Reduced;
use super::tables::table::Table;
use super::value::Numbers;
use crate::math::derivatives::DerivativeTables;
use crate::math::vector::Vector;
use crate::plan::mechanism::Mechanism;
use crate::query::evaluator::{Evaluator, Queries};
use crate::state::status::Status;

/// What a mechanism carries and what acts on it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Machine {
    /// Its bodies.
    pub bodies: Vec<Body>,
    /// Its loads.
    pub loads: Vec<Load>,
    /// Acceleration of free fall, m/s².
    pub gravity: [f64; 2],
    /// Tables over the first driver's coordinate that loads and motors refer to.
    pub tables: Vec<Table>,
    /// Its motors; their rotors' inertia is part of the machine's, their torque none of its loads.
    pub motors: Vec<Motor>,
}

/// A machine referred to its drivers at many positions, one after another; NaN where there is
/// nothing.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ReducedTable {
    /// Mass matrices.
    pub inertia: Vec<f64>,
    /// Their derivatives.
    pub rates: Vec<f64>,
    /// Reduced forces and moments of all loads.
    pub moment: Vec<f64>,
    /// Potential energies of weights and springs, J.
    pub potential: Vec<f64>,
    /// How the positions came out.
    pub status: Vec<Status>,
}

impl Machine {
    /// Refers a design to the drivers at positions (`q`, `speed`: drivers fastest; `given`: the
    /// numbers from outside of every position, as many each). Ends early once `cancel` is true.
    #[must_use]
    pub fn reduce(
        &self,
        mechanism: &Mechanism,
        dimensions: &[f64],
        q: &[f64],
        speed: &[f64],
        given: &[f64],
        cancel: &AtomicBool,
    ) -> ReducedTable {
        let drivers = mechanism.q0().len();
        let jets = DerivativeTables::new(drivers, 2);
        let asked = Queries::Listed(q);
        let mut follower = Evaluator::new(mechanism, dimensions, &jets, asked, self.has_torsion());
        let each = given.len().checked_div(q.len() / drivers).unwrap_or(0);
        let mut rows = ReducedTable::default();
        let mut reduced = Reduced::new(drivers);
        let (mut tables, mut numbers) = (Vec::new(), Vec::new());
        for (row, (q, speed)) in
            q.chunks_exact(drivers).zip(speed.chunks_exact(drivers)).enumerate()
        {
            if cancel.load(Ordering::Relaxed) {
                break;
            }
            if let Err(status) = follower.solve(q) {
                rows.push(None, drivers, status);
                continue;
            }
            let pose = Pose::new(follower.position(), &jets);
            tables.clear();
            tables.extend(self.tables.iter().map(|table| [table.at(q[0]), 0.0]));
            numbers.clear();
            numbers.extend(given[row * each..(row + 1) * each].iter().map(|&number| [number, 0.0]));
            self.place(&pose, &mut reduced);
            self.load(&pose, speed, Numbers { tables: &tables, given: &numbers }, &mut reduced);
            // At a change point the values are those of the motion through it.
            let status = match follower.status() {
                Status::Ok => Status::Ok,
                _ => Status::NearSingular,
            };
            rows.push(Some(&reduced), drivers, status);
        }
        rows
    }

    /// Whether a load asks for angles themselves.
    pub(crate) fn has_torsion(&self) -> bool {
        self.loads.iter().any(|load| matches!(load, Load::TorsionSpring { .. }))
    }

    /// Inertia, weights and springs at a position.
    pub(crate) fn place(&self, pose: &Pose<'_>, out: &mut Reduced) {
        out.clear();
        let n = out.stored.len();
        for motor in &self.motors {
            out.inertia[motor.driver * n + motor.driver] += motor.inertia();
        }
        let gravity = Vector::new(self.gravity[0], self.gravity[1]);
        for body in &self.bodies {
            out.add(pose, body, gravity);
        }
        for load in &self.loads {
            load.store(pose, out);
        }
    }

    /// All other loads there, at speeds.
    pub(crate) fn load(
        &self,
        pose: &Pose<'_>,
        speed: &[f64],
        numbers: Numbers<'_>,
        out: &mut Reduced,
    ) {
        out.applied.fill(0.0);
        out.by_speed = 0.0;
        for load in &self.loads {
            load.apply(pose, speed, numbers, out);
        }
    }
}

impl ReducedTable {
    fn push(&mut self, one: Option<&Reduced>, drivers: usize, status: Status) {
        self.status.push(status);
        let Some(one) = one else {
            let nothing = |count| std::iter::repeat_n(f64::NAN, count);
            self.inertia.extend(nothing(drivers * drivers));
            self.rates.extend(nothing(drivers * drivers * drivers));
            self.moment.extend(nothing(drivers));
            self.potential.push(f64::NAN);
            return;
        };
        self.inertia.extend_from_slice(&one.inertia);
        self.rates.extend_from_slice(&one.rates);
        self.moment.extend((0..drivers).map(|driver| one.moment(driver)));
        self.potential.push(one.potential);
    }
}
