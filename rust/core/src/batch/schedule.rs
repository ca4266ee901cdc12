//! Runs threads that take one chunk of the work after another.

use std::num::NonZeroUsize;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{LazyLock, Mutex, OnceLock};
use std::thread;
use std::time::{Duration, Instant};

use super::chunks::{Chunk, Chunks};
use super::failure_log::FailureLog;
use super::helpers::{available_threads, work_with_helpers};
use super::known_signs::KnownSigns;
use super::rows::RowSlices;
use crate::description::error::SolveError;
use crate::math::simd::Simd;

/// The first chunks are this many times shorter. They show how long the work will take.
const TRIAL_PART: usize = 8;
/// Least time of this trial: the first positions find the caches cold.
const TRIAL: Duration = Duration::from_micros(50);
/// Work from which other threads pay off: 5 000 accelerations of a five-bar take 190 µs on one thread and 265 on
/// two, 10 000 of them 350 and 280.
const WORTH_THREADS: Duration = Duration::from_micros(250);
/// Work for which new threads are started. Beside a thread that is itself new, the scheduler may keep one that has
/// waited behind it: 30 000 accelerations took 1120 µs in place of 780.
const LONG_WORK: Duration = Duration::from_micros(700);

/// The positions and designs that take the checked path. Results are the same with any choice; tests
/// compare the paths.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Checks {
    /// Those that need it.
    Needed,
    /// Every position, each solved alone.
    Always,
    /// The same, with every branch traced knot by knot.
    KnotByKnot,
}

impl Checks {
    /// The choice of the environment variable `ASSUR_CARE`: `always`, `knots`, or anything else for
    /// [`Checks::Needed`]. The variable is read once.
    #[must_use]
    pub fn from_env() -> Self {
        static FROM_ENV: LazyLock<Checks> =
            LazyLock::new(|| match std::env::var("ASSUR_CARE").as_deref() {
                Ok("always") => Checks::Always,
                Ok("knots") => Checks::KnotByKnot,
                _ => Checks::Needed,
            });
        *FROM_ENV
    }
}

/// How to do the work: threads, vector instructions and cancellation.
#[derive(Debug, Clone, Copy)]
pub struct Control<'a> {
    /// Most threads; `None` means one per core. Small work is done by one thread.
    pub threads: Option<NonZeroUsize>,
    /// Highest level of vector instructions to use.
    pub simd: Simd,
    /// The positions that take the checked path.
    pub checks: Checks,
    /// Setting it to true stops the work after the blocks in progress.
    pub cancel: Option<&'a AtomicBool>,
    /// Where to record the first position that fails.
    pub failures: Option<&'a FailureLog>,
    /// Designs that earlier calls found to have constant signs, in the same assembly.
    pub known_signs: Option<&'a KnownSigns>,
}

impl Default for Control<'_> {
    fn default() -> Self {
        Self {
            threads: None,
            simd: Simd::default(),
            checks: Checks::from_env(),
            cancel: None,
            failures: None,
            known_signs: None,
        }
    }
}

/// Makes the other workers stop when one panics.
struct PanicFlag<'a>(&'a AtomicBool);

impl Drop for PanicFlag<'_> {
    fn drop(&mut self) {
        if thread::panicking() {
            self.0.store(true, Ordering::Relaxed);
        }
    }
}

