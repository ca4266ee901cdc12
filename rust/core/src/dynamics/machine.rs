//! Bodies, loads and motors of a mechanism, referred to its drivers.

use std::sync::atomic::{AtomicBool, Ordering};

use super::body::Body;
use super::followers::{Followed, Followers};
use super::kinematics::SolvedPose;
use super::load::Load;
use super::measure::{Measure, Over};
use super::motor::Motor;
use super::pair_friction::Friction;
use super::reduced::Reduced;
use super::tables::table::Table;
use super::value::Numbers;
use crate::math::derivatives::DerivativeTables;
use crate::math::vector::Vector;
use crate::plan::mechanism::Mechanism;
use crate::query::evaluator::{Evaluator, Queries};
use crate::query::failure::Failure;
use crate::state::status::Status;

/// Masses, loads and motors of a mechanism.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Machine {
    /// Its bodies.
    pub bodies: Vec<Body>,
    /// Its loads.
    pub loads: Vec<Load>,
    /// Gravitational acceleration, m/s².
    pub gravity: [f64; 2],
    /// Tables over the first driver's coordinate, for loads and motors.
    pub tables: Vec<Table>,
    /// Curves over other coordinates, for loads and motors.
    pub over: Vec<Over>,
    /// Coordinates whose direction of motion loads follow.
    pub ways: Vec<Measure>,
    /// Its motors. Their rotors count in the machine's inertia, but their torque is not a load.
    pub motors: Vec<Motor>,
    /// Friction in its pairs: of [reactions](Machine::reactions), not of the reduced moment.
    pub friction: Vec<Friction>,
}

/// Positions of one design and the motion of its drivers there.
#[derive(Debug, Clone, Copy, Default)]
pub struct DrivenPositions<'a> {
    /// Coordinates, drivers fastest.
    pub q: &'a [f64],
    /// Speeds, drivers fastest.
    pub speed: &'a [f64],
    /// Sense in which each driver is about to move where all rest, +1 or −1. May be empty.
    pub sense: &'a [f64],
    /// The callbacks' values, the same number for each position.
    pub external: &'a [f64],
}

/// A machine referred to its drivers at many positions, one after another; NaN where a position
/// could not be solved.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ReducedTable {
    /// Mass matrices.
    pub inertia: Vec<f64>,
    /// Their derivatives by the drivers.
    pub d_inertia: Vec<f64>,
    /// Reduced moments (forces, for slides) of all loads.
    pub moment: Vec<f64>,
    /// Potential energies of weights and springs, J; NaN beyond a load's table.
    pub potential: Vec<f64>,
    /// Status of each position.
    pub status: Vec<Status>,
    /// The first position that failed, and why.
    pub failure: Option<(usize, Failure)>,
}

