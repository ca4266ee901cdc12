//! Which designs of a batch have constant signs, kept between calls.

use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;

/// The designs of a batch that earlier calls found to have constant signs, for later calls with the
/// same dimensions and assembly; several calls may share it.
#[pyclass(module = "assur._core", frozen)]
pub(crate) struct KnownSigns(pub(crate) assur::KnownSigns);

#[pymethods]
impl KnownSigns {
    #[new]
    fn new(designs: usize) -> PyResult<Self> {
        let known = assur::KnownSigns::new(designs);
        known.map(Self).map_err(|_| {
            PyMemoryError::new_err(format!(
                "out of memory: one byte for each of {designs} designs is needed"
            ))
        })
    }
}
