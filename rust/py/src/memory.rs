//! The memory of results: what one call leaves when its arrays are dropped, the next one takes. New
//! pages would cost more than the numbers that are written to them.

use std::sync::Mutex;

use numpy::{Element, PyArray1, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PySlice};

/// Bytes of a cache line. As a number of extra entries it is more than enough to align an array.
const CACHE_LINE: usize = 64;
/// Bytes from which an array is worth keeping: less is reused by the allocator itself.
const WORTH_KEEPING: usize = 64 << 10;
/// Bytes below which an array is quicker made than aligned.
const FEW: usize = 16 << 10;
/// Bytes kept at most.
const MAX_KEPT: usize = 512 << 20;

/// An array that nobody uses.
struct Kept {
    bytes: usize,
    array: Py<PyAny>,
}

/// What has been dropped since the last call began. It is locked for moments only, by threads attached
/// to the interpreter: a fork finds it free.
static DROPPED: Mutex<Vec<Kept>> = Mutex::new(Vec::new());

/// The owner of an array's memory: NumPy's arrays have it as their base, and the last of them drops it.
#[pyclass(module = "assur._core", frozen)]
struct Owner {
    kept: Mutex<Option<Kept>>,
    /// Place, number of entries and their type, as NumPy describes them.
    place: usize,
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
        interface.set_item("data", (self.place, false))?;
        Ok(interface)
    }
}

impl Drop for Owner {
    fn drop(&mut self) {
        let Ok(Some(kept)) = self.kept.get_mut().map(Option::take) else { return };
        // Where another thread is at it, the memory is given back.
        let Ok(mut dropped) = DROPPED.try_lock() else { return };
        let bytes: usize = dropped.iter().map(|kept| kept.bytes).sum();
        if bytes + kept.bytes <= MAX_KEPT {
            dropped.push(kept);
        }
    }
}

/// Memory for the results of one call. What it does not use of that of the last call is given back.
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
                "the result has more numbers than can be counted: ask for fewer designs or positions",
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
        let found = self.0.iter().position(fits).map(|index| self.0.swap_remove(index).array);
        let array = match found {
            Some(array) => array.into_bound(py),
            None => py.import("numpy")?.call_method1("empty", (len, T::get_dtype(py)))?,
        };
        let array: Bound<'py, PyArray1<T>> = array.cast_into()?;
        // Rows of eight numbers are written faster if they start at a cache line.
        let first = array.data().align_offset(CACHE_LINE).min(CACHE_LINE);
        let len = len - CACHE_LINE;
        if bytes < WORTH_KEEPING {
            let aligned = PySlice::new(py, first.cast_signed(), (first + len).cast_signed(), 1);
            return Ok(array.get_item(aligned)?.cast_into()?);
        }
        let owner = Owner {
            place: array.data().addr() + first * size_of::<T>(),
            len,
            kind: T::get_dtype(py).getattr("str")?.extract()?,
            kept: Mutex::new(Some(Kept { bytes, array: array.into_any().unbind() })),
        };
        let owner = Bound::new(py, owner)?;
        Ok(py.import("numpy")?.call_method1("asarray", (owner,))?.cast_into()?)
    }
}
