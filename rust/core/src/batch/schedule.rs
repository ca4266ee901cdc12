//! Cuts the work into chunks and runs threads that take one chunk after another.

use std::num::NonZeroUsize;
use std::ops::Range;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{LazyLock, Mutex};
use std::thread;

use super::failure_log::FailureLog;
use super::known_signs::KnownSigns;
use super::outputs::{Arrays, Column};
use super::writer::RowSlices;
use crate::description::error::SolveError;
use crate::math::simd::Simd;

/// Positions per chunk: some hundred microseconds of work, so that tracing the branch and taking
/// the chunk from the queue cost little.
const CHUNK: usize = 8192;
/// The same with at least [`MANY_DESIGNS`]: a longer chunk loads the shared coordinates and their
/// unit vectors once for all its designs, as long as they fit in a cache.
const CHUNK_OF_MANY_DESIGNS: usize = 65_536;
/// With so many designs all threads have work even if each design is one chunk.
const MANY_DESIGNS: usize = 64;
/// The same with several drivers, where each position needs a branch of its own.
const CHUNK_SEVERAL_DRIVERS: usize = 8;
/// Largest number of designs per chunk: tracing the branch of one may take a millisecond.
const MAX_DESIGNS: usize = 128;
/// Numbers in a result that no cache holds: 32 MiB.
const BEYOND_CACHES: usize = 4 << 20;

/// Which positions and designs take the careful path. Results are the same with any choice; tests
/// compare the paths.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Care {
    /// Those that need it.
    Needed,
    /// Every position, each solved alone.
    Always,
    /// The same, with every branch traced knot by knot.
    KnotByKnot,
}

impl Care {
    /// The choice of the environment variable `ASSUR_CARE`: `always`, `knots`, or anything else for
    /// [`Care::Needed`]. The variable is read once.
    #[must_use]
    pub fn from_env() -> Self {
        static FROM_ENV: LazyLock<Care> =
            LazyLock::new(|| match std::env::var("ASSUR_CARE").as_deref() {
                Ok("always") => Care::Always,
                Ok("knots") => Care::KnotByKnot,
                _ => Care::Needed,
            });
        *FROM_ENV
    }
}

/// How to do the work: threads, vector instructions and cancellation.
#[derive(Debug, Clone, Copy)]
pub struct Control<'a> {
    /// Number of threads; `None` uses one per core, or a single thread for small work.
    pub threads: Option<NonZeroUsize>,
    /// Highest level of vector instructions to use.
    pub simd: Simd,
    /// Which positions take the careful path.
    pub care: Care,
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
            care: Care::from_env(),
            cancel: None,
            failures: None,
            known_signs: None,
        }
    }
}

/// A range of positions of a range of designs.
#[derive(Debug, Clone)]
pub(crate) struct Chunk {
    pub designs: Range<usize>,
    pub positions: Range<usize>,
}

/// The chunks still to do, with the rows to write. After an interruption the rest stays unwritten:
/// nobody may read it, and filling it would take as long as solving.
pub(crate) struct Chunks<'a> {
    rest: Arrays<'a>,
    columns: &'a [Column],
    designs: usize,
    positions: usize,
    next: (usize, usize),
    size: usize,
    past_caches: bool,
}

impl<'a> Chunks<'a> {
    pub(crate) fn new(
        arrays: Arrays<'a>,
        columns: &'a [Column],
        [designs, positions]: [usize; 2],
        drivers: usize,
    ) -> Self {
        let size = match drivers {
            1 if designs >= MANY_DESIGNS => positions.clamp(CHUNK, CHUNK_OF_MANY_DESIGNS),
            1 => CHUNK,
            _ => CHUNK_SEVERAL_DRIVERS,
        };
        let numbers: usize = arrays.columns.iter().map(|column| column.len()).sum();
        let past_caches = numbers >= BEYOND_CACHES;
        Self { rest: arrays, columns, designs, positions, next: (0, 0), size, past_caches }
    }

