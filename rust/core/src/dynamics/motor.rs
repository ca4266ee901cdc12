//! Motors: torque over speed.

use super::tables::table::{Cell, Table};
use super::value::{Numbers, Value};

/// A motor that drives a driver through a gear.
#[derive(Debug, Clone, PartialEq)]
pub struct Motor {
    /// The driver.
    pub driver: usize,
    /// Gear ratio: speed of the motor / speed of the driver.
    pub ratio: f64,
    /// Moment of inertia of the rotor, kg·m².
    pub rotor_inertia: f64,
    /// Torque over speed.
    pub characteristic: Characteristic,
}

/// Torque of a motor, N·m, over its own speed, rad/s.
#[derive(Debug, Clone, PartialEq)]
pub enum Characteristic {
    /// A constant, a table over the driver's coordinate, or a callback.
    Value(Value),
    /// A straight line: a direct-current motor at constant voltage.
    Linear {
        /// Torque at rest.
        stall: f64,
        /// Speed at which the torque is zero.
        no_load: f64,
    },
    /// An induction motor: M. Kloss, Drehmoment und Schlüpfung des Drehstrommotors (1908).
    Induction {
        /// The greatest torque.
        breakdown: f64,
        /// Slip at the greatest torque.
        slip: f64,
        /// Speed of the rotating field.
        synchronous: f64,
    },
    /// A table over the motor's speed.
    Table(Table),
}

impl Motor {
    /// Moment on the driver and its derivative by the driver's speed; a table is read in `cell`.
    #[inline]
    pub(crate) fn moment(&self, speed: f64, cell: Cell, numbers: Numbers<'_>) -> [f64; 2] {
        let motor_speed = self.ratio * speed;
        let [torque, slope] = match &self.characteristic {
            Characteristic::Value(value) => {
                // The value is a function of the driver's speed, not the motor's.
                let slope = value.d_speed(numbers);
                return [self.ratio * value.at(numbers), self.ratio * slope];
            }
            &Characteristic::Linear { stall, no_load } => {
                [stall * (1.0 - motor_speed / no_load), -stall / no_load]
            }
            &Characteristic::Induction { breakdown, slip: breakdown_slip, synchronous } => {
                let slip = 1.0 - motor_speed / synchronous;
                let sum = slip * slip + breakdown_slip * breakdown_slip;
                let d_torque_d_slip = 2.0
                    * breakdown
                    * breakdown_slip
                    * (breakdown_slip * breakdown_slip - slip * slip)
                    / (sum * sum);
                [2.0 * breakdown * breakdown_slip * slip / sum, -d_torque_d_slip / synchronous]
            }
            Characteristic::Table(table) => table.read(cell, motor_speed),
        };
        [self.ratio * torque, self.ratio * self.ratio * slope]
    }

