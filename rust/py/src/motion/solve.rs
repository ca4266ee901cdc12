//! Positions of a batch of designs.

use std::mem::MaybeUninit;
use std::num::NonZeroUsize;
use std::sync::Mutex;

use assur::{
    Arrays, Column, Control, Coordinates, FailureLog, Mechanism, Outputs, Request, SolveError,
    Status, fill,
};
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1, PyReadwriteArray1};
use pyo3::exceptions::{PyBaseException, PyMemoryError};
use pyo3::prelude::*;

use super::short_calls::{is_near, is_short};
use crate::detach::{self, catch_panic};
use crate::memory::{Memory, as_uninitialized};
use crate::{error, error_map};

/// Bytes below which a result is one array: making many takes longer than solving.
const SMALL_RESULT: usize = 64 << 10;

/// An array for each column, or one for all of a small result; statuses; the first failure.
pub(crate) type Solution<'py> =
    (Vec<Bound<'py, PyArray1<f64>>>, Bound<'py, PyArray1<u8>>, Option<Py<PyBaseException>>);

/// The designs of a batch that earlier calls found to have constant signs, for later calls with the
/// same dimensions and assembly; several calls may share it.
#[pyclass(module = "assur._core", frozen)]
pub(crate) struct KnownSigns(pub(crate) assur::KnownSigns);

#[pymethods]
impl KnownSigns {
    #[new]
    fn new(designs: usize) -> PyResult<Self> {
        let signs = assur::KnownSigns::new(designs);
        signs.map(Self).map_err(|_| {
            PyMemoryError::new_err(format!(
                "out of memory: one byte for each of {designs} designs is needed"
            ))
        })
    }
}

/// A request to solve; see `assur.Mechanism.solve`. `outputs`: indices of joints, links (angles), links
/// (reference points) and slides. `known_signs`: valid for these
/// dimensions and signs.
pub(crate) struct Question<'q, 'py> {
    pub mechanism: &'q Mechanism,
    pub dimensions: PyReadonlyArray1<'py, f64>,
    pub q: PyReadonlyArray1<'py, f64>,
    pub per_design: bool,
    pub signs: &'q [i8],
    pub order: usize,
    pub outputs: [Vec<usize>; 4],
    pub known_signs: Option<Bound<'py, KnownSigns>>,
}

impl<'py> Question<'_, 'py> {
    /// Solves it. `buffers`: the arrays of an earlier result (`arrays`, `status`) to overwrite; its
    /// `complete` is false meanwhile. `report`: the shape of the designs, for the exception of the first
    /// position that failed.
    pub(crate) fn answer(
        self,
        py: Python<'py>,
        threads: Option<NonZeroUsize>,
        buffers: Option<Bound<'py, PyAny>>,
        report: Option<Vec<usize>>,
    ) -> PyResult<Solution<'py>> {
        let Self { mechanism, per_design, signs, order, known_signs, .. } = self;
        let [joints, links, origins, slides] = self.outputs;
        // Both are the package's own arrays, which never change.
        let (dimensions, q) = (self.dimensions.as_slice()?, self.q.as_slice()?);
        let outputs = Outputs { joints, links, origins, slides, ..Outputs::default() };
        let coordinates =
            if per_design { Coordinates::PerDesign(q) } else { Coordinates::Shared(q) };
        let request = Request { dimensions, coordinates, signs, order, outputs: &outputs };
        let shape = || request.shape(mechanism).map_err(error_map::solve);
        let [designs, positions] = catch_panic(shape)?;
        let columns = request.columns(mechanism);
        let count = designs.saturating_mul(positions);
        let (values, status): (Vec<Bound<'py, PyArray1<f64>>>, Bound<'py, PyArray1<u8>>) =
            if let Some(buffers) = &buffers {
                (buffers.getattr("arrays")?.extract()?, buffers.getattr("status")?.extract()?)
            } else {
                let mut memory = Memory::for_a_call();
                let status = memory.array::<u8>(py, count, 1)?;
                let mut array = |width| memory.array::<f64>(py, count, width);
                let width = columns.iter().map(|column| column.width).sum::<usize>();
                let bytes = count.saturating_mul(width).saturating_mul(size_of::<f64>());
                let values = if bytes < SMALL_RESULT {
                    vec![array(width)?]
                } else {
                    columns.iter().map(|column| array(column.width)).collect::<PyResult<_>>()?
                };
                (values, status)
            };
        // Two calls cannot write the same arrays at once.
        let mut borrowed = Vec::new();
        for array in &values {
            borrowed.push(array.try_readwrite().map_err(in_use)?);
        }
        let mut borrowed_status = status.try_readwrite().map_err(in_use)?;
        let arrays = Arrays {
            columns: split(&mut borrowed, &columns, count)?,
            status: as_uninitialized(&mut borrowed_status)?,
        };
        request.check_arrays(mechanism, &arrays).map_err(error_map::solve)?;
        let arrays = Mutex::new(Some(arrays));
        let small =
            is_short(mechanism, designs, positions) || is_near(mechanism, &request, designs);
        if let Some(buffers) = &buffers {
            buffers.setattr("complete", false)?;
        }
        let log = FailureLog::default();
        let failures = report.is_some().then_some(&log);
        let known_signs = known_signs.as_ref().map(|signs| &signs.get().0);
        let solved = detach::run(py, small, |cancel| {
            let cancel = Some(cancel);
            let control = Control { threads, cancel, failures, known_signs, ..Control::default() };
            let arrays = arrays.lock().ok().and_then(|mut arrays| arrays.take());
            arrays.map_or(Err(SolveError::Interrupted), |arrays| {
                fill(mechanism, &request, arrays, &control)
            })
        });
        drop(arrays);
        if let (Some(_), Err(error)) = (&buffers, &solved)
            && error::is_internal(py, error)
        {
            // The user may still hold these arrays: they must not mix two motions.
            for array in &mut borrowed {
                array.as_slice_mut()?.fill(f64::NAN);
            }
            borrowed_status.as_slice_mut()?.fill(Status::Lost as u8);
        }
        solved?.map_err(error_map::solve)?;
        if let Some(buffers) = &buffers {
            buffers.setattr("complete", true)?;
        }
        drop((borrowed, borrowed_status));
        let failure = report
            .zip(log.first())
            .map(|(shape, first)| error_map::first_failure(&first, &shape, count).into_value(py));
        Ok((values, status, failure))
    }
}

/// The columns in separate arrays, or one after another in one array.
fn split<'a>(
    arrays: &'a mut [PyReadwriteArray1<'_, f64>],
    columns: &[Column],
    count: usize,
) -> PyResult<Vec<&'a mut [MaybeUninit<f64>]>> {
    let [single] = arrays else {
        return arrays.iter_mut().map(as_uninitialized).collect();
    };
    let mut rest = as_uninitialized(single)?;
    let mut parts = Vec::with_capacity(columns.len());
    for column in columns {
        // An array that is too short is refused later, with the sizes of all.
        let (part, left) = rest.split_at_mut((count * column.width).min(rest.len()));
        parts.push(part);
        rest = left;
    }
    Ok(parts)
}

fn in_use(error: numpy::BorrowError) -> PyErr {
    error::input(&format!("out: another call is writing to its arrays ({error})"), None)
}
