//! Points of a mechanism and lines between them.

use assur::Mechanism;
use assur::dynamics::{Line, Point};
use pyo3::Borrowed;
use pyo3::prelude::*;
use pyo3::types::PyString;

use super::Classes;
use crate::error_map;

/// A joint, or a link and coordinates in its frame.
pub(crate) enum PointLike {
    Joint(String),
    Link(String, [f64; 2]),
}

impl<'a, 'py> FromPyObject<'a, 'py> for PointLike {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if object.is_instance_of::<PyString>() {
            return object.extract().map(Self::Joint);
        }
        let (link, at) = object.extract()?;
        Ok(Self::Link(link, at))
    }
}

impl PointLike {
    pub(crate) fn resolve(&self, mechanism: &Mechanism) -> PyResult<Point> {
        Ok(match self {
            Self::Joint(name) => joint(mechanism, name)?,
            Self::Link(name, at) => Point::Link { link: link(mechanism, name)?, at: *at },
        })
    }
}

pub(crate) fn joint(mechanism: &Mechanism, name: &str) -> PyResult<Point> {
    mechanism.joint(name).map(Point::Joint).map_err(error_map::solve)
}

pub(crate) fn link(mechanism: &Mechanism, name: &str) -> PyResult<usize> {
    mechanism.link(name).map_err(error_map::solve)
}

const MODULE: Classes = Classes("assur.kinematics.transmission");

/// A line from joint to joint.
#[derive(FromPyObject)]
struct JointLine {
    start: String,
    end: String,
}

/// A line fixed to a link, at this angle in its frame.
#[derive(FromPyObject)]
struct LinkLine {
    link: String,
    angle: f64,
}

pub(crate) fn line(mechanism: &Mechanism, object: &Bound<'_, PyAny>) -> PyResult<Line> {
    if MODULE.is(object, "JointLine")? {
        let JointLine { start, end } = object.extract()?;
        return Ok(Line::Through(joint(mechanism, &start)?, joint(mechanism, &end)?));
    }
    if MODULE.is(object, "LinkLine")? {
        let LinkLine { link: name, angle } = object.extract()?;
        return Ok(Line::Along(link(mechanism, &name)?, angle));
    }
    Err(MODULE.unknown(object))
}
