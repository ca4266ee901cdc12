//! An error as Python sees it: the class of `assur.errors`, its kind, message, hint and fields.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

/// Names and numbers of an exception; `None` where they do not apply.
#[derive(Default)]
pub(crate) struct Fields<'a> {
    pub joint: Option<&'a str>,
    pub link: Option<&'a str>,
    pub slide: Option<&'a str>,
    pub driver: Option<&'a str>,
    pub dimension: Option<&'a str>,
    /// All names in the message; if it is empty, those above.
    pub names: Vec<&'a str>,
    pub group: Option<&'a str>,
    /// Index of the design in a batch.
    pub design: Option<Vec<usize>>,
    pub q: Option<&'a [f64]>,
    pub t: Option<f64>,
    pub value: Option<f64>,
}

/// The classes of exceptions that the core raises.
#[derive(Clone, Copy)]
pub(crate) enum Class {
    Structure,
    Dimension,
    Input,
    Position,
    Motion,
    /// A bug in the library.
    Internal,
}

impl Class {
    fn name(self) -> &'static str {
        match self {
            Self::Structure => "StructureError",
            Self::Dimension => "DimensionError",
            Self::Input => "InputError",
            Self::Position => "PositionError",
            Self::Motion => "MotionError",
            Self::Internal => "AssurError",
        }
    }
}

/// Makes the exception. `hint` is the advice at the end of the message.
pub(crate) fn exception(
    class: Class,
    kind: Option<&str>,
    message: &str,
    hint: Option<&str>,
    fields: &Fields<'_>,
) -> PyErr {
    Python::attach(|py| {
        let build = || -> PyResult<PyErr> {
            let class = py.import("assur.errors")?.getattr(class.name())?;
            let keywords = PyDict::new(py);
            keywords.set_item("kind", kind)?;
            keywords.set_item("hint", hint)?;
            keywords.set_item("joint", fields.joint)?;
            keywords.set_item("link", fields.link)?;
            keywords.set_item("slide", fields.slide)?;
            keywords.set_item("driver", fields.driver)?;
            keywords.set_item("dimension", fields.dimension)?;
            keywords.set_item("names", PyTuple::new(py, &fields.names)?)?;
            keywords.set_item("group", fields.group)?;
            keywords.set_item("t", fields.t)?;
            keywords.set_item("value", fields.value)?;
            let design = fields.design.as_ref().map(|design| PyTuple::new(py, design)).transpose();
            keywords.set_item("design", design?)?;
            match fields.q {
                None => {}
                Some(&[q]) => keywords.set_item("q", q)?,
                Some(q) => keywords.set_item("q", PyTuple::new(py, q)?)?,
            }
            Ok(PyErr::from_value(class.call((message,), Some(&keywords))?))
        };
        build().unwrap_or_else(|error| error)
    })
}

/// An `InputError` with the wrong number.
pub(crate) fn input(message: &str, value: Option<f64>) -> PyErr {
    exception(Class::Input, None, message, None, &Fields { value, ..Fields::default() })
}

/// An `AssurError` for a bug in the library.
pub(crate) fn internal(what: &str, location: &str) -> PyErr {
    let message = format!(
        "a fault of assur, not of your input: {what} ({location}); please report it with the call that led to it"
    );
    exception(Class::Internal, Some("internal"), &message, None, &Fields::default())
}

/// Whether an exception comes from [`internal`]: an `AssurError`, but no subclass of it.
pub(crate) fn is_internal(py: Python<'_>, error: &PyErr) -> bool {
    let base = py.import("assur.errors").and_then(|module| module.getattr("AssurError"));
    base.is_ok_and(|base| error.get_type(py).is(&base))
}
