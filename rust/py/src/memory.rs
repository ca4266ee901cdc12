//! The memory of results: arrays dropped since the last call are reused by the next. New pages would
//! take longer than writing the numbers.

use std::mem::MaybeUninit;
use std::num::NonZeroUsize;
use std::sync::Mutex;

use assur::{Arrays, Control, FailureLog, SolveError};
use numpy::{Element, PyArray1, PyArrayMethods, PyReadwriteArray1, PyUntypedArrayMethods};
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PySlice};

use crate::{detach, error, error_map};

/// Bytes of a cache line. The same number of extra entries is more than enough to align an array.
const CACHE_LINE: usize = 64;
/// Smallest array to keep, in bytes: the allocator itself reuses smaller ones.
const WORTH_KEEPING: usize = 64 << 10;
/// Bytes below which allocating an array is quicker than aligning it.
const FEW: usize = 16 << 10;
/// Most bytes kept.
const MAX_KEPT: usize = 512 << 20;

/// A dropped array.
struct Kept {
    bytes: usize,
    array: Py<PyAny>,
}

/// Arrays dropped since the last call began. Only threads that hold the interpreter lock this, and
/// only for moments, so it is free in a forked process.
static DROPPED: Mutex<Vec<Kept>> = Mutex::new(Vec::new());

/// The owner of an array's memory: the base of NumPy's arrays, dropped with the last of them.
#[pyclass(module = "assur._core", frozen)]
struct Owner {
    kept: Mutex<Option<Kept>>,
    /// Address, number of entries and their type, as NumPy describes them.
    address: usize,
    len: usize,
    kind: String,
}

#[pymethods]
impl Owner {
    #[getter(__array_interface__)]
    fn array_interface<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let interface = PyDict::new(py);
        interface.set_item("version", 3)?;
        interface.set_item("shape", (self.len,))?;
        interface.set_item("typestr", &self.kind)?;
        interface.set_item("data", (self.address, false))?;
        Ok(interface)
    }
}

impl Drop for Owner {
    fn drop(&mut self) {
        let Ok(Some(kept)) = self.kept.get_mut().map(Option::take) else { return };
        // If another thread holds the lock, the memory is freed.
        let Ok(mut dropped) = DROPPED.try_lock() else { return };
        let bytes: usize = dropped.iter().map(|kept| kept.bytes).sum();
        if bytes + kept.bytes <= MAX_KEPT {
            dropped.push(kept);
        }
    }
}

/// Memory for the results of one call: the arrays dropped since the last one. Arrays that the call does not
/// reuse are freed.
pub(crate) struct Memory(Vec<Kept>);

impl Memory {
    pub(crate) fn for_a_call() -> Self {
        Self(DROPPED.try_lock().map_or_else(|_| Vec::new(), |mut kept| std::mem::take(&mut *kept)))
    }

