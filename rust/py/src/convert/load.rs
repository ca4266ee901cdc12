//! Loads of machines.
#![allow(clippy::struct_field_names, reason = "the names of the classes and of their fields")]

use assur::Mechanism;
use assur::dynamics::Load;
use pyo3::prelude::*;

use super::Classes;
use super::point::{PointLike, link};
use super::value::Values;

const MODULE: Classes = Classes("assur.dynamics.loads");

#[derive(FromPyObject)]
struct Gravity {
    acceleration: [f64; 2],
}

#[derive(FromPyObject)]
struct Force<'py> {
    at: PointLike,
    force: [Bound<'py, PyAny>; 2],
    axes: Option<String>,
    on: Option<String>,
}

#[derive(FromPyObject)]
struct Torque<'py> {
    link: String,
    torque: Bound<'py, PyAny>,
    on: String,
}

#[derive(FromPyObject)]
struct Spring {
    first: PointLike,
    second: PointLike,
    stiffness: f64,
    length: f64,
    preload: f64,
}

#[derive(FromPyObject)]
struct TorsionSpring {
    link: String,
    stiffness: f64,
    angle: f64,
    on: String,
    preload: f64,
}

#[derive(FromPyObject)]
struct Damper {
    first: PointLike,
    second: PointLike,
    damping: f64,
}

#[derive(FromPyObject)]
struct TorsionDamper {
    link: String,
    damping: f64,
    on: String,
}

/// The loads besides gravity, and the sum of the gravitational accelerations.
pub(crate) fn loads(
    mechanism: &Mechanism,
    objects: &[Bound<'_, PyAny>],
    values: &mut Values,
) -> PyResult<(Vec<Load>, [f64; 2])> {
    let (mut loads, mut gravity) = (Vec::new(), [0.0; 2]);
    for object in objects {
        if MODULE.is(object, "Gravity")? {
            let Gravity { acceleration: [x, y] } = object.extract()?;
            gravity = [gravity[0] + x, gravity[1] + y];
        } else {
            loads.push(load(mechanism, object, values)?);
        }
    }
    Ok((loads, gravity))
}

fn load(mechanism: &Mechanism, object: &Bound<'_, PyAny>, values: &mut Values) -> PyResult<Load> {
    let is = |class| MODULE.is(object, class);
    let link = |name: &str| link(mechanism, name);
    let ends = |first: &PointLike, second: &PointLike| {
        Ok::<_, PyErr>([first.resolve(mechanism)?, second.resolve(mechanism)?])
    };
    if is("Force")? {
        let Force { at, force: [x, y], axes, on } = object.extract()?;
        let force = [values.read(&x)?, values.read(&y)?];
        let axes = axes.as_deref().map(link).transpose()?;
        let on = on.as_deref().map(link).transpose()?;
        Ok(Load::Force { at: at.resolve(mechanism)?, force, axes, on })
    } else if is("Torque")? {
        let Torque { link: name, torque, on } = object.extract()?;
        let torque = values.read(&torque)?;
        Ok(Load::Torque { link: link(&name)?, on: link(&on)?, torque })
    } else if is("Spring")? {
        let Spring { first, second, stiffness, length, preload } = object.extract()?;
        Ok(Load::Spring { ends: ends(&first, &second)?, stiffness, length, preload })
    } else if is("TorsionSpring")? {
        let TorsionSpring { link: name, stiffness, angle, on, preload } = object.extract()?;
        Ok(Load::TorsionSpring { link: link(&name)?, on: link(&on)?, stiffness, angle, preload })
    } else if is("Damper")? {
        let Damper { first, second, damping } = object.extract()?;
        Ok(Load::Damper { ends: ends(&first, &second)?, damping })
    } else if is("TorsionDamper")? {
        let TorsionDamper { link: name, damping, on } = object.extract()?;
        Ok(Load::TorsionDamper { link: link(&name)?, on: link(&on)?, damping })
    } else {
        Err(MODULE.unknown(object))
    }
}
