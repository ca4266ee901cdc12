//! Metrics of a batch.

use std::num::NonZeroUsize;

use assur::sweep::{Measured, Metric, Relation, Sweep};
use assur::{Control, Mechanism};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::convert::metric::{condition, metric_of};
use crate::convert::word::Word;
use crate::motion::short_calls::is_short;
use crate::{detach, error_map, reserve};

/// Values of each metric, statuses, and the designs that are kept.
pub(crate) type Found<'py> =
    (Vec<Bound<'py, PyArray1<f64>>>, Bound<'py, PyArray1<u8>>, Bound<'py, PyArray1<bool>>);

/// See `assur.sweep`.
pub(crate) fn measure<'py>(
    py: Python<'py>,
    mechanism: &Mechanism,
    (dimensions, q): (PyReadonlyArray1<'py, f64>, PyReadonlyArray1<'py, f64>),
    signs: &[i8],
    metrics: &[Bound<'py, PyAny>],
    conditions: Vec<(usize, Word<Relation>, f64)>,
    threads: Option<NonZeroUsize>,
) -> PyResult<Found<'py>> {
    let (dimensions, q) = (dimensions.as_slice()?, q.as_slice()?);
    let conditions: Vec<_> = conditions.into_iter().map(condition).collect();
    let metrics =
        metrics.iter().map(|metric| metric_of(mechanism, metric)).collect::<PyResult<Vec<_>>>()?;
    let metrics: Vec<&dyn Metric> = metrics.iter().map(|metric| &**metric as &dyn Metric).collect();
    let sweep = Sweep { dimensions, q, signs, metrics: &metrics, conditions: &conditions };
    let designs = dimensions.len() / mechanism.dimensions().len().max(1);
    let small = is_short(mechanism, designs, q.len());
    let _room = reserve::room_for(py, designs.saturating_mul(metrics.len() + 2))?;
    let measured = detach::run(py, small, |cancel| {
        let control = Control { threads, cancel: Some(cancel), ..Control::default() };
        mechanism.measure(&sweep, &control)
    })?;
    let Measured { values, status, kept } = measured.map_err(error_map::solve)?;
    let values = values.into_iter().map(|values| PyArray1::from_vec(py, values)).collect();
    Ok((values, PyArray1::from_vec(py, status), PyArray1::from_vec(py, kept)))
}
