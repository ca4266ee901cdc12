//! Slides and drivers of a description.

use assur::{DriverDescription, SlideDescription};
use pyo3::Borrowed;
use pyo3::prelude::*;
use pyo3::types::PyString;

/// `assur.Slide`; for Python the dictionary of its fields.
#[derive(FromPyObject, IntoPyObject)]
pub(crate) struct Slide {
    link: String,
    on: String,
    angle: f64,
    origin: Option<String>,
    length: bool,
}

impl Slide {
    pub(crate) fn named(self, name: String) -> SlideDescription {
        let Self { link, on, angle, origin, length } = self;
        SlideDescription { name, link, on, angle, origin, length }
    }

    pub(crate) fn with_name(description: SlideDescription) -> (String, Self) {
        let SlideDescription { name, link, on, angle, origin, length } = description;
        (name, Self { link, on, angle, origin, length })
    }
}

/// A link or slide, or an `assur.Drive`.
pub(crate) struct Driver(pub(crate) DriverDescription);

#[derive(FromPyObject)]
struct Drive {
    link: String,
    relative_to: String,
}

impl<'a, 'py> FromPyObject<'a, 'py> for Driver {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if object.is_instance_of::<PyString>() {
            return Ok(Self(DriverDescription::Named(object.extract()?)));
        }
        let Drive { link, relative_to } = object.extract()?;
        Ok(Self(DriverDescription::Relative { link, relative_to }))
    }
}