    /// Number of chunks.
    fn count(&self) -> usize {
        if self.positions == 0 {
            0
        } else if self.positions >= self.size {
            self.designs * self.positions.div_ceil(self.size)
        } else {
            self.designs.div_ceil(self.designs_per_chunk())
        }
    }

    /// Designs per chunk when each has all its positions in the chunk.
    fn designs_per_chunk(&self) -> usize {
        (self.size / self.positions).min(MAX_DESIGNS)
    }

    fn take(&mut self) -> Option<(Chunk, RowSlices<'a>)> {
        let (design, position) = self.next;
        if design == self.designs || self.positions == 0 {
            return None;
        }
        let chunk = if self.positions >= self.size {
            let end = (position + self.size).min(self.positions);
            self.next = if end == self.positions { (design + 1, 0) } else { (design, end) };
            Chunk { designs: design..design + 1, positions: position..end }
        } else {
            let end = (design + self.designs_per_chunk()).min(self.designs);
            self.next = (end, 0);
            Chunk { designs: design..end, positions: 0..self.positions }
        };
        let rows = self.take_rows(chunk.designs.len() * chunk.positions.len());
        Some((chunk, rows))
    }

    fn take_rows(&mut self, rows: usize) -> RowSlices<'a> {
        let columns = self.rest.columns.iter_mut().zip(self.columns);
        RowSlices {
            columns: columns.map(|(all, column)| split_front(all, rows * column.width)).collect(),
            status: split_front(&mut self.rest.status, rows),
            past_caches: self.past_caches,
        }
    }
}

/// Splits the first `count` elements off a slice.
#[allow(clippy::mut_mut, reason = "the slice itself is moved on")]
fn split_front<'a, T>(all: &mut &'a mut [T], count: usize) -> &'a mut [T] {
    let (front, rest) = std::mem::take(all).split_at_mut(count);
    *all = rest;
    front
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
    /// The threads live only during the call: starting them costs some ten microseconds, and no
    /// idle thread is left that a fork of the process could break.
    pub(crate) fn run<W>(
        &self,
        chunks: Chunks<'_>,
        worker: impl Fn() -> W + Sync,
        work: impl Fn(&mut W, &Chunk, RowSlices<'_>) + Sync,
        finish: impl Fn(W) + Sync,
    ) -> Result<(), SolveError> {
        let count = chunks.count();
        let threads = match self.threads {
            // Asking the system for the number of cores takes longer than small work.
            _ if count <= 1 => 1,
            Some(threads) => threads.get().min(count),
            None => thread::available_parallelism().map_or(1, NonZeroUsize::get).min(count),
        };
        let queue = Mutex::new(chunks);
        let panicked = AtomicBool::new(false);
        let work_until_done = || {
            let panic_flag = PanicFlag(&panicked);
            let mut worker = worker();
            while !self.is_cancelled() && !panicked.load(Ordering::Relaxed) {
                // The lock is not held during the work, so a panic does not poison it.
                let next = queue.lock().ok().and_then(|mut queue| queue.take());
                let Some((chunk, rows)) = next else { break };
                #[cfg(feature = "test-hooks")]
                super::test_hooks::before_chunk();
                work(&mut worker, &chunk, rows);
            }
            drop(panic_flag);
            finish(worker);
        };
        if threads == 1 {
            work_until_done();
        } else {
            thread::scope(|scope| {
                // The calling thread only waits: if it worked too, the scheduler could keep a new
                // thread queued behind it for a millisecond while another core is idle.
                let others: Vec<_> = (0..threads)
                    .map_while(|_| thread::Builder::new().spawn_scoped(scope, work_until_done).ok())
                    .collect();
                // If the system refuses a thread, this one helps.
                if others.len() < threads {
                    work_until_done();
                }
                for other in others {
                    if let Err(panic) = other.join() {
                        resume_unwind(panic);
                    }
                }
            });
        }
        if self.is_cancelled() { Err(SolveError::Interrupted) } else { Ok(()) }
    }
}