    /// An array that is not initialised; `MemoryError` if it does not fit in memory.
    pub(crate) fn array<'py, T: Element>(
        &mut self,
        py: Python<'py>,
        rows: usize,
        width: usize,
    ) -> PyResult<Bound<'py, PyArray1<T>>> {
        let too_many = || {
            PyMemoryError::new_err(
                "the result has more numbers than an array can hold: ask for fewer designs or positions",
            )
        };
        let len = rows.checked_mul(width).and_then(|len| len.checked_add(CACHE_LINE));
        let len = len.ok_or_else(too_many)?;
        let bytes = len.checked_mul(size_of::<T>()).ok_or_else(too_many)?;
        if bytes < FEW {
            return Ok(PyArray1::zeros(py, len - CACHE_LINE, false));
        }
        let fits = |kept: &Kept| {
            let array = kept.array.bind(py).cast::<PyArray1<T>>();
            kept.bytes == bytes && array.is_ok_and(|array| array.len() == len)
        };
        let reused = self.0.iter().position(fits).map(|index| self.0.swap_remove(index).array);
        let array = match reused {
            Some(array) => array.into_bound(py),
            None => py.import("numpy")?.call_method1("empty", (len, T::get_dtype(py)))?,
        };
        let array: Bound<'py, PyArray1<T>> = array.cast_into()?;
        // Blocks of eight numbers are written faster if they start at a cache line.
        let first = array.data().align_offset(CACHE_LINE).min(CACHE_LINE);
        let len = len - CACHE_LINE;
        if bytes < WORTH_KEEPING {
            let aligned = PySlice::new(py, first.cast_signed(), (first + len).cast_signed(), 1);
            return Ok(array.get_item(aligned)?.cast_into()?);
        }
        let owner = Owner {
            address: array.data().addr() + first * size_of::<T>(),
            len,
            kind: T::get_dtype(py).getattr("str")?.extract()?,
            kept: Mutex::new(Some(Kept { bytes, array: array.into_any().unbind() })),
        };
        let owner = Bound::new(py, owner)?;
        Ok(py.import("numpy")?.call_method1("asarray", (owner,))?.cast_into()?)
    }
}

/// The arrays of a result, the statuses, and the positions that failed.
pub(crate) type Filled<'py> =
    (Vec<Bound<'py, PyArray1<f64>>>, Bound<'py, PyArray1<u8>>, FailureLog);

/// New arrays with rows of these widths, and statuses, that the core fills without the GIL.
pub(crate) fn filled(
    py: Python<'_>,
    rows: usize,
    widths: impl IntoIterator<Item = usize>,
    is_short: bool,
    threads: Option<NonZeroUsize>,
    fill: impl Fn(Arrays<'_>, &Control<'_>) -> Result<(), SolveError> + Sync,
) -> PyResult<Filled<'_>> {
    let mut memory = Memory::for_a_call();
    let status = memory.array::<u8>(py, rows, 1)?;
    let values = widths
        .into_iter()
        .map(|width| memory.array::<f64>(py, rows, width))
        .collect::<PyResult<Vec<_>>>()?;
    let mut borrowed: Vec<_> = values.iter().map(PyArrayMethods::readwrite).collect();
    let mut borrowed_status = status.readwrite();
    let arrays = Arrays {
        columns: borrowed.iter_mut().map(as_uninitialized).collect::<PyResult<_>>()?,
        status: as_uninitialized(&mut borrowed_status)?,
    };
    let arrays = Mutex::new(Some(arrays));
    let log = FailureLog::default();
    let done = detach::run(py, is_short, |cancel| {
        let control =
            Control { threads, cancel: Some(cancel), failures: Some(&log), ..Control::default() };
        let arrays = arrays.lock().ok().and_then(|mut arrays| arrays.take());
        arrays.map_or(Err(SolveError::Interrupted), |arrays| fill(arrays, &control))
    });
    drop(arrays);
    done?.map_err(error_map::solve)?;
    drop((borrowed, borrowed_status));
    Ok((values, status, log))
}

/// The memory of an array borrowed for writing.
pub(crate) fn as_uninitialized<'a, T: Element>(
    array: &'a mut PyReadwriteArray1<'_, T>,
) -> PyResult<&'a mut [MaybeUninit<T>]> {
    let data: *mut T = array.data();
    if !(array.is_c_contiguous() && data.is_aligned()) {
        let message = "out: its arrays are not contiguous; pass a motion as solve returned it";
        return Err(error::input(message, None));
    }
    #[allow(unsafe_code, reason = "NumPy has no type for uninitialised entries")]
    // SAFETY: the array is one-dimensional, contiguous and aligned (checked above) and has this
    // length; the exclusive borrow excludes other calls. `fill` writes every entry, or no code reads
    // them: new arrays are dropped, and those of a motion are marked as incomplete.
    let slice = unsafe { std::slice::from_raw_parts_mut(data.cast(), array.len()) };
    Ok(slice)
}
