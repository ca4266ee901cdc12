//! Numbers of bodies, loads and motors that differ from machine to machine.

use assur::dynamics::{Machine, MachineNumber, Variation};
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;

use super::word::{Word, Words};
use crate::{error, reserve};

/// What a number belongs to.
#[derive(Clone, Copy)]
enum Part {
    Body,
    Load,
    Motor,
}

impl Words for Part {
    const WHAT: &'static str = "part";
    const KNOWN: &'static [(&'static str, Self)] =
        &[("body", Self::Body), ("load", Self::Load), ("motor", Self::Motor)];
}

/// A number as Python names it: the part, its index among the machine's bodies, loads or motors, its field,
/// its values machine by machine, and what messages call it.
#[derive(FromPyObject)]
pub(crate) struct VariedKey<'py>(Word<Part>, usize, String, PyReadonlyArray1<'py, f64>, String);

/// The numbers of a machine that vary, with their values.
#[derive(Default)]
pub(crate) struct Varied {
    numbers: Vec<(MachineNumber, Vec<f64>)>,
    /// What messages call the first of them.
    first: Option<String>,
}

impl Varied {
    pub(crate) fn new(machine: &Machine, keys: &[VariedKey<'_>]) -> PyResult<Self> {
        let number = |VariedKey(part, index, field, values, name): &VariedKey<'_>| {
            let place = |names: &[&str]| names.iter().position(|name| name == field);
            let index = *index;
            let number = match part.0 {
                Part::Body if field == "mass" => Some(MachineNumber::Mass(index)),
                Part::Body if field == "inertia" => Some(MachineNumber::Inertia(index)),
                Part::Body => None,
                Part::Load => {
                    let load = machine.loads.get(index);
                    load.and_then(|load| place(load.number_names()))
                        .map(|field| MachineNumber::Load(index, field))
                }
                Part::Motor => {
                    let motor = machine.motors.get(index);
                    motor
                        .and_then(|motor| place(motor.number_names()))
                        .map(|field| MachineNumber::Motor(index, field))
                }
            };
            let unknown = || error::input(&format!("{name}: it cannot be an array"), None);
            Ok((number.ok_or_else(unknown)?, reserve::copied(values)?))
        };
        let numbers = keys.iter().map(number).collect::<PyResult<_>>()?;
        Ok(Self { numbers, first: keys.first().map(|key| key.4.clone()) })
    }

    /// For requests to the core.
    pub(crate) fn variations(&self) -> Vec<Variation<'_>> {
        let numbers = self.numbers.iter();
        numbers.map(|(number, values)| Variation { number: *number, values }).collect()
    }

    /// Refuses work that is for machines whose numbers are all single.
    pub(crate) fn refuse(&self) -> PyResult<()> {
        match &self.first {
            None => Ok(()),
            Some(name) => {
                let message = format!(
                    "this takes no arrays, and {name} is one: take one machine with design(i)"
                );
                Err(error::input(&message, None))
            }
        }
    }
}
