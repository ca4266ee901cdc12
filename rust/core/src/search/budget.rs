//! How long a search may go on.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// A limit in time, in evaluations, or both. A search that is limited in evaluations alone has the same result on
/// every machine and on any number of threads.
#[derive(Debug, Clone, Copy)]
pub(super) struct Budget<'a> {
    started: Instant,
    time: Option<Duration>,
    evaluations: Option<u64>,
    cancel: Option<&'a AtomicBool>,
}

impl<'a> Budget<'a> {
    pub(super) fn new(
        time: Option<Duration>,
        evaluations: Option<u64>,
        cancel: Option<&'a AtomicBool>,
    ) -> Self {
        Self { started: Instant::now(), time, evaluations, cancel }
    }

    /// Time since it was made.
    pub(super) fn elapsed(&self) -> Duration {
        self.started.elapsed()
    }

    /// Whether the caller has cancelled.
    pub(super) fn is_cancelled(&self) -> bool {
        self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed))
    }

    /// The part of the time that has passed.
    pub(super) fn part_used(&self) -> f64 {
        self.time.map_or(0.0, |time| self.elapsed().as_secs_f64() / time.as_secs_f64())
    }

    /// Whether these parts of it are used up, of the time and of the evaluations of a number that share them.
    pub(super) fn is_used(&self, parts: [f64; 2], evaluations: u64, sharing: u64) -> bool {
        let is_late = self.time.is_some() && self.part_used() >= parts[0];
        let share = |total: u64| total as f64 * parts[1] / sharing as f64;
        let is_spent = self.evaluations.is_some_and(|total| evaluations as f64 >= share(total));
        is_late || is_spent || self.is_cancelled()
    }
}
