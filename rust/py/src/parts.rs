//! Parts of machines as Python tells them.

use assur::Mechanism;
use assur::dynamics::{
    Angle, Body, Characteristic, EventKind, EventSpec, Line, Load, Motor, Point, Table, Value,
};
use assur::ode::Crossing;
use pyo3::prelude::*;

use crate::error;
use crate::flywheel::ends;

/// A joint, or a link and a place in its frame.
#[derive(FromPyObject)]
pub(crate) enum Place {
    Joint(String),
    Link((String, [f64; 2])),
}

/// A number, or which of the machine's tables or of the functions.
#[derive(FromPyObject)]
pub(crate) enum Told {
    Number(f64),
    Listed((String, usize)),
}

/// Rows, values, spline, whether periodic.
pub(crate) type TableParts = (Vec<f64>, Vec<f64>, String, bool);
/// Link, centre of mass, mass, inertia.
pub(crate) type BodyParts = (String, Place, f64, f64);
/// Kind, places, links, numbers, values.
pub(crate) type LoadParts = (String, Vec<Place>, Vec<String>, Vec<f64>, Vec<Told>);
/// Driver, ratio, rotor's inertia, kind, numbers, values, table over the speed.
pub(crate) type MotorParts = (usize, f64, f64, String, Vec<f64>, Vec<Told>, Option<TableParts>);
/// A line: two places, or a link and an angle in its frame.
#[derive(FromPyObject)]
pub(crate) enum LineParts {
    Through((Place, Place)),
    Along((String, f64)),
}
/// Kind, driver or function, value, lines, whether their complement, direction, whether it stops.
pub(crate) type WatchParts = (String, usize, f64, Vec<LineParts>, bool, i8, bool);

impl Told {
    fn value(self) -> Value {
        match self {
            Self::Number(number) => Value::Number(number),
            Self::Listed((kind, which)) if kind == "table" => Value::Table(which),
            Self::Listed((_, which)) => Value::External(which),
        }
    }
}

fn values(told: Vec<Told>) -> Vec<Value> {
    told.into_iter().map(Told::value).collect()
}

pub(crate) fn table((knots, values, spline, periodic): TableParts) -> PyResult<Table> {
    Table::new(&knots, &values, ends(&spline)?, periodic)
        .map_err(|e| error::input(e.to_string(), None))
}

fn point(own: &Mechanism, place: Place) -> PyResult<Point> {
    Ok(match place {
        Place::Joint(name) => Point::Joint(own.joint(&name).map_err(error::solve)?),
        Place::Link((name, at)) => Point::Link { link: own.link(&name).map_err(error::solve)?, at },
    })
}

pub(crate) fn body(own: &Mechanism, (name, place, mass, inertia): BodyParts) -> PyResult<Body> {
    let link = own.link(&name).map_err(error::solve)?;
    Ok(Body { link, at: point(own, place)?, mass, inertia })
}

pub(crate) fn load(own: &Mechanism, parts: LoadParts) -> PyResult<Load> {
    let (kind, places, links, numbers, told) = parts;
    let places = places.into_iter().map(|place| point(own, place)).collect::<PyResult<Vec<_>>>()?;
    let link = |name: &String| own.link(name).map_err(error::solve);
    let links = links.iter().map(link).collect::<PyResult<Vec<_>>>()?;
    let values = values(told);
    Ok(match (kind.as_str(), &places[..], &links[..], &numbers[..], &values[..]) {
        ("force", &[at], links, [], &[x, y]) => {
            Load::Force { at, force: [x, y], axes: links.first().copied() }
        }
        ("torque", [], &[link, on], [], &[torque]) => Load::Torque { link, on, torque },
        ("spring", &[a, b], [], &[stiffness, length, preload], []) => {
            Load::Spring { ends: [a, b], stiffness, length, preload }
        }
        ("torsion spring", [], &[link, on], &[stiffness, angle, preload], []) => {
            Load::TorsionSpring { link, on, stiffness, angle, preload }
        }
        ("damper", &[a, b], [], &[damping], []) => Load::Damper { ends: [a, b], damping },
        ("torsion damper", [], &[link, on], &[damping], []) => {
            Load::TorsionDamper { link, on, damping }
        }
        _ => return Err(error::input(format!("no such load: {kind:?}"), None)),
    })
}

pub(crate) fn motor(parts: MotorParts) -> PyResult<Motor> {
    let (driver, ratio, rotor_inertia, kind, numbers, told, over_speed) = parts;
    let values = values(told);
    let characteristic = match (kind.as_str(), &numbers[..], &values[..], over_speed) {
        ("value", [], &[value], None) => Characteristic::Value(value),
        ("linear", &[stall, no_load], [], None) => Characteristic::Linear { stall, no_load },
        ("induction", &[breakdown, slip, synchronous], [], None) => {
            Characteristic::Induction { breakdown, slip, synchronous }
        }
        ("table", [], [], Some(parts)) => Characteristic::Table(table(parts)?),
        _ => return Err(error::input(format!("no such motor: {kind:?}"), None)),
    };
    Ok(Motor { driver, ratio, rotor_inertia, characteristic })
}

fn line(own: &Mechanism, parts: LineParts) -> PyResult<Line> {
    Ok(match parts {
        LineParts::Through((a, b)) => Line::Through(point(own, a)?, point(own, b)?),
        LineParts::Along((link, angle)) => {
            Line::Along(own.link(&link).map_err(error::solve)?, angle)
        }
    })
}

pub(crate) fn watch(own: Option<&Mechanism>, parts: WatchParts) -> PyResult<EventSpec> {
    let (kind, which, value, lines, complement, direction, stops) = parts;
    let occasion = match (kind.as_str(), own) {
        ("coordinate", _) => EventKind::Coordinate { driver: which, value },
        ("speed", _) => EventKind::Speed { driver: which, value },
        ("function", _) => EventKind::Callback(which),
        ("angle", Some(own)) => {
            let lines = lines.into_iter().map(|l| line(own, l)).collect::<PyResult<Vec<_>>>()?;
            let lines = <[Line; 2]>::try_from(lines)
                .map_err(|_| error::input("an angle is between two lines".into(), None))?;
            EventKind::Angle(Angle { lines, complement }, value)
        }
        _ => return Err(error::input(format!("no such event: {kind:?}"), None)),
    };
    let crossing = match direction {
        0 => Crossing::Either,
        1.. => Crossing::Rising,
        _ => Crossing::Falling,
    };
    Ok(EventSpec { kind: occasion, crossing, stops })
}
