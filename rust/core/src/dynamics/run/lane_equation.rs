//! The equation of motion of a machine with one driver in each lane of a register, each with the bits of
//! [`Equation`](super::equation::Equation).

use super::model::{MAX_CONDITION, MechanismModel, ReducedModel};
use crate::dynamics::kinematics::SolvedPose;
use crate::dynamics::machine::Machine;
use crate::dynamics::motor::Motor;
use crate::dynamics::reduced::BodyTerms;
use crate::dynamics::tables::table::Cell;
use crate::dynamics::value::Numbers;
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::{Mask, Real};
use crate::math::tolerance::ANALOGUE_PER_CONDITION_SQUARED;
use crate::math::vector::Vector;
use crate::ode::lane_step::LaneState;
use crate::ode::side_by_side::LaneRates;
use crate::query::lane_evaluator::LaneEvaluator;
use crate::state::kernel::Level;

/// Largest change of the energy over a step, in tolerances: its error is only estimated.
pub(super) const MAX_DRIFT: f64 = 3.0;
/// Multiples of the energies' rounding that do not count as a change.
pub(super) const ROUNDINGS: f64 = 64.0;

/// A machine whose only load is its weight, with motors that read only their speed.
pub(crate) struct LaneEquation<'d, 'm, L: Level> {
    machine: &'m Machine,
    derivatives: &'m DerivativeTables,
    evaluator: LaneEvaluator<'d, 'm, L::Register>,
    /// Unit of the coordinate.
    unit: f64,
    /// At the end of the step whose stages were found last.
    end: Configuration<L::Register>,
}

/// Inertia and weights at coordinates, and the condition of the position.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Configuration<R = f64> {
    pub inertia: R,
    pub d_inertia: R,
    pub conservative: R,
    pub potential: R,
    pub condition: R,
}

impl<R: Real> Configuration<R> {
    /// Kinetic and potential energy less work at a speed, and the tolerance of that sum. `relative`: that of
    /// the speed; `unit`: that of the coordinate.
    #[inline(always)]
    pub(super) fn balance(&self, [speed, work]: [R; 2], [relative, unit]: [R; 2]) -> [R; 2] {
        let Self { inertia, d_inertia, conservative, potential, condition } = *self;
        let half = R::splat(0.5);
        let kinetic = half * (speed * (inertia * speed));
        // Speeds are accurate to the relative tolerance, coordinates to that part of their unit.
        let change = half * d_inertia * speed * speed - conservative;
        let by_coordinate = change.abs() * unit;
        let size = kinetic.abs() + potential.abs() + work.abs();
        let noise = R::splat(ANALOGUE_PER_CONDITION_SQUARED) * condition * condition;
        let allowed = R::splat(MAX_DRIFT) * relative * (R::splat(2.0) * kinetic + by_coordinate)
            + R::splat(ROUNDINGS * f64::EPSILON) * size
            + noise * kinetic;
        [kinetic + potential - work, allowed]
    }
}

impl<'d, 'm, L: Level> LaneEquation<'d, 'm, L> {
    /// `None` for other machines, and for designs whose positions are not found in lanes.
    pub(crate) fn new(model: &'d MechanismModel<'m>) -> Option<Self> {
        let (machine, derivatives) = (model.machine(), model.derivatives());
        let is_simple = machine.loads.is_empty()
            && machine.friction.is_empty()
            && machine.tables.is_empty()
            && !machine.follows()
            && machine.motors.iter().all(Motor::reads_its_speed_only);
        let evaluator = LaneEvaluator::new(model.evaluator()).filter(|_| is_simple)?;
        let (unit, end) = (model.unit(0), Configuration::default());
        Some(Self { machine, derivatives, evaluator, unit, end })
    }

    /// The configuration at the end of the step whose stages were found last.
    pub(crate) fn end(&self, lane: usize) -> Configuration {
        let Configuration { inertia, d_inertia, conservative, potential, condition } = self.end;
        Configuration {
            inertia: inertia.lane(lane),
            d_inertia: d_inertia.lane(lane),
            conservative: conservative.lane(lane),
            potential: potential.lane(lane),
            condition: condition.lane(lane),
        }
    }
}

impl<R: Real, L: Level<Register = R>> LaneEquation<'_, '_, L> {
    /// The configuration at a coordinate in every lane, and the lanes in which it is known.
    #[inline(always)]
    fn configuration(&mut self, q: R) -> (R::Mask, Configuration<R>) {
        let (is_solved, condition) = self.evaluator.solve::<L>(q, MAX_CONDITION);
        let pose = SolvedPose::new(self.evaluator.position(), self.derivatives);
        let gravity = Vector::new(self.machine.gravity[0], self.machine.gravity[1]);
        let mut found = Configuration {
            inertia: R::ZERO,
            d_inertia: R::ZERO,
            conservative: R::ZERO,
            potential: R::ZERO,
            condition,
        };
        for motor in &self.machine.motors {
            found.inertia += R::splat(motor.inertia());
        }
        for body in &self.machine.bodies {
            let terms = BodyTerms::of(&pose, body, gravity);
            found.inertia += terms.inertia;
            found.d_inertia += terms.d_inertia;
            found.conservative += terms.conservative;
            found.potential += terms.potential;
        }
        (is_solved, found)
    }

    /// The energy balance at the end of the steps whose stages were found last; see
    /// [`Configuration::balance`].
    #[inline(always)]
    pub(crate) fn balance(&self, &[_, speed, work]: &LaneState<R>, relative: R) -> [R; 2] {
        self.end.balance([speed, work], [relative, R::splat(self.unit)])
    }

    /// Kinetic and potential energy at coordinates and speeds; NaN where they are not known.
    #[inline(always)]
    pub(crate) fn energies(&mut self, q: &[f64], speed: &[f64], energies: &mut [[f64; 2]]) {
        for (part, out) in energies.chunks_mut(R::LANES).enumerate() {
            let first = part * R::LANES;
            let last = first + out.len() - 1;
            let at = R::from_lanes(|lane| q[(first + lane).min(last)]);
            let speed = R::from_lanes(|lane| speed[(first + lane).min(last)]);
            let (is_known, found) = self.configuration(at);
            let kinetic = R::splat(0.5) * (speed * (found.inertia * speed));
            for (lane, pair) in out.iter_mut().enumerate() {
                let numbers = [kinetic.lane(lane), found.potential.lane(lane)];
                *pair = if is_known.lane(lane) { numbers } else { [f64::NAN; 2] };
            }
        }
    }
}

impl<R: Real, L: Level<Register = R>> LaneRates<R> for LaneEquation<'_, '_, L> {
    /// The rates of coordinate, speed and work.
    #[inline(always)]
    fn rates(
        &mut self,
        &[q, speed, _]: &LaneState<R>,
        is_end: bool,
        rates: &mut LaneState<R>,
    ) -> R::Mask {
        let (is_solved, found) = self.configuration(q);
        let mut drive = R::ZERO;
        for motor in &self.machine.motors {
            drive += R::from_lanes(|lane| {
                motor.moment(speed.lane(lane), Cell::default(), Numbers::default())[0]
            });
        }
        // Without other loads and without friction these terms are zero, which may have either sign.
        let (applied, friction) = (R::ZERO, R::ZERO);
        let moment = found.conservative + applied + drive + friction;
        let centrifugal = R::splat(0.5) * found.d_inertia * speed * speed;
        let power = (applied + drive) * speed + friction * speed;
        *rates = [speed, (moment - centrifugal) / found.inertia, power];
        if is_end {
            self.end = found;
        }
        is_solved.and(R::ZERO.lt(found.inertia))
    }
}
