//! Motors of machines.

use assur::dynamics::{Characteristic, Motor};
use pyo3::prelude::*;

use super::Classes;
use super::value::{self, TableFields, Values};

const MODULE: Classes = Classes("assur.dynamics.loads.motors");

/// The fields of every motor.
#[derive(FromPyObject)]
struct Shaft {
    ratio: f64,
    rotor_inertia: f64,
}

#[derive(FromPyObject)]
struct ConstantTorque<'py> {
    torque: Bound<'py, PyAny>,
}

#[derive(FromPyObject)]
struct LinearMotor {
    stall: f64,
    no_load: f64,
}

#[derive(FromPyObject)]
struct InductionMotor {
    breakdown: f64,
    slip: f64,
    synchronous: f64,
}

/// The motors of drivers, one after another; a driver may have none.
pub(crate) fn motors(
    objects: &[Option<Bound<'_, PyAny>>],
    values: &mut Values<'_>,
) -> PyResult<Vec<Motor>> {
    let mut motors = Vec::new();
    for (driver, object) in objects.iter().enumerate() {
        if let Some(object) = object {
            let Shaft { ratio, rotor_inertia } = object.extract()?;
            let characteristic = characteristic(object, values)?;
            motors.push(Motor { driver, ratio, rotor_inertia, characteristic });
        }
    }
    Ok(motors)
}

fn characteristic(object: &Bound<'_, PyAny>, values: &mut Values<'_>) -> PyResult<Characteristic> {
    if MODULE.is(object, "ConstantTorque")? {
        let ConstantTorque { torque } = object.extract()?;
        Ok(Characteristic::Value(values.read(&torque)?))
    } else if MODULE.is(object, "LinearMotor")? {
        let LinearMotor { stall, no_load } = object.extract()?;
        Ok(Characteristic::Linear { stall, no_load })
    } else if MODULE.is(object, "InductionMotor")? {
        let InductionMotor { breakdown, slip, synchronous } = object.extract()?;
        Ok(Characteristic::Induction { breakdown, slip, synchronous })
    } else if value::MODULE.is(object, "Table")? {
        Ok(Characteristic::Table(object.extract::<TableFields<'_>>()?.over_speed()?))
    } else {
        Err(MODULE.unknown(object))
    }
}