impl Control<'_> {
    /// Whether the caller has cancelled the work.
    pub(crate) fn is_cancelled(&self) -> bool {
        self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed))
    }

    /// Runs all chunks. Each thread makes its own worker and finishes it after its last chunk.
    ///
    /// This thread begins alone; others join in when the rest takes so long that they help: those that
    /// [wait for work](super::helpers), or new ones.
    pub(crate) fn run<W>(
        &self,
        chunks: Chunks<'_>,
        worker: impl Fn() -> W + Sync,
        work: impl Fn(&mut W, &Chunk, RowSlices<'_>) + Sync,
        finish: impl Fn(W) + Sync,
    ) -> Result<(), SolveError> {
        let threads = self.most_threads(chunks.count());
        let queue = Queue::new(chunks, threads > 1);
        let panicked = AtomicBool::new(false);
        let work_while = |goes_on: &dyn Fn() -> bool| {
            let panic_flag = PanicFlag(&panicked);
            let mut worker = worker();
            while !self.is_cancelled() && !panicked.load(Ordering::Relaxed) && goes_on() {
                let Some((chunk, rows)) = queue.take() else { break };
                #[cfg(feature = "test-hooks")]
                super::test_hooks::before_chunk();
                work(&mut worker, &chunk, rows);
            }
            drop(panic_flag);
            finish(worker);
        };
        work_while(&|| threads == 1 || queue.ends_soon());
        let threads = queue.end_trial(threads);
        if threads > 0 && !self.is_cancelled() {
            let work_until_done = || work_while(&|| true);
            let is_long = queue.rest() > LONG_WORK.as_secs_f64();
            if is_long || !work_with_helpers(threads - 1, &work_until_done) {
                on_new_threads(threads, work_until_done);
            }
        }
        if self.is_cancelled() { Err(SolveError::Interrupted) } else { Ok(()) }
    }

    /// Most threads for a number of chunks.
    fn most_threads(&self, chunks: usize) -> usize {
        match self.threads {
            _ if chunks <= 1 => 1,
            Some(threads) => threads.get().min(chunks),
            None => available_threads().min(chunks),
        }
    }
}

/// Does the same on some new threads.
fn on_new_threads(count: usize, work: impl Fn() + Copy + Send + Sync) {
    thread::scope(|scope| {
        // The calling thread only waits: if it worked too, the scheduler could keep a new
        // thread queued behind it for a millisecond while another core is idle.
        let workers: Vec<_> = (0..count)
            .map_while(|_| thread::Builder::new().spawn_scoped(scope, work).ok())
            .collect();
        // If the system refuses a thread, this one helps.
        if workers.len() < count {
            work();
        }
        for worker in workers {
            if let Err(panic) = worker.join() {
                resume_unwind(panic);
            }
        }
    });
}

/// The chunks that the threads of a call share.
struct Queue<'a> {
    chunks: Mutex<Chunks<'a>>,
    rows: usize,
    started: OnceLock<Instant>,
    /// Sizes of chunks after the trial.
    sizes: [usize; 2],
}

impl<'a> Queue<'a> {
    /// `with_trial`: the first chunks are short.
    fn new(mut chunks: Chunks<'a>, with_trial: bool) -> Self {
        let sizes = [chunks.size, chunks.max_designs];
        if with_trial {
            [chunks.size, chunks.max_designs] = sizes.map(|size| (size / TRIAL_PART).max(1));
        }
        Self { rows: chunks.left(), started: OnceLock::new(), chunks: Mutex::new(chunks), sizes }
    }

    /// The lock is not held during the work, so a panic does not poison it.
    fn with<T>(&self, access: impl FnOnce(&mut Chunks<'a>) -> T) -> Option<T> {
        self.chunks.lock().ok().map(|mut chunks| access(&mut chunks))
    }

    fn take(&self) -> Option<(Chunk, RowSlices<'a>)> {
        self.with(Chunks::take).flatten()
    }

    /// Whether one thread will have done the rest before others would help, judged by its time since the
    /// first call.
    fn ends_soon(&self) -> bool {
        #[cfg(feature = "test-hooks")]
        if super::test_hooks::threads_start_at_once() {
            return false;
        }
        if self.started.get_or_init(Instant::now).elapsed() < TRIAL {
            return true;
        }
        let ends_soon = self.rest() < WORTH_THREADS.as_secs_f64();
        if ends_soon {
            self.end_trial(1);
        }
        ends_soon
    }

    /// How long one thread would take for the rest, s.
    fn rest(&self) -> f64 {
        let elapsed = self.started.get_or_init(Instant::now).elapsed();
        let left = self.with(|chunks| chunks.left()).unwrap_or(0);
        elapsed.as_secs_f64() * left as f64 / (self.rows - left) as f64
    }

    /// Makes the chunks long; returns the number of threads that they serve.
    fn end_trial(&self, threads: usize) -> usize {
        self.with(|chunks| {
            [chunks.size, chunks.max_designs] = self.sizes;
            threads.min(chunks.count())
        })
        .unwrap_or(0)
    }
}
