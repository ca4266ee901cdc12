//! Numbers of bodies, loads and motors that differ from one machine to the next in a batch.

use std::borrow::Cow;

use super::load::Load;
use super::machine::Machine;
use super::motor::Motor;
use crate::description::error::SolveError;

/// A number of a machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MachineNumber {
    /// The mass of a body.
    Mass(usize),
    /// The moment of inertia of a body.
    Inertia(usize),
    /// One of the [numbers](Load::number_names) of a load.
    Load(usize, usize),
    /// One of the [numbers](Motor::number_names) of a motor.
    Motor(usize, usize),
}

/// A number that takes another value in every machine of a batch, in place of that of the machine.
#[derive(Debug, Clone, Copy)]
pub struct Variation<'a> {
    /// Which number.
    pub number: MachineNumber,
    /// Its values, machine by machine; the batch has the same number of rows for each machine.
    pub values: &'a [f64],
}

/// What varies, and its values at some rows.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Varied<'a> {
    pub variations: &'a [Variation<'a>],
    /// Of each variation the value at every row.
    pub rows: &'a [Vec<f64>],
}

impl<'a> Varied<'a> {
    /// The numbers that vary, each with its values at the rows.
    #[inline(always)]
    pub(crate) fn each(self) -> impl Iterator<Item = (MachineNumber, &'a [f64])> {
        self.variations.iter().map(|of| of.number).zip(self.rows.iter().map(Vec::as_slice))
    }

    /// Whether a motor is among what varies.
    pub(crate) fn has_motors(self) -> bool {
        self.variations.iter().any(|of| matches!(of.number, MachineNumber::Motor(..)))
    }

    /// Gives motors their numbers at a row.
    pub(crate) fn set_motors(self, motors: &mut [Motor], row: usize) {
        for (number, values) in self.each() {
            if let MachineNumber::Motor(motor, index) = number
                && let Some(place) = motors.get_mut(motor).and_then(|motor| motor.number(index))
            {
                *place = values[row];
            }
        }
    }
}

impl Variation<'_> {
    /// Writes the values at some rows of a batch of `all` rows.
    pub(crate) fn at_rows(&self, rows: &std::ops::Range<usize>, all: usize, out: &mut Vec<f64>) {
        out.clear();
        let each = all.checked_div(self.values.len()).unwrap_or(1).max(1);
        if each == 1 {
            out.extend_from_slice(&self.values[rows.clone()]);
        } else {
            out.extend(rows.clone().map(|row| self.values[row / each]));
        }
    }
}

/// Refuses variations of other sizes than the batch, and of numbers that the machine does not have. The
/// equations of a machine are compiled without what has no inertia: where values are not zero, its own number
/// must not be zero either.
pub(crate) fn check(
    machine: &Machine,
    variations: &[Variation<'_>],
    rows: usize,
) -> Result<(), SolveError> {
    for Variation { number, values } in variations {
        if rows > 0 && (values.is_empty() || !rows.is_multiple_of(values.len())) {
            return Err(SolveError::Shape("numbers of machines do not fit the positions".into()));
        }
        let own = match *number {
            MachineNumber::Mass(body) => machine.bodies.get(body).map(|body| body.mass),
            MachineNumber::Inertia(body) => machine.bodies.get(body).map(|body| body.inertia),
            MachineNumber::Load(load, index) => {
                let load = machine.loads.get(load);
                load.and_then(|load| load.number_names().get(index)).map(|_| 1.0)
            }
            MachineNumber::Motor(motor, index) => {
                let motor = machine.motors.get(motor);
                motor.and_then(|motor| motor.number_names().get(index)).map(|_| 1.0)
            }
        };
        let is_compiled = own.is_some_and(|own| own != 0.0 || values.iter().all(|&v| v == 0.0));
        if !is_compiled {
            return Err(SolveError::Shape("a number that the machine does not have".into()));
        }
    }
    Ok(())
}

impl Machine {
    /// The machine of an index in a batch, with its own numbers.
    #[must_use]
    pub fn of(&self, variations: &[Variation<'_>], index: usize) -> Cow<'_, Self> {
        let mut machine = Cow::Borrowed(self);
        for Variation { number, values } in variations {
            let machine = machine.to_mut();
            let place = match *number {
                MachineNumber::Mass(body) => machine.bodies.get_mut(body).map(|b| &mut b.mass),
                MachineNumber::Inertia(body) => {
                    machine.bodies.get_mut(body).map(|b| &mut b.inertia)
                }
                MachineNumber::Load(load, number) => {
                    machine.loads.get_mut(load).and_then(|load| load.number(number))
                }
                MachineNumber::Motor(motor, number) => {
                    machine.motors.get_mut(motor).and_then(|motor| motor.number(number))
                }
            };
            if let (Some(place), Some(&value)) = (place, values.get(index)) {
                *place = value;
            }
        }
        machine
    }
}

impl Load {
    /// The names of the numbers that a machine of a batch may have for itself. A value that is a table or a
    /// callback is not one.
    #[must_use]
    pub fn number_names(&self) -> &'static [&'static str] {
        match self {
            Self::Force { .. } => &["fx", "fy"],
            Self::Torque { .. } => &["torque"],
            Self::Pressure { .. } => &["pressure", "ambient"],
            Self::Spring { .. } => &["stiffness", "length", "preload"],
            Self::TorsionSpring { .. } => &["stiffness", "angle", "preload"],
            Self::Damper { .. } | Self::TorsionDamper { .. } => &["damping"],
        }
    }

    /// The number of an index among [these](Self::number_names), unless it is a table or a function.
    fn number(&mut self, index: usize) -> Option<&mut f64> {
        match self {
            Self::Force { force, .. } => force.get_mut(index)?.number(),
            Self::Torque { torque, .. } if index == 0 => torque.number(),
            Self::Pressure { pressure, .. } if index == 0 => pressure.number(),
            Self::Pressure { ambient, .. } if index == 1 => Some(ambient),
            Self::Torque { .. } | Self::Pressure { .. } => None,
            Self::Spring { stiffness, length, preload, .. } => {
                [stiffness, length, preload].into_iter().nth(index)
            }
            Self::TorsionSpring { stiffness, angle, preload, .. } => {
                [stiffness, angle, preload].into_iter().nth(index)
            }
            Self::Damper { damping, .. } | Self::TorsionDamper { damping, .. } => {
                (index == 0).then_some(damping)
            }
        }
    }
}
