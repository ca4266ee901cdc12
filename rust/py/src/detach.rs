//! Wrappers for all calls of the core: they turn a panic into an `AssurError`, release the GIL, and
//! let signals stop long work.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind, set_hook};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;
use pyo3::types::PyList;

use crate::{error, reserve};

/// Time between checks for signals.
pub(crate) const SIGNAL_INTERVAL: Duration = Duration::from_millis(50);
/// Objects of Python made between two checks, some milliseconds.
const OBJECTS_PER_CHECK: usize = 1024;
/// Length from which a list takes long enough to check for signals.
const LONG_LIST: usize = 16_384;
/// The same for items that take about a tenth of a millisecond each.
const LONG_LIST_OF_SLOW_ITEMS: usize = 512;

/// Source location of the last panic.
static LAST_PANIC: Mutex<Option<String>> = Mutex::new(None);

/// Records the location of a panic for the exception instead of printing it. The hook affects only
/// this extension module, which has its own copy of the standard library.
pub(crate) fn record_panic_locations() {
    set_hook(Box::new(|info| {
        let location = info.location().map(ToString::to_string);
        if let Ok(mut last) = LAST_PANIC.lock() {
            *last = location;
        }
    }));
}

/// Runs short work and turns a panic into an `AssurError`.
pub(crate) fn catch_panic<T>(work: impl FnOnce() -> PyResult<T>) -> PyResult<T> {
    // Unwind safety: data that a panic leaves incomplete is dropped with the closure, or marked by its
    // owner.
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| Err(panic_error(&*panic)))
}

/// Makes objects of Python. Where Python has no memory for one, `PyO3` panics; this raises `MemoryError`.
pub(crate) fn make_objects<T>(py: Python<'_>, make: impl FnOnce() -> PyResult<T>) -> PyResult<T> {
    // Unwind safety: the objects made so far are dropped with the closure.
    catch_unwind(AssertUnwindSafe(make))
        .unwrap_or_else(|_| Err(PyErr::take(py).unwrap_or_else(reserve::out_of_memory)))
}

fn panic_error(panic: &(dyn Any + Send)) -> PyErr {
    let text = panic
        .downcast_ref::<&str>()
        .map(ToString::to_string)
        .or_else(|| panic.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "unknown".into());
    let location = LAST_PANIC.lock().ok().and_then(|mut last| last.take());
    error::internal(&text, location.as_deref().unwrap_or("unknown location"))
}

/// Runs `work` without the GIL. Unless it is `small`, the calling thread checks for signals in the
/// meantime. After a signal it sets the flag, waits for `work` to return and drops its result.
pub(crate) fn run<T: Send>(
    py: Python<'_>,
    small: bool,
    work: impl Fn(&AtomicBool) -> T + Sync,
) -> PyResult<T> {
    catch_panic(|| run_unguarded(py, small, work))
}

/// Results of `item` for every index below `count`, computed as by [`run`].
pub(crate) fn map<T: Send>(
    py: Python<'_>,
    count: usize,
    item: impl Fn(usize) -> T + Sync,
) -> PyResult<Vec<T>> {
    map_list(py, count, LONG_LIST, item)
}

/// [`map`] for items that take about a tenth of a millisecond each.
pub(crate) fn map_slow<T: Send>(
    py: Python<'_>,
    count: usize,
    item: impl Fn(usize) -> T + Sync,
) -> PyResult<Vec<T>> {
    map_list(py, count, LONG_LIST_OF_SLOW_ITEMS, item)
}

fn map_list<T: Send>(
    py: Python<'_>,
    count: usize,
    long: usize,
    item: impl Fn(usize) -> T + Sync,
) -> PyResult<Vec<T>> {
    let _room = reserve::room(py, count.saturating_mul(2 * size_of::<T>()))?;
    run(py, count < long, |cancel| {
        let mut results = Vec::with_capacity(count);
        for index in 0..count {
            if cancel.load(Ordering::Relaxed) {
                break;
            }
            results.push(item(index));
        }
        results
    })
}

/// A list of Python; raises a signal that arrives while the list is made.
pub(crate) fn listed<'py, T: IntoPyObject<'py>>(
    py: Python<'py>,
    items: impl IntoIterator<Item = T>,
) -> PyResult<Bound<'py, PyList>> {
    let list = PyList::empty(py);
    for item in items {
        list.append(item)?;
        check_signals(py, list.len())?;
    }
    Ok(list)
}

/// Raises a signal that has arrived, checked at one object in many.
pub(crate) fn check_signals(py: Python<'_>, objects: usize) -> PyResult<()> {
    if objects.is_multiple_of(OBJECTS_PER_CHECK) { py.check_signals() } else { Ok(()) }
}

fn run_unguarded<T: Send>(
    py: Python<'_>,
    small: bool,
    work: impl Fn(&AtomicBool) -> T + Sync,
) -> PyResult<T> {
    reserve::ensure(py)?;
    let cancel = AtomicBool::new(false);
    let call = reserve::Call::begin(&cancel);
    let result = if small { py.detach(|| work(&cancel)) } else { in_a_thread(py, &cancel, work)? };
    call.end().map(|()| result)
}

/// Runs `work` in a separate thread, so that the calling thread can check for signals.
fn in_a_thread<T: Send>(
    py: Python<'_>,
    cancel: &AtomicBool,
    work: impl Fn(&AtomicBool) -> T + Sync,
) -> PyResult<T> {
    py.detach(|| {
        let (done, finished) = channel();
        thread::scope(|scope| {
            let job = || {
                let result = work(cancel);
                // This only wakes the caller; `join` returns the result.
                let _ = done.send(());
                result
            };
            let Ok(worker) = thread::Builder::new().spawn_scoped(scope, job) else {
                // Without a thread the work cannot be interrupted.
                return Ok(work(cancel));
            };
            let mut signal = Ok(());
            while let Err(RecvTimeoutError::Timeout) = finished.recv_timeout(SIGNAL_INTERVAL)
                && !worker.is_finished()
            {
                if signal.is_ok() {
                    #[allow(
                        clippy::redundant_closure_for_method_calls,
                        reason = "the method by itself is not general over the lifetime"
                    )]
                    let checked = Python::attach(|py| py.check_signals());
                    signal = checked;
                    if signal.is_err() {
                        cancel.store(true, Ordering::Relaxed);
                    }
                }
            }
            match worker.join() {
                Ok(result) => signal.map(|()| result),
                Err(panic) => resume_unwind(panic),
            }
        })
    })
}
