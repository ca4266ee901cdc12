//! Sources of reduced inertia and loads: a mechanism, or tables.

use std::convert::Infallible;

use crate::dynamics::angle_between::Angle;
use crate::dynamics::followers::{Followers, Held};
use crate::dynamics::friction::motion::{Drive, FrictionMotion, SlidingState};
use crate::dynamics::friction::reversals::{Sliding, reversals};
use crate::dynamics::kinematics::SolvedPose;
use crate::dynamics::machine::Machine;
use crate::dynamics::measure::Over;
use crate::dynamics::reduced::Reduced;
use crate::dynamics::tables::table::Table;
use crate::dynamics::value::Numbers;
use crate::math::derivatives::DerivativeTables;
use crate::math::root::bisection::bisect;
use crate::math::tolerance::{ANALOGUE_PER_CONDITION_SQUARED, NEAR_SINGULAR_CONDITION};
use crate::plan::mechanism::Mechanism;
use crate::query::evaluator::{Evaluator, NearMiss, Queries};
use crate::query::failure::Failure;
use crate::state::status::Rejection;

/// A machine referred to its drivers, at one position after another.
pub(crate) trait ReducedModel {
    /// Reduces inertia, weights and springs at coordinates.
    ///
    /// # Errors
    ///
    /// How a position that cannot be used failed.
    fn set_configuration(
        &mut self,
        q: &[f64],
        numbers: Numbers<'_>,
        out: &mut Reduced,
    ) -> Result<(), Rejection>;

    /// Names what failed at coordinates that were rejected.
    fn failure(&self, rejection: Rejection, q: &[f64]) -> Option<Failure>;

    /// Name of the link or slide that is a driver.
    fn driver_name(&self, driver: usize) -> Option<String>;

    /// Whether pairs have friction.
    fn has_friction(&self) -> bool {
        false
    }

    /// The acceleration of the only driver under friction, at the last position; `None` where the law of
    /// friction has no solution.
    fn acceleration_with_friction(
        &mut self,
        _: SlidingState,
        _: Drive,
        _: Numbers<'_>,
    ) -> Option<f64> {
        None
    }

    /// Whether loads of a machine with one driver follow other coordinates, or pairs with friction
    /// reverse: then the motion is smooth between stations.
    fn has_stations(&self) -> bool {
        false
    }

    /// Stops treating reversals of pairs with friction as stations: they would be too many, or too inexact.
    fn ignore_reversals(&mut self) {}

    /// Whether loads depend on the sense of the motion.
    fn has_ways(&self) -> bool {
        false
    }

    /// The coordinates in a range between which friction and loads that follow other coordinates are smooth.
    fn stations(&mut self, _: [f64; 2]) -> Vec<f64> {
        Vec::new()
    }

    /// Fixes pieces, directions and senses at a coordinate until the next station. Returns whether the
    /// coordinate is reachable.
    ///
    /// # Errors
    ///
    /// Index of the curve whose table does not cover the position, and the missing value.
    fn hold(&mut self, _: f64) -> Result<bool, (usize, f64)> {
        Ok(true)
    }

    /// Whether loads have tables over other coordinates.
    fn has_tables_over(&self) -> bool {
        false
    }

    /// The table of a curve over another coordinate.
    fn table_over(&self, _: usize) -> Option<&Table> {
        None
    }

    /// Reduces the other loads at the last position (`q`), these speeds and this sense of the motion.
    fn apply_loads(
        &mut self,
        q: &[f64],
        speed: &[f64],
        sense: f64,
        numbers: Numbers<'_>,
        out: &mut Reduced,
    );

    /// An angle at coordinates; NaN if they cannot be reached.
    fn angle(&mut self, q: &[f64], angle: &Angle) -> f64;

    /// Unit of a driver's coordinate: the mechanism's size for a slide, 1 for an angle.
    fn unit(&self, driver: usize) -> f64;

    /// Whether dead points are possible.
    fn has_dead_points(&self) -> bool;

    /// The coordinate of the dead point ahead of a single driver, if it is near.
    fn dead_point_ahead(&mut self, q: f64, direction: f64) -> Option<f64>;

    /// The near miss of a change point beside a single driver's coordinate, if any.
    fn near_miss(&mut self, q: f64) -> Option<NearMiss>;

    /// Whether a dead point is within this part of a radian (or of the size).
    fn is_near_dead_point(&mut self, q: &[f64], within: f64) -> bool;

    /// How the next position is rejected, if a dead point is about as near as the condition shows.
    fn dead_point_beside(&mut self, q: &[f64]) -> Option<Rejection>;

    /// Relative rounding error of the inertia at the last position.
    fn inertia_noise(&self) -> f64;

    /// Distance from a singular position, as the inverse of the condition; NaN if the coordinates
    /// cannot be reached.
    fn inverse_condition(&mut self, q: &[f64]) -> f64;
}

