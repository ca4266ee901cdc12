//! Reads the dataclasses of the Python package. A struct here has the name and the fields of its
//! class, which has checked their values.

pub(crate) mod body;
pub(crate) mod description;
pub(crate) mod event;
pub(crate) mod friction;
pub(crate) mod load;
pub(crate) mod metric;
pub(crate) mod motor;
pub(crate) mod point;
pub(crate) mod target;
pub(crate) mod value;
pub(crate) mod varied;
pub(crate) mod word;

use pyo3::prelude::*;
use pyo3::types::PyType;

use crate::error;

/// A module of the package with dataclasses.
#[derive(Clone, Copy)]
pub(crate) struct Classes(&'static str);

impl Classes {
    /// Whether an object is an instance of this class or of a subclass.
    fn is(self, object: &Bound<'_, PyAny>, class: &str) -> PyResult<bool> {
        let class = object.py().import(self.0)?.getattr(class)?;
        object.is_instance(class.cast::<PyType>()?)
    }

    /// The error for an object of another class.
    fn unknown(self, object: &Bound<'_, PyAny>) -> PyErr {
        let class = object.get_type();
        error::input(&format!("{class} is not a class of {}", self.0), None)
    }
}
