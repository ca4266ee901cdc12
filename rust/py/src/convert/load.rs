//! Loads of machines.
#![allow(clippy::struct_field_names, reason = "the names of the classes and of their fields")]

use assur::Mechanism;
use assur::dynamics::{Curve, Gas, Load, Measure, Over};
use pyo3::prelude::*;

use super::Classes;
use super::point::{PointLike, link};
use super::value::Values;
use crate::error_map;

const MODULE: Classes = Classes("assur.dynamics.loads.loads");

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
    while_: Option<String>,
    over: Option<String>,
}

#[derive(FromPyObject)]
struct Pressure<'py> {
    slide: String,
    area: f64,
    pressure: Bound<'py, PyAny>,
    expands: String,
    ambient: f64,
    while_: Option<String>,
    over: Option<String>,
}

#[derive(FromPyObject)]
struct GasFields {
    pressure: f64,
    volume: f64,
    at: f64,
    exponent: f64,
}

impl GasFields {
    fn gas(self, area: f64) -> Gas {
        let Self { pressure, volume, at, exponent } = self;
        Gas { pressure, volume, at, exponent, area }
    }
}

#[derive(FromPyObject)]
struct Torque<'py> {
    link: String,
    torque: Bound<'py, PyAny>,
    on: String,
    while_: Option<String>,
    over: Option<String>,
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
    values: &mut Values<'_>,
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

fn load(
    mechanism: &Mechanism,
    object: &Bound<'_, PyAny>,
    values: &mut Values<'_>,
) -> PyResult<Load> {
    let is = |class| MODULE.is(object, class);
    let link = |name: &str| link(mechanism, name);
    let ends = |first: &PointLike, second: &PointLike| {
        Ok::<_, PyErr>([first.resolve(mechanism)?, second.resolve(mechanism)?])
    };
    if is("Force")? {
        let Force { at, force: [x, y], axes, on, while_, over } = object.extract()?;
        let force = [values.read(&x)?, values.read(&y)?];
        let one_way = values.one_way(while_.as_deref(), over.as_deref(), Measure::Driver(0))?;
        let axes = axes.as_deref().map(link).transpose()?;
        let on = on.as_deref().map(link).transpose()?;
        Ok(Load::Force { at: at.resolve(mechanism)?, force, axes, on, one_way })
    } else if is("Torque")? {
        let Torque { link: name, torque, on, while_, over } = object.extract()?;
        let torque = values.read(&torque)?;
        let one_way = values.one_way(while_.as_deref(), over.as_deref(), Measure::Driver(0))?;
        Ok(Load::Torque { link: link(&name)?, on: link(&on)?, torque, one_way })
    } else if is("Pressure")? {
        let Pressure { slide, area, pressure, expands, ambient, while_, over } =
            object.extract()?;
        let slide = mechanism.slide(&slide).map_err(error_map::solve)?;
        let area = if expands == "backward" { -area } else { area };
        let measure = Measure::Slide(slide);
        let pressure = if MODULE.is(&pressure, "Gas")? {
            let gas = pressure.extract::<GasFields>()?.gas(area);
            values.follow(Over { measure, curve: Curve::Gas(gas) })
        } else {
            values.read(&pressure)?
        };
        let one_way = values.one_way(while_.as_deref(), over.as_deref(), measure)?;
        Ok(Load::Pressure { slide, area, pressure, ambient, one_way })
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
