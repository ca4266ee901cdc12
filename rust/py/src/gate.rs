//! The one gate through which long work goes: without the GIL, and Ctrl-C is heard.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;

/// How often signals are looked for.
const PATIENCE: Duration = Duration::from_millis(50);

/// Runs `work` detached. Unless it is small the calling thread listens for signals
/// meanwhile; after one `work` is told to stop, waited for, and its result dropped.
pub(crate) fn run<T: Send>(
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
                Err(panic) => std::panic::resume_unwind(panic),
            }
        })
    })
}
