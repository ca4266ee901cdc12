//! Bodies of machines.

use assur::Mechanism;
use assur::dynamics::Point;
use pyo3::Borrowed;
use pyo3::prelude::*;
use pyo3::types::PyString;

use super::point::{joint, link};

/// `assur.Body`.
#[derive(FromPyObject)]
pub(crate) struct Body {
    mass: f64,
    inertia: f64,
    at: Option<CentreOfMass>,
}

/// A joint of the link, or coordinates in its frame.
enum CentreOfMass {
    Joint(String),
    Coordinates([f64; 2]),
}

impl<'a, 'py> FromPyObject<'a, 'py> for CentreOfMass {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if object.is_instance_of::<PyString>() {
            object.extract().map(Self::Joint)
        } else {
            object.extract().map(Self::Coordinates)
        }
    }
}

impl Body {
    pub(crate) fn of_link(
        &self,
        mechanism: &Mechanism,
        name: &str,
    ) -> PyResult<assur::dynamics::Body> {
        let link = link(mechanism, name)?;
        let at = match (&self.at, mechanism.linkage().links[link].joints.first()) {
            (Some(CentreOfMass::Joint(name)), _) => joint(mechanism, name)?,
            (Some(CentreOfMass::Coordinates(at)), _) => Point::Link { link, at: *at },
            (None, Some(&first)) => Point::Joint(first),
            (None, None) => Point::Link { link, at: [0.0, 0.0] },
        };
        Ok(assur::dynamics::Body { link, at, mass: self.mass, inertia: self.inertia })
    }
}