    /// The names of the numbers that a machine of a batch may have for itself. A torque that is a table or a
    /// callback is not one.
    #[must_use]
    pub fn number_names(&self) -> &'static [&'static str] {
        match &self.characteristic {
            Characteristic::Value(_) => &["ratio", "rotor_inertia", "torque"],
            Characteristic::Linear { .. } => &["ratio", "rotor_inertia", "stall", "no_load"],
            Characteristic::Induction { .. } => {
                &["ratio", "rotor_inertia", "breakdown", "slip", "synchronous"]
            }
            Characteristic::Table(_) => &["ratio", "rotor_inertia"],
        }
    }

    /// The number of an index among [these](Self::number_names), unless it is a table or a function.
    pub(crate) fn number(&mut self, index: usize) -> Option<&mut f64> {
        match (index, &mut self.characteristic) {
            (0, _) => Some(&mut self.ratio),
            (1, _) => Some(&mut self.rotor_inertia),
            (2, Characteristic::Value(Value::Number(torque))) => Some(torque),
            (2, Characteristic::Linear { stall, .. }) => Some(stall),
            (3, Characteristic::Linear { no_load, .. }) => Some(no_load),
            (2, Characteristic::Induction { breakdown, .. }) => Some(breakdown),
            (3, Characteristic::Induction { slip, .. }) => Some(slip),
            (4, Characteristic::Induction { synchronous, .. }) => Some(synchronous),
            _ => None,
        }
    }

    /// Whether its moment is a formula of its speed, or constant.
    pub(crate) fn reads_its_speed_only(&self) -> bool {
        match &self.characteristic {
            Characteristic::Value(value) => matches!(value, Value::Number(_)),
            Characteristic::Linear { .. } | Characteristic::Induction { .. } => true,
            Characteristic::Table(_) => false,
        }
    }

    /// Moment on the driver at its speed; NaN where a table over the motor's speed ends.
    pub(crate) fn torque_at(&self, speed: f64, numbers: Numbers<'_>) -> f64 {
        let cell = match self.table() {
            Some(table) => match table.cell(self.ratio * speed) {
                Some(cell) => cell,
                None => return f64::NAN,
            },
            None => Cell::default(),
        };
        self.moment(speed, cell, numbers)[0]
    }

    /// The same with its rate where the driver's speed has one, and values of tables theirs.
    pub(crate) fn torque_and_slopes(
        &self,
        speed: f64,
        rate: f64,
        numbers: Numbers<'_>,
    ) -> [f64; 2] {
        if let Characteristic::Value(value) = self.characteristic {
            let slope = match value {
                Value::External(_) => 0.0,
                _ => value.with_slope(numbers)[1],
            };
            return [self.torque_at(speed, numbers), self.ratio * slope];
        }
        let cell = match self.table() {
            Some(table) => table.cell(self.ratio * speed),
            None => Some(Cell::default()),
        };
        let Some(cell) = cell else { return [f64::NAN; 2] };
        let [torque, slope] = self.moment(speed, cell, numbers);
        [torque, if rate == 0.0 { 0.0 } else { slope * rate }]
    }

    /// The rotor's inertia referred to the driver.
    #[must_use]
    pub fn inertia(&self) -> f64 {
        self.ratio * self.ratio * self.rotor_inertia
    }

    /// The table over the motor's speed, if the characteristic is one.
    pub(crate) fn table(&self) -> Option<&Table> {
        match &self.characteristic {
            Characteristic::Table(table) => Some(table),
            _ => None,
        }
    }

    /// The driver's speed at which the torque is zero (a table: at which it ends); `None` for a
    /// [`Characteristic::Value`].
    #[must_use]
    pub fn idle_speed(&self) -> Option<f64> {
        let motor_speed = match &self.characteristic {
            Characteristic::Value(_) => return None,
            Characteristic::Linear { no_load, .. } => *no_load,
            Characteristic::Induction { synchronous, .. } => *synchronous,
            Characteristic::Table(table) => table.range()[1],
        };
        Some(motor_speed / self.ratio)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::tables::spline::EndCondition;

    fn motor(characteristic: Characteristic) -> Motor {
        Motor { driver: 0, ratio: 4.0, rotor_inertia: 0.5, characteristic }
    }

    fn check(motor: &Motor, points: &[(f64, f64)]) {
        let cell = |speed: f64| {
            motor.table().and_then(|table| table.cell(motor.ratio * speed)).unwrap_or_default()
        };
        let moment = |speed: f64| motor.moment(speed, cell(speed), Numbers::default());
        for &(speed, torque) in points {
            let [actual, slope] = moment(speed);
            assert!((actual - 4.0 * torque).abs() < 1e-12, "{actual} at {speed}");
            let h = 1e-6;
            let difference = (moment(speed + h)[0] - moment(speed - h)[0]) / (2.0 * h);
            assert!((slope - difference).abs() < 1e-7 * (1.0 + slope.abs()), "{slope}");
        }
    }

    #[test]
    fn characteristics() {
        check(&motor(Characteristic::Value(Value::Number(3.0))), &[(0.0, 3.0), (7.0, 3.0)]);
        let linear = motor(Characteristic::Linear { stall: 10.0, no_load: 100.0 });
        check(&linear, &[(0.0, 10.0), (12.5, 5.0), (50.0, -10.0)]);
        assert_eq!(linear.idle_speed(), Some(25.0));
        assert_eq!(linear.inertia(), 8.0);
        let induction =
            motor(Characteristic::Induction { breakdown: 40.0, slip: 0.2, synchronous: 100.0 });
        // Breakdown at slip 0.2, zero torque at slip 0, 2 · 40 / (5 + 1/5) at rest.
        check(&induction, &[(20.0, 40.0), (25.0, 0.0), (0.0, 80.0 / 5.2), (30.0, -40.0)]);
        let table = Table::new(
            &[-10.0, 0.0, 90.0, 110.0],
            &[9.0, 8.0, 6.0, 0.0],
            EndCondition::Linear,
            false,
        );
        let table = motor(Characteristic::Table(table.expect("a table")));
        check(&table, &[(1.0, 8.0 - 8.0 / 90.0), (25.0, 3.0)]);
    }
}
