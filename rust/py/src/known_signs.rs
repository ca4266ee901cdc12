//! What a batch remembers of its designs.

use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;

/// What solving a batch of designs has found out about them, for later calls with the same
/// dimensions and assembly; several calls may use it at once.
#[pyclass(module = "assur._core", frozen)]
pub(crate) struct KnownSigns(pub(crate) assur::KnownSigns);

#[pymethods]
impl KnownSigns {
    #[new]
    fn new(designs: usize) -> PyResult<Self> {
        let known = assur::KnownSigns::new(designs);
        known.map(Self).map_err(|_| {
            PyMemoryError::new_err(format!("no memory for what is known of {designs} designs"))
        })
    }
}
