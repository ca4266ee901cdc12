//! Converts errors of the core into the exceptions of `assur.errors`, with their fields.

use assur::{Named, SolveError, StructureError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The fields of an exception, by name.
#[derive(Default)]
struct Fields<'a> {
    joint: Option<&'a str>,
    link: Option<&'a str>,
    slide: Option<&'a str>,
    driver: Option<&'a str>,
    dimension: Option<&'a str>,
    value: Option<f64>,
}

impl<'a> Fields<'a> {
    fn named(kind: Named, name: &'a str) -> Self {
        match kind {
            Named::Joint | Named::Dyad => Self { joint: Some(name), ..Self::default() },
            Named::Link => Self { link: Some(name), ..Self::default() },
            Named::Slide => Self { slide: Some(name), ..Self::default() },
            Named::Dimension => Self { dimension: Some(name), ..Self::default() },
        }
    }
}

fn exception(class: &str, message: String, fields: &Fields<'_>) -> PyErr {
    Python::attach(|py| {
        let build = || -> PyResult<PyErr> {
            let class = py.import("assur.errors")?.getattr(class)?;
            let keywords = PyDict::new(py);
            keywords.set_item("joint", fields.joint)?;
            keywords.set_item("link", fields.link)?;
            keywords.set_item("slide", fields.slide)?;
            keywords.set_item("driver", fields.driver)?;
            keywords.set_item("dimension", fields.dimension)?;
            keywords.set_item("value", fields.value)?;
            Ok(PyErr::from_value(class.call((message,), Some(&keywords))?))
        };
        build().unwrap_or_else(|error| error)
    })
}

/// The Python exception for a `StructureError` of the core.
pub(crate) fn structure(error: StructureError) -> PyErr {
    use StructureError as E;
    let fields = match &error {
        E::BadName { kind, name } | E::Unknown { kind, name, .. } => Fields::named(*kind, name),
        E::DoubledName { name, second, .. } => Fields::named(*second, name),
        E::NotFinite { kind, name, value, .. } | E::OutOfRange { kind, name, value, .. } => {
            Fields { value: Some(*value), ..Fields::named(*kind, name) }
        }
        E::DoubledJoint { link, joint } => {
            Fields { link: Some(link), joint: Some(joint), ..Fields::default() }
        }
        E::LooseJoint { joint } => Fields { joint: Some(joint), ..Fields::default() },
        E::ZeroLength { link, second, .. } => {
            Fields { link: Some(link), joint: Some(second), value: Some(0.0), ..Fields::default() }
        }
        E::SameLink { link, .. } | E::Unplaced { link } => {
            Fields { link: Some(link), ..Fields::default() }
        }
        E::OriginNotOnLink { slide, joint, link } => {
            Fields { slide: Some(slide), joint: Some(joint), link: Some(link), ..Fields::default() }
        }
        E::GuideNowhere { slide, link, .. } => {
            Fields { slide: Some(slide), link: Some(link), ..Fields::default() }
        }
        E::GroundDriven { driver }
        | E::DoubledDriver { driver }
        | E::CannotDrive { driver, .. } => Fields { driver: Some(driver), ..Fields::default() },
        E::AlmostFits { links, gap, .. } => {
            Fields { link: first_quoted(links), value: Some(*gap), ..Fields::default() }
        }
        E::Unconnected { links } | E::OverConstrained { links, .. } => {
            Fields { link: first_quoted(links), ..Fields::default() }
        }
        E::SlidesOnly { slides } => Fields { slide: first_quoted(slides), ..Fields::default() },
        E::Immovable { over, .. } => {
            Fields { link: first_quoted(over), value: Some(0.0), ..Fields::default() }
        }
        E::Mobility { mobility, under, over, .. } => Fields {
            link: first_quoted(under).or_else(|| first_quoted(over)),
            #[allow(clippy::cast_precision_loss, reason = "a count of freedoms")]
            value: Some(*mobility as f64),
            ..Fields::default()
        },
        E::FlatDyad { name, sine, .. } => {
            Fields { joint: Some(name), value: Some(*sine), ..Fields::default() }
        }
        #[allow(clippy::cast_precision_loss, reason = "shown to the user only")]
        E::BadSign { name, value } => {
            Fields { joint: Some(name), value: Some(*value as f64), ..Fields::default() }
        }
        _ => Fields::default(),
    };
    exception("StructureError", error.to_string(), &fields)
}

/// The Python exception for a `SolveError` of the core.
pub(crate) fn solve(error: SolveError) -> PyErr {
    let message = error.to_string();
    match &error {
        SolveError::HigherClass { group, .. } => {
            // "III(a, b, c)": the first link.
            let inner = group.split(['(', ',', ')']).nth(1);
            exception("StructureError", message, &Fields { link: inner, ..Fields::default() })
        }
        SolveError::BadDimension { name, value, .. } => {
            let fields = Fields { dimension: Some(name), value: Some(*value), ..Fields::default() };
            exception("DimensionError", message, &fields)
        }
        SolveError::Redundant { name } => {
            exception("InputError", message, &Fields { link: Some(name), ..Fields::default() })
        }
        SolveError::Unknown { kind, name, .. } => {
            exception("InputError", message, &Fields::named(*kind, name))
        }
        _ => exception("InputError", message, &Fields::default()),
    }
}

/// An `InputError` with the wrong number.
pub(crate) fn input(message: String, value: Option<f64>) -> PyErr {
    exception("InputError", message, &Fields { value, ..Fields::default() })
}

/// An `AssurError` for a fault of the library.
pub(crate) fn internal(what: &str, place: &str) -> PyErr {
    let message = format!(
        "a fault of assur, not of your input: {what} ({place}); please report it with the call that led to it"
    );
    exception("AssurError", message, &Fields::default())
}

/// Whether an exception comes from [`internal`]: an `AssurError`, but no subclass of it.
pub(crate) fn is_internal(py: Python<'_>, error: &PyErr) -> bool {
    let base = py.import("assur.errors").and_then(|module| module.getattr("AssurError"));
    base.is_ok_and(|base| error.get_type(py).is(&base))
}

/// A `PositionError`.
pub(crate) fn position(message: String) -> PyErr {
    exception("PositionError", message, &Fields::default())
}

/// The first quoted name in a message.
fn first_quoted(text: &str) -> Option<&str> {
    text.split('"').nth(1)
}