/// A machine on its mechanism.
pub(crate) struct MechanismModel<'m> {
    machine: &'m Machine,
    derivatives: &'m DerivativeTables,
    evaluator: Evaluator<'m>,
    held: Held,
    followers: Followers,
    friction: Option<FrictionMotion<'m>>,
    /// The pairs with friction.
    sliding: Vec<Sliding>,
    /// Those whose reversals are stations.
    reversing: Vec<Sliding>,
}

/// Beyond this condition of a dyad or group the analogues have too few digits to be integrated:
/// about eight (64 u κ²). At a distance x from a dead point the condition is about 1/√x, so this
/// is some 1e-7 before it.
pub(crate) const MAX_CONDITION: f64 = 3.0e3;
/// A dead point is within this multiple of 1/κ².
const DEAD_POINT_WITHIN: f64 = 1.0e3;
/// Limit of bisections for a dead point.
const MAX_HALVINGS: u32 = 80;

impl<'m> MechanismModel<'m> {
    /// Greatest distance of a dead point from here, in the coordinate's unit; at most `most` times that unit.
    fn reach(&self, driver: usize, most: f64) -> f64 {
        let (_, condition) = self.evaluator.worst_condition();
        (DEAD_POINT_WITHIN / (condition * condition)).min(most) * self.evaluator.unit(driver)
    }

    /// Whether a dead point is near the last position.
    fn has_dead_point_near(&mut self, q: &[f64], most: f64) -> bool {
        let reaches: Vec<f64> = (0..q.len()).map(|driver| self.reach(driver, most)).collect();
        let mut beside = q.to_vec();
        for (driver, reach) in reaches.into_iter().enumerate() {
            for offset in [-reach, reach] {
                beside[driver] = q[driver] + offset;
                if self.evaluator.probe(&beside).is_err() {
                    return true;
                }
                beside[driver] = q[driver];
            }
        }
        false
    }

    /// Rejects a position beside a dead point or a near miss of a change point.
    #[cold]
    #[inline(never)]
    fn check_singularity(&mut self, q: &[f64]) -> Result<(), Rejection> {
        let (step, condition) = self.evaluator.worst_condition();
        if condition > MAX_CONDITION {
            if self.has_dead_point_near(q, f64::INFINITY) {
                return Err(Rejection::DeadPoint { step });
            }
            if let Some(step) = self.evaluator.zero_length(q, step, condition) {
                return Err(Rejection::ZeroLength { step });
            }
            if let (1, Some(step), true) = (q.len(), step, condition > NEAR_SINGULAR_CONDITION) {
                return Err(Rejection::NearMiss { step });
            }
            self.evaluator.solve(q)?;
        }
        Ok(())
    }

    pub(crate) fn new(
        machine: &'m Machine,
        mechanism: &'m Mechanism,
        dimensions: &[f64],
        derivatives: &'m DerivativeTables,
    ) -> Self {
        let lifted = machine.needs_angles();
        let evaluator = Evaluator::new(mechanism, dimensions, derivatives, Queries::Any, lifted);
        let has_friction = !machine.friction.is_empty() && mechanism.q0().len() == 1;
        let unit = evaluator.unit_of_length();
        let friction =
            has_friction.then(|| FrictionMotion::new(machine, mechanism, dimensions, unit));
        let sliding = if has_friction { Sliding::of(machine, mechanism) } else { Vec::new() };
        let (held, followers) = (Held::default(), Followers::default());
        let reversing = sliding.clone();
        Self { machine, derivatives, evaluator, held, followers, friction, sliding, reversing }
    }

    pub(crate) fn machine(&self) -> &'m Machine {
        self.machine
    }

    pub(crate) fn derivatives(&self) -> &'m DerivativeTables {
        self.derivatives
    }

    pub(crate) fn evaluator(&self) -> &Evaluator<'m> {
        &self.evaluator
    }

    /// Forgets the motion before, on which the next one must not depend.
    pub(crate) fn restart(&mut self) {
        self.evaluator.restart();
        self.held = Held::default();
        self.followers = Followers::default();
        if let Some(friction) = &mut self.friction {
            friction.release();
        }
        self.reversing.clone_from(&self.sliding);
    }
}

