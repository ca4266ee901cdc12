//! A deliberate panic, for tests only.

use assur::test_hooks;
use pyo3::prelude::*;

/// Makes the `number`-th chunk of work from now on panic; 0 turns this off.
#[pyfunction]
pub(crate) fn panic_in_chunk(number: usize) {
    test_hooks::panic_in_chunk(number);
}
