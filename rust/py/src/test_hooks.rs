//! A deliberate panic, and threads for small work too, for tests only.

use assur::test_hooks;
use pyo3::prelude::*;

/// Makes the `number`-th chunk of work from now panic; 0 turns this off.
#[pyfunction]
pub(crate) fn panic_in_chunk(number: usize) {
    test_hooks::panic_in_chunk(number);
}

/// Makes calls start their threads at once, even for little work.
#[pyfunction]
pub(crate) fn start_threads_at_once(at_once: bool) {
    test_hooks::start_threads_at_once(at_once);
}
