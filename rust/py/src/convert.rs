//! Converts the parts of machines from the tuples that Python passes.

use assur::Mechanism;
use assur::dynamics::{
    Angle, Body, Characteristic, EventKind, EventSpec, Line, Load, Motor, Point, Table, Value,
};
use assur::ode::Crossing;
use pyo3::prelude::*;

use crate::flywheel::ends;
use crate::{error, error_map};

/// A joint, or a link and a point in its frame.
#[derive(FromPyObject)]
pub(crate) enum PointArguments {
    Joint(String),
    Link((String, [f64; 2])),
}

/// A constant, or (kind, index) of a table or a function of the machine.
#[derive(FromPyObject)]
pub(crate) enum Encoded {
    Number(f64),
    Indexed((String, usize)),
}

/// Knots, values, spline, whether periodic.
pub(crate) type TableArguments = (Vec<f64>, Vec<f64>, String, bool);
/// Link, centre of mass, mass, inertia.
pub(crate) type BodyArguments = (String, PointArguments, f64, f64);
/// Kind, points, links, numbers, values.
pub(crate) type LoadArguments = (String, Vec<PointArguments>, Vec<String>, Vec<f64>, Vec<Encoded>);
/// Driver, ratio, rotor's inertia, kind, numbers, values, table over the speed.
pub(crate) type MotorArguments =
    (usize, f64, f64, String, Vec<f64>, Vec<Encoded>, Option<TableArguments>);
/// A line: through two points, or along a link at an angle in its frame.
#[derive(FromPyObject)]
pub(crate) enum LineArguments {
    Through((PointArguments, PointArguments)),
    Along((String, f64)),
}
/// Kind, index of the driver or function, value, lines, whether to take the complement of their
/// angle, direction, whether the event stops the run.
pub(crate) type EventArguments = (String, usize, f64, Vec<LineArguments>, bool, i8, bool);

impl Encoded {
    fn value(self) -> Value {
        match self {
            Self::Number(number) => Value::Number(number),
            Self::Indexed((kind, index)) if kind == "table" => Value::Table(index),
            Self::Indexed((_, index)) => Value::External(index),
        }
    }
}

fn values(encoded: Vec<Encoded>) -> Vec<Value> {
    encoded.into_iter().map(Encoded::value).collect()
}

pub(crate) fn table((knots, values, spline, periodic): TableArguments) -> PyResult<Table> {
    Table::new(&knots, &values, ends(&spline)?, periodic)
        .map_err(|error| error_map::table(&error, "", None))
}

fn point(mechanism: &Mechanism, arguments: PointArguments) -> PyResult<Point> {
    Ok(match arguments {
        PointArguments::Joint(name) => {
            Point::Joint(mechanism.joint(&name).map_err(error_map::solve)?)
        }
        PointArguments::Link((name, at)) => {
            Point::Link { link: mechanism.link(&name).map_err(error_map::solve)?, at }
        }
    })
}

pub(crate) fn body(
    mechanism: &Mechanism,
    (name, centre, mass, inertia): BodyArguments,
) -> PyResult<Body> {
    let link = mechanism.link(&name).map_err(error_map::solve)?;
    Ok(Body { link, at: point(mechanism, centre)?, mass, inertia })
}

pub(crate) fn load(mechanism: &Mechanism, arguments: LoadArguments) -> PyResult<Load> {
    let (kind, points, links, numbers, encoded) = arguments;
    let points =
        points.into_iter().map(|one| point(mechanism, one)).collect::<PyResult<Vec<_>>>()?;
    let link = |name: &String| mechanism.link(name).map_err(error_map::solve);
    let links = links.iter().map(link).collect::<PyResult<Vec<_>>>()?;
    let values = values(encoded);
    Ok(match (kind.as_str(), &points[..], &links[..], &numbers[..], &values[..]) {
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
        _ => return Err(error::input(&format!("no such load: {kind:?}"), None)),
    })
}

pub(crate) fn motor(arguments: MotorArguments) -> PyResult<Motor> {
    let (driver, ratio, rotor_inertia, kind, numbers, encoded, over_speed) = arguments;
    let values = values(encoded);
    let characteristic = match (kind.as_str(), &numbers[..], &values[..], over_speed) {
        ("value", [], &[value], None) => Characteristic::Value(value),
        ("linear", &[stall, no_load], [], None) => Characteristic::Linear { stall, no_load },
        ("induction", &[breakdown, slip, synchronous], [], None) => {
            Characteristic::Induction { breakdown, slip, synchronous }
        }
        ("table", [], [], Some(arguments)) => Characteristic::Table(table(arguments)?),
        _ => return Err(error::input(&format!("no such motor: {kind:?}"), None)),
    };
    Ok(Motor { driver, ratio, rotor_inertia, characteristic })
}

fn line(mechanism: &Mechanism, arguments: LineArguments) -> PyResult<Line> {
    Ok(match arguments {
        LineArguments::Through((a, b)) => Line::Through(point(mechanism, a)?, point(mechanism, b)?),
        LineArguments::Along((link, angle)) => {
            Line::Along(mechanism.link(&link).map_err(error_map::solve)?, angle)
        }
    })
}

pub(crate) fn event(
    mechanism: Option<&Mechanism>,
    arguments: EventArguments,
) -> PyResult<EventSpec> {
    let (kind, index, value, lines, complement, direction, stops) = arguments;
    let kind = match (kind.as_str(), mechanism) {
        ("coordinate", _) => EventKind::Coordinate { driver: index, value },
        ("speed", _) => EventKind::Speed { driver: index, value },
        ("function", _) => EventKind::Callback(index),
        ("angle", Some(mechanism)) => {
            let lines =
                lines.into_iter().map(|l| line(mechanism, l)).collect::<PyResult<Vec<_>>>()?;
            let lines = <[Line; 2]>::try_from(lines)
                .map_err(|_| error::input("an angle is between two lines", None))?;
            EventKind::Angle(Angle { lines, complement }, value)
        }
        _ => return Err(error::input(&format!("no such event: {kind:?}"), None)),
    };
    let crossing = match direction {
        0 => Crossing::Either,
        1.. => Crossing::Rising,
        _ => Crossing::Falling,
    };
    Ok(EventSpec { kind, crossing, stops })
}
