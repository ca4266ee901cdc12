//! What all chunks of the equations of motion share.

use super::request::EquationRequest;
use crate::dynamics::kinetostatics::positions::MachineBatch;
use crate::dynamics::reactions::applied::Values;
use crate::dynamics::value::Numbers;

/// The data that all chunks of a batch share.
pub(super) struct EquationBatch<'b> {
    pub positions: MachineBatch<'b>,
    pub request: &'b EquationRequest<'b>,
    /// Inertia of the rotors, driver by driver.
    pub rotors: &'b [f64],
}

impl EquationBatch<'_> {
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
        for row in 0..count {
            tables.clear();
            tables.extend(values.tables.iter().map(|table| [table[row], 0.0]));
            external.clear();
            let first = row * values.callbacks;
            let numbers = &values.external[first..first + values.callbacks];
            external.extend(numbers.iter().map(|&number| [number, 0.0]));
            let numbers = Numbers { tables: &tables, external: &external, ..Numbers::default() };
            efforts.extend((0..n).map(|driver| row_of(effort, row, driver)));
            for motor in &self.positions.machine.motors {
                let driver_speed = row_of(speed, row, motor.driver);
                efforts[row * n + motor.driver] += motor.torque_at(driver_speed, numbers);
            }
        }
    }
}
