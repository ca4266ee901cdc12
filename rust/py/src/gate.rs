//! The gate through which every call goes: a panic becomes an `AssurError`, and long work is done
//! without the GIL and stopped by signals.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind, set_hook};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;

use crate::error;

/// How often signals are looked for.
const PATIENCE: Duration = Duration::from_millis(50);
/// Items of a list between two looks at whether the work is still wanted, and the shortest list
/// that is worth listening for signals.
const ITEMS: usize = 256;
const LONG_LIST: usize = 16_384;

/// Where the last panic was.
static PLACE: Mutex<Option<String>> = Mutex::new(None);

/// Keeps the place of a panic for the exception instead of printing it. (The hook is that of this
/// extension module alone, as its standard library is.)
pub(crate) fn keep_places_of_panics() {
    set_hook(Box::new(|info| {
        let place = info.location().map(ToString::to_string);
        if let Ok(mut last) = PLACE.lock() {
            *last = place;
        }
    }));
}

/// Does short work; a panic of it becomes an `AssurError`.
pub(crate) fn guard<T>(work: impl FnOnce() -> PyResult<T>) -> PyResult<T> {
    // What a panic leaves half done is dropped with the closure, or marked by whoever shares it.
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| Err(panicked(&*panic)))
}

fn panicked(panic: &(dyn Any + Send)) -> PyErr {
    let text = panic
        .downcast_ref::<&str>()
        .map(ToString::to_string)
        .or_else(|| panic.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "unknown".into());
    let place = PLACE.lock().ok().and_then(|mut last| last.take());
    error::internal(&text, place.as_deref().unwrap_or("unknown place"))
}

/// Runs `work` detached. Unless it is small the calling thread listens for signals meanwhile; after
/// one, `work` sees the flag, is waited for, and its result is dropped.
pub(crate) fn run<T: Send>(
    py: Python<'_>,
    small: bool,
    work: impl Fn(&AtomicBool) -> T + Sync,
) -> PyResult<T> {
    guard(|| run_unguarded(py, small, work))
}

/// A list of results of items that are independent, as by [`run`].
pub(crate) fn each<T: Send>(
    py: Python<'_>,
    count: usize,
    one: impl Fn(usize) -> T + Sync,
) -> PyResult<Vec<T>> {
    run(py, count < LONG_LIST, |cancel| {
        let mut all = Vec::with_capacity(count);
        for index in 0..count {
            if index.is_multiple_of(ITEMS) && cancel.load(Ordering::Relaxed) {
                break;
            }
            all.push(one(index));
        }
        all
    })
}

fn run_unguarded<T: Send>(
    py: Python<'_>,
    small: bool,
    work: impl Fn(&AtomicBool) -> T + Sync,
) -> PyResult<T> {
    let cancel = AtomicBool::new(false);
    if small {
        return Ok(py.detach(|| work(&cancel)));
    }
    py.detach(|| {
        let (done, finished) = channel();
        thread::scope(|scope| {
            let job = || {
                let result = work(&cancel);
                // Only wakes the caller; the result itself is taken by `join`.
                let _ = done.send(());
                result
            };
            let Ok(worker) = thread::Builder::new().spawn_scoped(scope, job) else {
                // The system gives no thread: not to be interrupted then.
                return Ok(work(&cancel));
            };
            let mut signal = Ok(());
            while let Err(RecvTimeoutError::Timeout) = finished.recv_timeout(PATIENCE)
                && !worker.is_finished()
            {
                if signal.is_ok() {
                    #[allow(
                        clippy::redundant_closure_for_method_calls,
                        reason = "the method by itself is not general over the lifetime"
                    )]
                    let heard = Python::attach(|py| py.check_signals());
                    signal = heard;
                    cancel.store(signal.is_err(), Ordering::Relaxed);
                }
            }
            match worker.join() {
                Ok(result) => signal.map(|()| result),
                Err(panic) => resume_unwind(panic),
            }
        })
    })
}
