//! What a batch remembers of its designs.

use pyo3::prelude::*;

/// What solving a batch of designs has found out about them, for later calls with the same
/// dimensions and assembly; several calls may use it at once.
#[pyclass(module = "assur._core", frozen)]
pub(crate) struct KnownSigns(pub(crate) assur::KnownSigns);

#[pymethods]
impl KnownSigns {
    #[new]
    fn new(designs: usize) -> Self {
        Self(assur::KnownSigns::new(designs))
    }
}
