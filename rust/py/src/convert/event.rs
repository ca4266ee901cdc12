//! Events that a run looks for.

use assur::Mechanism;
use assur::dynamics::{Angle, EventKind, EventSpec};
use pyo3::prelude::*;

use super::Classes;
use super::point::LineOf;
use super::word::Word;

const MODULE: Classes = Classes("assur.events");

#[derive(FromPyObject)]
struct Rest {
    driver: usize,
}

#[derive(FromPyObject)]
struct Position {
    q: f64,
    driver: usize,
}

#[derive(FromPyObject)]
struct Speed {
    speed: f64,
    driver: usize,
}

/// A `TransmissionAngle` with the lines that Python found for it.
#[derive(FromPyObject)]
struct AngleLimit {
    lines: [LineOf; 2],
    complement: bool,
    limit: f64,
}

#[derive(FromPyObject)]
struct Crossing<'py> {
    function: Bound<'py, PyAny>,
}

#[derive(FromPyObject)]
struct Obstacle<'py> {
    at: Bound<'py, PyAny>,
    restitution: f64,
}

/// Reads an event of the design with these dimensions; its function, if it has one, is added to
/// the list.
pub(crate) fn event(
    mechanism: Option<&Mechanism>,
    dimensions: &[f64],
    object: &Bound<'_, PyAny>,
    functions: &mut Vec<Py<PyAny>>,
) -> PyResult<EventSpec> {
    let is = |class| MODULE.is(object, class);
    if is("Obstacle")? {
        let Obstacle { at, restitution } = object.extract()?;
        let spec = event(mechanism, dimensions, &at, functions)?;
        return Ok(EventSpec { rebound: Some(restitution), stops: false, ..spec });
    }
    let crossing = |object: &Bound<'_, PyAny>| {
        object
            .getattr("direction")?
            .extract()
            .map(|Word::<assur::ode::Crossing>(crossing)| crossing)
    };
    let (kind, crossing) = if is("Rest")? {
        let Rest { driver } = object.extract()?;
        (EventKind::Speed { driver, value: 0.0 }, assur::ode::Crossing::Either)
    } else if is("Position")? {
        let Position { q: value, driver } = object.extract()?;
        (EventKind::Coordinate { driver, value }, crossing(object)?)
    } else if is("Speed")? {
        let Speed { speed: value, driver } = object.extract()?;
        (EventKind::Speed { driver, value }, crossing(object)?)
    } else if is("Crossing")? {
        let Crossing { function } = object.extract()?;
        functions.push(function.unbind());
        (EventKind::Callback(functions.len() - 1), crossing(object)?)
    } else if let (true, Some(mechanism)) = (is("AngleLimit")?, mechanism) {
        let AngleLimit { lines: [first, second], complement, limit } = object.extract()?;
        let lines =
            [first.of_design(mechanism, dimensions)?, second.of_design(mechanism, dimensions)?];
        (EventKind::Angle(Angle { lines, complement }, limit), crossing(object)?)
    } else {
        return Err(MODULE.unknown(object));
    };
    Ok(EventSpec { kind, crossing, stops: object.getattr("stop")?.extract()?, rebound: None })
}
