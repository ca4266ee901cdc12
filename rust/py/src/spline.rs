//! Splines through tables, for laws over time.

use assur::dynamics::{EndCondition, spline_unless};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::convert::value::FEW_ROWS;
use crate::convert::word::Word;
use crate::{detach, error_map, reserve};

/// The pieces of a spline: for each its value and derivatives, divided by 1, 1, 2, 6, at its first
/// knot (flat).
#[pyfunction]
pub(crate) fn spline_pieces<'py>(
    py: Python<'py>,
    knots: PyReadonlyArray1<'py, f64>,
    values: PyReadonlyArray1<'py, f64>,
    ends: Word<EndCondition>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let (knots, values) = (knots.as_slice()?, values.as_slice()?);
    let _room = reserve::room_for(py, 8 * knots.len())?;
    let pieces = detach::run(py, knots.len() < FEW_ROWS, |cancel| {
        spline_unless(knots, values, ends.0, cancel)
    })?;
    let pieces = pieces.map_err(|error| error_map::table(&error, "the table", None))?;
    Ok(PyArray1::from_vec(py, pieces.into_flattened()))
}
