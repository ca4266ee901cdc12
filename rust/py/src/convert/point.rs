//! Points of a mechanism and lines between them.

use assur::Mechanism;
use assur::dynamics::{Line, Point};
use assur::sweep;
use pyo3::Borrowed;
use pyo3::prelude::*;
use pyo3::types::PyString;

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

/// `JointLine` or `GuideLine` of `assur.kinematics.transmission`: the fields show which.
#[derive(FromPyObject)]
pub(crate) enum LineOf {
    Joints { start: String, end: String },
    Guide { link: String, slide: String },
}

impl LineOf {
    /// The line in every design of a mechanism.
    pub(crate) fn of_designs(&self, mechanism: &Mechanism) -> PyResult<sweep::Line> {
        let line = match self {
            Self::Joints { start, end } => mechanism
                .joint(start)
                .and_then(|start| Ok(sweep::Line::Joints([start, mechanism.joint(end)?]))),
            Self::Guide { link, slide } => {
                let angle = format!("{slide}.angle");
                let angle = mechanism.dimensions().iter().position(|(name, _)| name == angle);
                mechanism.link(link).map(|link| sweep::Line::Guide(link, angle))
            }
        };
        line.map_err(error_map::solve)
    }

    /// The line in the design with these dimensions.
    pub(crate) fn of_design(&self, mechanism: &Mechanism, dimensions: &[f64]) -> PyResult<Line> {
        Ok(match self.of_designs(mechanism)? {
            sweep::Line::Joints([start, end]) => {
                Line::Through(Point::Joint(start), Point::Joint(end))
            }
            sweep::Line::Guide(link, angle) => {
                Line::Along(link, angle.map_or(0.0, |index| dimensions[index]))
            }
        })
    }
}
