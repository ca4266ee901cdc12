//! What all chunks of the equations of motion share.

use std::borrow::Cow;

use super::plan::EquationPlan;
use super::request::EquationRequest;
use crate::batch::chunks::most_positions;
use crate::batch::motion::MotionBatch;
use crate::batch::request::{Request, Shape};
use crate::batch::schedule::Control;
use crate::dynamics::kinetostatics::positions::{Driven, MachineBatch};
use crate::dynamics::machine::Machine;
use crate::dynamics::reactions::applied::Values;
use crate::dynamics::value::Numbers;
use crate::plan::mechanism::Mechanism;

/// The data that all chunks of a batch share.
pub(super) struct EquationBatch<'b> {
    pub positions: MachineBatch<'b>,
    pub request: &'b EquationRequest<'b>,
    /// Whether the motors' rotors count in the mass matrix.
    pub has_rotors: bool,
}

impl<'b> EquationBatch<'b> {
    /// The batch of a request, with the kinematics that it needs. The drivers' accelerations are `rest`, zero:
    /// the bias is what the drivers give without them.
    pub(super) fn new(
        (mechanism, machine, plan): (&'b Mechanism, &'b Machine, &'b EquationPlan),
        (kinematics, shape): (&'b Request<'b>, &'b Shape),
        request: &'b EquationRequest<'b>,
        rest: &'b [f64],
        control: &'b Control<'b>,
    ) -> Self {
        let rows = shape.designs * shape.positions;
        Self {
            positions: MachineBatch {
                motion: MotionBatch {
                    mechanism,
                    request: kinematics,
                    derivatives: &plan.derivatives,
                    writer: &plan.writer,
                    shape,
                    most: most_positions(shape.positions),
                    control,
                },
                machine,
                sources: &plan.sources,
                plan: &plan.forces,
                driven: Driven {
                    speed: request.speed,
                    acceleration: rest,
                    external: request.external,
                    sense: request.sense,
                },
                callbacks: request.external.len().checked_div(rows).unwrap_or(0),
                variations: request.variations,
            },
            request,
            has_rotors: true,
        }
    }

    /// The efforts with those of the motors, position by position.
    pub(super) fn add_motors(
        &self,
        values: &Values<'_>,
        speed: &[f64],
        effort: &[f64],
        count: usize,
        efforts: &mut Vec<f64>,
    ) {
        let n = self.positions.plan.drivers;
        efforts.clear();
        let row_of = |all: &[f64], row: usize, driver: usize| {
            if all.len() == n { all[driver] } else { all[row * n + driver] }
        };
        let (mut tables, mut external) = (Vec::new(), Vec::new());
        let mut motors = Cow::Borrowed(self.positions.machine.motors.as_slice());
        for row in 0..count {
            tables.clear();
            tables.extend(values.tables.iter().map(|table| [table[row], 0.0]));
            external.clear();
            let first = row * values.callbacks;
            let numbers = &values.external[first..first + values.callbacks];
            external.extend(numbers.iter().map(|&number| [number, 0.0]));
            let numbers = Numbers { tables: &tables, external: &external, ..Numbers::default() };
            efforts.extend((0..n).map(|driver| row_of(effort, row, driver)));
            if values.varied.has_motors() {
                values.varied.set_motors(motors.to_mut(), row);
            }
            for motor in motors.iter() {
                let driver_speed = row_of(speed, row, motor.driver);
                efforts[row * n + motor.driver] += motor.torque_at(driver_speed, numbers);
            }
        }
    }
}
