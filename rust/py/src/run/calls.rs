//! Work that may call Python functions.

use pyo3::prelude::*;

use super::PythonCallbacks;
use crate::detach::catch_panic;
use crate::reserve;

/// Runs work that may call the Python functions of a machine and of events. With such functions it holds the
/// GIL throughout. Raises the exception of a signal handler, if any.
pub(crate) fn with_callbacks<T: Send>(
    py: Python<'_>,
    functions: &[Py<PyAny>],
    event_functions: Vec<Py<PyAny>>,
    work: impl FnOnce(&mut PythonCallbacks) -> T + Send,
) -> PyResult<T> {
    let functions = functions.iter().map(|function| function.clone_ref(py)).collect();
    reserve::ensure(py)?;
    let mut callbacks = PythonCallbacks::new(functions, event_functions);
    let result = catch_panic(|| {
        Ok(if callbacks.need_gil() {
            work(&mut callbacks)
        } else {
            py.detach(|| work(&mut callbacks))
        })
    })?;
    callbacks.signal.map_or(Ok(result), Err)
}
