//! Where inertia and loads of a machine come from: a mechanism, or tables.

use crate::dynamics::angle_between::Angle;
use crate::dynamics::kinematics::Pose;
use crate::dynamics::machine::{Machine, ReducedTable};
use crate::dynamics::motor::Motor;
use crate::dynamics::reduced::Reduced;
use crate::dynamics::tables::table::Table;
use crate::dynamics::value::Numbers;
use crate::math::derivatives::DerivativeTables;
use crate::math::tolerance::{ANALOGUE_PER_CONDITION_SQUARED, NEAR_SINGULAR_CONDITION};
use crate::plan::mechanism::Mechanism;
use crate::query::evaluator::{Evaluator, NearMiss, Queries};
use crate::state::status::Status;

/// A machine, place after place.
pub(crate) trait ReducedModel {
    /// Finds inertia, weights and springs at coordinates.
    ///
    /// # Errors
    ///
    /// Why there is nothing.
    fn place(&mut self, q: &[f64], numbers: Numbers<'_>, out: &mut Reduced) -> Result<(), Status>;

    /// Finds the other loads at the place found last, at speeds.
    fn load(&mut self, speed: &[f64], numbers: Numbers<'_>, out: &mut Reduced);

    /// An angle at coordinates; NaN where there is none.
    fn angle(&mut self, q: &[f64], angle: &Angle) -> f64;

    /// What a driver's coordinate is measured in: the size of a slide, of an angle 1.
    fn unit(&self, driver: usize) -> f64;

    /// Whether there may be dead points.
    fn has_dead_points(&self) -> bool;

    /// Where the dead point ahead of the one driver's coordinate is, if it is near.
    fn fold(&mut self, q: f64, way: f64) -> Option<f64>;

    /// The near miss of a change point beside the one driver's coordinate, if there is one.
    fn near_miss(&mut self, q: f64) -> Option<NearMiss>;

    /// Whether there is a dead point within this part of a radian (or of the size).
    fn is_beside_fold(&mut self, q: &[f64], within: f64) -> bool;

    /// Part of the inertia at the last place that is rounding.
    fn noise(&self) -> f64;

    /// How far coordinates are from a singular position (the inverse of the condition); NaN where
    /// there is nothing.
    fn flatness(&mut self, q: &[f64]) -> f64;
}

/// A machine with its mechanism.
pub(crate) struct MechanismModel<'m> {
    machine: &'m Machine,
    jets: &'m DerivativeTables,
    follower: Evaluator<'m>,
}

/// Beyond this condition of a dyad or group too few digits of the analogues are left to be
/// integrated: some eight of them (64 u κ²). A dead point at a distance x has about 1/√x, so this
/// is some 1e-7 before it.
const GREATEST_CONDITION: f64 = 3.0e3;
/// Where there is a dead point it is within this part of 1/κ².
const FOLD_WITHIN: f64 = 1.0e3;
/// Halvings on the way to it.
const HALVINGS: u32 = 80;

impl<'m> MechanismModel<'m> {
    /// How far from here a dead point may be, in the coordinate's unit; not farther than `most` of
    /// it.
    fn reach(&self, driver: usize, most: f64) -> f64 {
        let (_, condition) = self.follower.worst_condition();
        (FOLD_WITHIN / (condition * condition)).min(most) * self.follower.unit(driver)
    }

    /// Whether a dead point is near the place solved last.
    fn folds_near(&mut self, q: &[f64], most: f64) -> bool {
        let reaches: Vec<f64> = (0..q.len()).map(|driver| self.reach(driver, most)).collect();
        let mut beside = q.to_vec();
        for (driver, reach) in reaches.into_iter().enumerate() {
            for way in [-reach, reach] {
                beside[driver] = q[driver] + way;
                if self.follower.probe(&beside).is_err() {
                    return true;
                }
                beside[driver] = q[driver];
            }
        }
        false
    }

    /// Refuses a place beside a dead point or a near miss of a change point.
    #[cold]
    #[inline(never)]
    fn look_around(&mut self, q: &[f64]) -> Result<(), Status> {
        let (step, condition) = self.follower.worst_condition();
        if condition > GREATEST_CONDITION {
            if self.folds_near(q, f64::INFINITY) {
                return Err(Status::Singular);
            }
            if q.len() == 1 && step.is_some() && condition > NEAR_SINGULAR_CONDITION {
                return Err(Status::NearSingular);
            }
            self.follower.solve(q)?;
        }
        Ok(())
    }