impl ReducedModel for MechanismModel<'_> {
    fn set_configuration(
        &mut self,
        q: &[f64],
        _: Numbers<'_>,
        out: &mut Reduced,
    ) -> Result<(), Rejection> {
        self.evaluator.solve(q)?;
        // The product bounds the condition of each dyad.
        if self.evaluator.total_condition() > MAX_CONDITION {
            self.check_singularity(q)?;
        }
        self.machine
            .add_configuration(&SolvedPose::new(self.evaluator.position(), self.derivatives), out);
        Ok(())
    }

    fn has_friction(&self) -> bool {
        self.friction.is_some()
    }

    fn acceleration_with_friction(
        &mut self,
        state: SlidingState,
        drive: Drive,
        numbers: Numbers<'_>,
    ) -> Option<f64> {
        let pose = SolvedPose::new(self.evaluator.position(), self.derivatives);
        let friction = self.friction.as_mut()?;
        // As at the last call of `apply_loads`.
        let numbers = Numbers {
            tables: numbers.tables,
            external: numbers.external,
            ..self.followers.numbers()
        };
        friction.acceleration(&pose, state, drive, numbers)
    }

    fn failure(&self, rejection: Rejection, q: &[f64]) -> Option<Failure> {
        Some(self.evaluator.failure(rejection, q))
    }

    fn driver_name(&self, driver: usize) -> Option<String> {
        Some(self.evaluator.driver_name(driver))
    }

    fn has_stations(&self) -> bool {
        let has_own = self.machine.has_stations() && self.derivatives.drivers == 1;
        has_own || !self.reversing.is_empty()
    }

    fn ignore_reversals(&mut self) {
        self.reversing.clear();
    }

    fn has_ways(&self) -> bool {
        !self.machine.ways.is_empty() && self.derivatives.drivers == 1
    }

    fn stations(&mut self, range: [f64; 2]) -> Vec<f64> {
        if !self.has_stations() {
            return Vec::new();
        }
        let Self { machine, derivatives, evaluator, reversing, .. } = self;
        let mut stations = machine.stations_of(evaluator, derivatives, range);
        if !reversing.is_empty() {
            stations.extend(reversals(reversing, evaluator, derivatives, range));
            stations.sort_unstable_by(f64::total_cmp);
        }
        stations
    }

    fn hold(&mut self, q: f64) -> Result<bool, (usize, f64)> {
        if self.evaluator.solve(&[q]).is_err() {
            return Ok(false);
        }
        let pose = SolvedPose::new(self.evaluator.position(), self.derivatives);
        self.held.hold(self.machine.followed(), &pose, &[q])?;
        if let Some(friction) = self.friction.as_mut().filter(|_| !self.reversing.is_empty()) {
            friction.hold(&pose);
        }
        Ok(true)
    }

    fn has_tables_over(&self) -> bool {
        self.machine.over.iter().any(|over| over.table().is_some())
    }

    fn table_over(&self, index: usize) -> Option<&Table> {
        self.machine.over.get(index).and_then(Over::table)
    }

    fn apply_loads(
        &mut self,
        q: &[f64],
        speed: &[f64],
        sense: f64,
        numbers: Numbers<'_>,
        out: &mut Reduced,
    ) {
        let pose = SolvedPose::new(self.evaluator.position(), self.derivatives);
        if !self.machine.follows() {
            self.machine.add_speed_loads(&pose, speed, numbers, out);
            return;
        }
        if let &[_] = q {
            self.followers.read_held(self.machine.followed(), &pose, q, (&self.held, sense));
        } else {
            self.followers.read(self.machine.followed(), &pose, q, speed);
        }
        let numbers = Numbers {
            tables: numbers.tables,
            external: numbers.external,
            ..self.followers.numbers()
        };
        self.machine.add_speed_loads(&pose, speed, numbers, out);
    }

    fn angle(&mut self, q: &[f64], angle: &Angle) -> f64 {
        match self.evaluator.solve(q) {
            Ok(()) => angle.at(&SolvedPose::new(self.evaluator.position(), self.derivatives)),
            Err(_) => f64::NAN,
        }
    }

    fn unit(&self, driver: usize) -> f64 {
        self.evaluator.unit(driver)
    }

    fn has_dead_points(&self) -> bool {
        true
    }

    fn dead_point_ahead(&mut self, q: f64, direction: f64) -> Option<f64> {
        self.evaluator.solve(&[q]).ok()?;
        let beyond = q + direction.signum() * self.reach(0, f64::INFINITY);
        if self.evaluator.solve(&[beyond]).is_ok() {
            return None;
        }
        let is_reachable = |q: f64| Ok::<_, Infallible>(self.evaluator.solve(&[q]).is_ok());
        let Ok([reachable, _]) = bisect([q, beyond], MAX_HALVINGS, is_reachable);
        Some(reachable)
    }

    fn near_miss(&mut self, q: f64) -> Option<NearMiss> {
        self.evaluator.near_miss(q)
    }

    fn is_near_dead_point(&mut self, q: &[f64], within: f64) -> bool {
        self.evaluator.solve(q).is_err() || self.has_dead_point_near(q, within)
    }

    fn dead_point_beside(&mut self, q: &[f64]) -> Option<Rejection> {
        self.evaluator.solve(q).ok()?;
        let (step, _) = self.evaluator.worst_condition();
        self.has_dead_point_near(q, f64::INFINITY).then_some(Rejection::DeadPoint { step })
    }

    fn inertia_noise(&self) -> f64 {
        inertia_noise(self.evaluator.total_condition())
    }

    fn inverse_condition(&mut self, q: &[f64]) -> f64 {
        match self.evaluator.solve(q) {
            Ok(()) => 1.0 / self.evaluator.worst_condition().1,
            Err(_) => f64::NAN,
        }
    }
}

/// Relative rounding error of the inertia at a position of this condition.
pub(crate) fn inertia_noise(condition: f64) -> f64 {
    ANALOGUE_PER_CONDITION_SQUARED * condition * condition
}
