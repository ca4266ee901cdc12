//! Metrics of a batch.

use std::num::NonZeroUsize;

use assur::sweep::{Gradients, Measured, Metric, Relation, Sweep};
use assur::{Control, Mechanism};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::convert::metric::{condition, metric_of};
use crate::convert::word::Word;
use crate::motion::short_calls::is_short;
use crate::{detach, error_map, reserve};

/// An array for each metric, or each gradient.
type Numbers<'py> = Vec<Bound<'py, PyArray1<f64>>>;

/// Metric, relation and limit of each.
type Conditions = Vec<(usize, Word<Relation>, f64)>;

/// Values of each metric, statuses, the designs that are kept, and the gradients, design after design.
pub(crate) type Found<'py> =
    (Numbers<'py>, Bound<'py, PyArray1<u8>>, Bound<'py, PyArray1<bool>>, Numbers<'py>);

/// See `assur.sweep`.
pub(crate) fn measure<'py>(
    py: Python<'py>,
    mechanism: &Mechanism,
    (dimensions, q): (PyReadonlyArray1<'py, f64>, PyReadonlyArray1<'py, f64>),
    signs: &[i8],
    (metrics, conditions): (&[Bound<'py, PyAny>], Conditions),
    (of, by): (&[usize], &[usize]),
    threads: Option<NonZeroUsize>,
) -> PyResult<Found<'py>> {
    let (dimensions, q) = (dimensions.as_slice()?, q.as_slice()?);
    let conditions: Vec<_> = conditions.into_iter().map(condition).collect();
    let metrics =
        metrics.iter().map(|metric| metric_of(mechanism, metric)).collect::<PyResult<Vec<_>>>()?;
    let metrics: Vec<&dyn Metric> = metrics.iter().map(|metric| &**metric as &dyn Metric).collect();
    let gradients = Gradients { of, by };
    let sweep =
        Sweep { dimensions, q, signs, metrics: &metrics, conditions: &conditions, gradients };
    let designs = dimensions.len() / mechanism.dimensions().len().max(1);
    let efforts = metrics.iter().map(|metric| metric.effort());
    let effort = efforts.fold(1, usize::saturating_add);
    let small = is_short(mechanism, designs, q.len().saturating_mul(effort));
    let numbers = metrics.len() + 2 + of.len().saturating_mul(by.len());
    let _room = reserve::room_for(py, designs.saturating_mul(numbers))?;
    let measured = detach::run(py, small, |cancel| {
        let control = Control { threads, cancel: Some(cancel), ..Control::default() };
        mechanism.measure(&sweep, &control)
    })?;
    let Measured { values, status, kept, gradients } = measured.map_err(error_map::solve)?;
    let arrays = |numbers: Vec<Vec<f64>>| -> Numbers<'py> {
        numbers.into_iter().map(|numbers| PyArray1::from_vec(py, numbers)).collect()
    };
    let (status, kept) = (PyArray1::from_vec(py, status), PyArray1::from_vec(py, kept));
    Ok((arrays(values), status, kept, arrays(gradients)))
}