    pub(crate) fn new(
        machine: &'m Machine,
        mechanism: &'m Mechanism,
        dimensions: &[f64],
        jets: &'m DerivativeTables,
    ) -> Self {
        let lifted = machine.has_torsion();
        let follower = Evaluator::new(mechanism, dimensions, jets, Queries::Any, lifted);
        Self { machine, jets, follower }
    }
}

impl ReducedModel for MechanismModel<'_> {
    fn place(&mut self, q: &[f64], _: Numbers<'_>, out: &mut Reduced) -> Result<(), Status> {
        self.follower.solve(q)?;
        // No dyad has more by itself than the whole position.
        if self.follower.total_condition() > GREATEST_CONDITION {
            self.look_around(q)?;
        }
        self.machine.place(&Pose::new(self.follower.position(), self.jets), out);
        Ok(())
    }

    fn load(&mut self, speed: &[f64], numbers: Numbers<'_>, out: &mut Reduced) {
        let pose = Pose::new(self.follower.position(), self.jets);
        self.machine.load(&pose, speed, numbers, out);
    }

    fn angle(&mut self, q: &[f64], angle: &Angle) -> f64 {
        match self.follower.solve(q) {
            Ok(()) => angle.at(&Pose::new(self.follower.position(), self.jets)),
            Err(_) => f64::NAN,
        }
    }

    fn unit(&self, driver: usize) -> f64 {
        self.follower.unit(driver)
    }

    fn has_dead_points(&self) -> bool {
        true
    }

    fn fold(&mut self, q: f64, way: f64) -> Option<f64> {
        self.follower.solve(&[q]).ok()?;
        let (mut there, mut beyond) = (q, q + way.signum() * self.reach(0, f64::INFINITY));
        if self.follower.solve(&[beyond]).is_ok() {
            return None;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (there + beyond);
            if middle == there || middle == beyond {
                break;
            }
            let is_there = self.follower.solve(&[middle]).is_ok();
            *(if is_there { &mut there } else { &mut beyond }) = middle;
        }
        Some(there)
    }

    fn near_miss(&mut self, q: f64) -> Option<NearMiss> {
        self.follower.near_miss(q)
    }

    fn is_beside_fold(&mut self, q: &[f64], within: f64) -> bool {
        self.follower.solve(q).is_err() || self.folds_near(q, within)
    }

    fn noise(&self) -> f64 {
        let condition = self.follower.total_condition();
        ANALOGUE_PER_CONDITION_SQUARED * condition * condition
    }

    fn flatness(&mut self, q: &[f64]) -> f64 {
        match self.follower.solve(q) {
            Ok(()) => 1.0 / self.follower.worst_condition().1,
            Err(_) => f64::NAN,
        }
    }
}

/// A machine given by tables of its reduced inertia and moment over the driver's coordinate.
#[derive(Debug, Clone, PartialEq)]
pub struct TabulatedMachine {
    /// Inertia and moment first, then those of motors.
    pub tables: Vec<Table>,
    /// Its motors.
    pub motors: Vec<Motor>,
}

impl TabulatedMachine {
    /// Refers to the driver at coordinates; nothing is beyond tables that are not periodic.
    #[must_use]
    pub fn reduce(&self, q: &[f64]) -> ReducedTable {
        let mut rows = ReducedTable::default();
        for &q in q {
            let [inertia, moment] = [0, 1].map(|which| {
                let table = self.tables.get(which);
                table.and_then(|table| table.value_and_slope(q)).unwrap_or([f64::NAN; 2])
            });
            rows.inertia.push(inertia[0] + self.motors.iter().map(Motor::inertia).sum::<f64>());
            rows.rates.push(inertia[1]);
            rows.moment.push(moment[0]);
            let is_there = inertia[0].is_finite() && moment[0].is_finite();
            rows.potential.push(if is_there { 0.0 } else { f64::NAN });
            rows.status.push(if is_there { Status::Ok } else { Status::Unreachable });
        }
        rows
    }
}

impl ReducedModel for &TabulatedMachine {
    fn place(&mut self, _: &[f64], numbers: Numbers<'_>, out: &mut Reduced) -> Result<(), Status> {
        let [inertia, rate] = numbers.tables[0];
        out.inertia[0] = inertia + self.motors.iter().map(Motor::inertia).sum::<f64>();
        out.rates[0] = rate;
        Ok(())
    }

    fn load(&mut self, _: &[f64], numbers: Numbers<'_>, out: &mut Reduced) {
        out.applied[0] = numbers.tables[1][0];
    }

    fn angle(&mut self, _: &[f64], _: &Angle) -> f64 {
        f64::NAN
    }

    fn unit(&self, _: usize) -> f64 {
        1.0
    }

    fn has_dead_points(&self) -> bool {
        false
    }

    fn fold(&mut self, _: f64, _: f64) -> Option<f64> {
        None
    }

    fn near_miss(&mut self, _: f64) -> Option<NearMiss> {
        None
    }

    fn is_beside_fold(&mut self, _: &[f64], _: f64) -> bool {
        false
    }

    fn noise(&self) -> f64 {
        0.0
    }

    fn flatness(&mut self, _: &[f64]) -> f64 {
        1.0
    }
}
