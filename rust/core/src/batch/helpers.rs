//! Threads that wait for work between calls: to wake one takes a quarter of the time that a new one takes to start,
//! and the system gives it an idle core at once.
//!
//! A fork copies none of them. In the child, the process has another number: then new ones are started.

use std::any::Any;
use std::num::NonZeroUsize;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::process;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Mutex, OnceLock, TryLockError};
use std::thread;

/// A call's work, which borrows from that call.
type Work<'w> = dyn Fn() + Sync + 'w;
/// What became of it: a panic, if there was one.
type Outcome = Result<(), Box<dyn Any + Send>>;

/// Work for a helper, and where it says that it is done.
struct Job {
    work: &'static Work<'static>,
    done: Sender<Outcome>,
}

/// The helpers of a process.
struct Helpers {
    process: u32,
    jobs: Vec<Sender<Job>>,
}

static HELPERS: Mutex<Option<Helpers>> = Mutex::new(None);

/// Does the work on this thread and on `others` that were waiting. `false` if they are busy with another call, the
/// system refuses them, or so many do not wait: then nothing was done.
pub(super) fn work_with_helpers(others: usize, work: &Work<'_>) -> bool {
    if others >= available_threads() {
        return false;
    }
    let mut helpers = match HELPERS.try_lock() {
        Ok(helpers) => helpers,
        // A panic of a call before: the helpers go on.
        Err(TryLockError::Poisoned(helpers)) => helpers.into_inner(),
        Err(TryLockError::WouldBlock) => return false,
    };
    let Some(jobs) = waiting(&mut helpers, others) else { return false };
    let (done, outcomes) = channel();
    // SAFETY: the work is used only by jobs, and `AllDone` waits for the end of each job that was sent
    // before this function returns or unwinds.
    #[allow(unsafe_code, reason = "threads that outlive the call work for it")]
    let work_for_helpers =
        unsafe { std::mem::transmute::<&Work<'_>, &'static Work<'static>>(work) };
    let mut all_done = AllDone { outcomes, running: 0, panic: None };
    for job in jobs {
        let is_sent = job.send(Job { work: work_for_helpers, done: done.clone() }).is_ok();
        all_done.running += usize::from(is_sent);
    }
    work();
    all_done.wait();
    if let Some(panic) = all_done.panic.take() {
        resume_unwind(panic);
    }
    true
}

/// Waits for all helpers, also if this thread panics.
struct AllDone {
    outcomes: Receiver<Outcome>,
    running: usize,
    panic: Option<Box<dyn Any + Send>>,
}

impl AllDone {
    fn wait(&mut self) {
        while self.running > 0 {
            // A helper sends its outcome whatever becomes of the work.
            let Ok(outcome) = self.outcomes.recv() else { return };
            self.running -= 1;
            if let Err(panic) = outcome {
                self.panic = Some(panic);
            }
        }
    }
}

impl Drop for AllDone {
    fn drop(&mut self) {
        self.wait();
    }
}

/// The number of threads that the system runs at once, read only once: that takes 45 µs, as long as
/// solving a hundred designs.
#[must_use]
pub fn available_threads() -> usize {
    static AVAILABLE: OnceLock<usize> = OnceLock::new();
    *AVAILABLE.get_or_init(|| thread::available_parallelism().map_or(1, NonZeroUsize::get))
}

/// So many helpers, started where they are missing. `None` if the system refuses one.
fn waiting(helpers: &mut Option<Helpers>, count: usize) -> Option<&[Sender<Job>]> {
    let process = process::id();
    if helpers.as_ref().is_none_or(|helpers| helpers.process != process) {
        // Those of the parent are not dropped: their channels are in whatever state the fork found them.
        std::mem::forget(helpers.replace(Helpers { process, jobs: vec![] }));
    }
    let jobs = &mut helpers.as_mut()?.jobs;
    while jobs.len() < count {
        let (job, received) = channel();
        thread::Builder::new().name("assur".into()).spawn(move || help(&received)).ok()?;
        jobs.push(job);
    }
    Some(&jobs[..count])
}

/// Does one job after another.
fn help(jobs: &Receiver<Job>) {
    for Job { work, done } in jobs {
        // Unwind safety: the caller's data are dropped when the panic goes on there.
        let outcome = catch_unwind(AssertUnwindSafe(work));
        let _ = done.send(outcome);
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    #[test]
    fn helpers_work_for_many_calls() {
        let mut helped = 0;
        for _ in 0..200 {
            let count = AtomicUsize::new(0);
            let work = || {
                count.fetch_add(1, Ordering::Relaxed);
            };
            if available_threads() > 1 && work_with_helpers(1, &work) {
                assert_eq!(count.into_inner(), 2);
                helped += 1;
            }
        }
        assert!(helped > 0 || available_threads() == 1);
    }

    #[test]
    fn a_panic_of_a_helper_reaches_the_caller_after_all_are_done() {
        let caller = thread::current().id();
        let fails = || assert_eq!(thread::current().id(), caller, "on purpose");
        let outcome = catch_unwind(|| {
            // Busy with the other test, they refuse.
            while available_threads() > 1 && !work_with_helpers(1, &fails) {
                thread::yield_now();
            }
        });
        assert_eq!(outcome.is_err(), available_threads() > 1);
    }
}
