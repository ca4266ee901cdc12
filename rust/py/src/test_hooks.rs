//! A panic on purpose, for the tests alone.

use assur::test_hooks;
use pyo3::prelude::*;

/// Makes the `number`-th chunk of work from now on panic (0: none does).
#[pyfunction]
pub(crate) fn panic_in_chunk(number: usize) {
    test_hooks::panic_in_chunk(number);
}
