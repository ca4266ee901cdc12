//! Remedies for a refused description.

use assur::DriverDescription;
use pyo3::prelude::*;

use crate::convert::description::{Driver, Slide};
use crate::mechanism::described;
use crate::motion::short_calls::FEW_LINKS;
use crate::{detach, error_map};

/// A remedy; for Python the dictionary of its fields.
#[derive(IntoPyObject)]
pub(crate) struct RemedyFields {
    kind: &'static str,
    names: Vec<String>,
    text: String,
    detail: String,
    joints: Vec<(String, f64, f64)>,
    links: Vec<(String, Vec<String>)>,
    slides: Vec<(String, Slide)>,
    /// Each a link or slide, or a link and the link from which it is measured.
    drivers: Vec<(String, Option<String>)>,
    assembly: Vec<(String, i64)>,
}

impl From<assur::Remedy> for RemedyFields {
    fn from(remedy: assur::Remedy) -> Self {
        let description = remedy.description;
        let driver = |driver| match driver {
            DriverDescription::Named(name) => (name, None),
            DriverDescription::Relative { link, relative_to } => (link, Some(relative_to)),
        };
        Self {
            kind: remedy.kind.into(),
            names: remedy.names,
            text: remedy.text,
            detail: remedy.detail,
            joints: description.joints.into_iter().map(|(name, [x, y])| (name, x, y)).collect(),
            links: description.links,
            slides: description.slides.into_iter().map(Slide::with_name).collect(),
            drivers: description.drivers.into_iter().map(driver).collect(),
            assembly: description.assembly,
        }
    }
}

/// Edits after which a refused description is a mechanism.
#[pyfunction]
pub(crate) fn remedies(
    py: Python<'_>,
    joints: Vec<(String, f64, f64)>,
    links: Vec<(String, Vec<String>)>,
    slides: Vec<(String, Slide)>,
    drivers: Vec<Driver>,
    assembly: Vec<(String, i64)>,
) -> PyResult<Vec<RemedyFields>> {
    let description = described(joints, links, slides, drivers, assembly);
    let small = description.links.len() < FEW_LINKS / 4;
    let result = detach::run(py, small, |cancel| assur::remedies(&description, Some(cancel)))?;
    Ok(result.map_err(error_map::structure)?.into_iter().map(RemedyFields::from).collect())
}