impl Machine {
    /// Refers a design to its drivers at positions. Ends early once `cancel` is true.
    #[must_use]
    pub fn reduce(
        &self,
        mechanism: &Mechanism,
        dimensions: &[f64],
        positions: DrivenPositions<'_>,
        cancel: &AtomicBool,
    ) -> ReducedTable {
        let DrivenPositions { q, speed, sense, external } = positions;
        let drivers = mechanism.q0().len();
        let mut rows = ReducedTable::default();
        if let Some(fault) = mechanism.dimensions().first_fault(dimensions) {
            for q in q.chunks_exact(drivers) {
                rows.push(None, drivers, Status::BadDimension);
                let failure = || (0, Failure::of_dimension(fault.clone(), q));
                rows.failure.get_or_insert_with(failure);
            }
            return rows;
        }
        let derivatives = DerivativeTables::new(drivers, 2);
        let queries = Queries::Listed(q);
        let mut evaluator =
            Evaluator::new(mechanism, dimensions, &derivatives, queries, self.needs_angles());
        let per_position = external.len().checked_div(q.len() / drivers).unwrap_or(0);
        let mut reduced = Reduced::new(drivers);
        let (mut tables, mut numbers) = (Vec::new(), Vec::new());
        let mut followers = Followers::default();
        for (row, (q, speed)) in
            q.chunks_exact(drivers).zip(speed.chunks_exact(drivers)).enumerate()
        {
            if cancel.load(Ordering::Relaxed) {
                break;
            }
            if let Err(rejection) = evaluator.solve(q) {
                rows.push(None, drivers, rejection.status());
                rows.failure.get_or_insert_with(|| (row, evaluator.failure(rejection, q)));
                continue;
            }
            let pose = SolvedPose::new(evaluator.position(), &derivatives);
            tables.clear();
            tables.extend(self.tables.iter().map(|table| [table.at(q[0]), 0.0]));
            numbers.clear();
            numbers.extend(
                external[row * per_position..(row + 1) * per_position]
                    .iter()
                    .map(|&number| [number, 0.0]),
            );
            self.add_configuration(&pose, &mut reduced);
            let rests = speed.iter().all(|&speed| speed == 0.0);
            followers.read(self.followed(), &pose, q, if rests { sense } else { speed });
            let numbers = Numbers { tables: &tables, external: &numbers, ..followers.numbers() };
            self.add_speed_loads(&pose, speed, numbers, &mut reduced);
            if !self.loads.iter().all(|load| load.is_covered(numbers)) {
                reduced.potential = f64::NAN;
            }
            // At a change point the values are those of the motion through it.
            let status = match evaluator.status() {
                Status::Ok => Status::Ok,
                _ => Status::NearSingular,
            };
            rows.push(Some(&reduced), drivers, status);
        }
        rows
    }

    /// Whether a load needs the angles of links, not only their derivatives.
    pub(crate) fn needs_angles(&self) -> bool {
        self.loads.iter().any(Load::reads_angles)
            || self.over.iter().any(|over| matches!(over.measure, Measure::Angle(_)))
    }

    /// The coordinates that loads follow, and the curves over them.
    pub(crate) fn followed(&self) -> Followed<'_> {
        Followed { over: &self.over, ways: &self.ways }
    }

    /// Whether loads follow other coordinates than the first driver's.
    pub(crate) fn follows(&self) -> bool {
        !(self.over.is_empty() && self.ways.is_empty())
    }

    /// Whether such loads may not be smooth over the drivers.
    #[must_use]
    pub fn has_stations(&self) -> bool {
        !self.ways.is_empty() || self.over.iter().any(|over| over.table().is_some())
    }

    /// Inertia, weights and springs at a position; replaces those in `out`.
    pub(crate) fn add_configuration(&self, pose: &SolvedPose<'_>, out: &mut Reduced) {
        out.clear();
        let n = out.conservative.len();
        for motor in &self.motors {
            out.inertia[motor.driver * n + motor.driver] += motor.inertia();
        }
        let gravity = Vector::new(self.gravity[0], self.gravity[1]);
        for body in &self.bodies {
            out.add_body(pose, body, gravity);
        }
        for load in &self.loads {
            load.add_conservative(pose, &self.over, out);
        }
    }

    /// All other loads at the same position and the given speeds; replaces those in `out`.
    pub(crate) fn add_speed_loads(
        &self,
        pose: &SolvedPose<'_>,
        speed: &[f64],
        numbers: Numbers<'_>,
        out: &mut Reduced,
    ) {
        out.applied.fill(0.0);
        out.d_moment_d_speed = 0.0;
        for load in &self.loads {
            load.add_applied(pose, speed, numbers, &self.over, out);
        }
    }
}

impl ReducedTable {
    fn push(&mut self, reduced: Option<&Reduced>, drivers: usize, status: Status) {
        self.status.push(status);
        let Some(reduced) = reduced else {
            let nan = |count| std::iter::repeat_n(f64::NAN, count);
            self.inertia.extend(nan(drivers * drivers));
            self.d_inertia.extend(nan(drivers * drivers * drivers));
            self.moment.extend(nan(drivers));
            self.potential.push(f64::NAN);
            return;
        };
        self.inertia.extend_from_slice(&reduced.inertia);
        self.d_inertia.extend_from_slice(&reduced.d_inertia);
        self.moment.extend((0..drivers).map(|driver| reduced.moment(driver)));
        self.potential.push(reduced.potential);
    }
}
