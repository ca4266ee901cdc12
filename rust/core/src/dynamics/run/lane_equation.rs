//! The equation of motion of a machine with one driver in each lane of a register, each with the bits of
//! [`Equation`](super::equation::Equation).

use super::model::{MAX_CONDITION, MechanismModel};
use crate::dynamics::kinematics::SolvedPose;
use crate::dynamics::machine::Machine;
use crate::dynamics::motor::Motor;
use crate::dynamics::reduced::BodyTerms;
use crate::dynamics::tables::table::Cell;
use crate::dynamics::value::Numbers;
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::{Mask, Real};
use crate::math::vector::Vector;
use crate::ode::side_by_side::{LaneRates, LaneState};
use crate::query::lane_evaluator::LaneEvaluator;
use crate::state::kernel::Level;

/// A machine whose only load is its weight, with motors that read only their speed.
pub(crate) struct LaneEquation<'d, 'm, L: Level> {
    machine: &'m Machine,
    derivatives: &'m DerivativeTables,
    evaluator: LaneEvaluator<'d, 'm, L::Register>,
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
        Some(Self { machine, derivatives, evaluator })
    }
}

impl<R: Real, L: Level<Register = R>> LaneRates<R> for LaneEquation<'_, '_, L> {
    /// The rates of coordinate, speed and work.
    #[inline(always)]
    fn rates(&mut self, &[q, speed, _]: &LaneState<R>, rates: &mut LaneState<R>) -> R::Mask {
        let is_solved = self.evaluator.solve::<L>(q, MAX_CONDITION);
        let pose = SolvedPose::new(self.evaluator.position(), self.derivatives);
        let gravity = Vector::new(self.machine.gravity[0], self.machine.gravity[1]);
        let (mut inertia, mut d_inertia, mut conservative) = (R::ZERO, R::ZERO, R::ZERO);
        let mut drive = R::ZERO;
        for motor in &self.machine.motors {
            inertia += R::splat(motor.inertia());
            drive += R::from_lanes(|lane| {
                motor.moment(speed.lane(lane), Cell::default(), Numbers::default())[0]
            });
        }
        for body in &self.machine.bodies {
            let terms = BodyTerms::of(&pose, body, gravity);
            inertia += terms.inertia;
            d_inertia += terms.d_inertia;
            conservative += terms.conservative;
        }
        // Without other loads and without friction these terms are zero, which may have either sign.
        let (applied, friction) = (R::ZERO, R::ZERO);
        let moment = conservative + applied + drive + friction;
        let centrifugal = R::splat(0.5) * d_inertia * speed * speed;
        let power = R::splat(NO_POWER) + (applied + drive) * speed + friction * speed;
        *rates = [speed, (moment - centrifugal) / inertia, power];
        is_solved.and(R::ZERO.lt(inertia))
    }
}

/// Where a sum of floating-point numbers begins.
const NO_POWER: f64 = -0.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sum_begins_there() {
        let empty: f64 = std::iter::empty::<f64>().sum();
        assert_eq!(empty.to_bits(), NO_POWER.to_bits());
    }
}
