//! The first failure of a batch, recorded while it is solved.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::query::failure::Failure;

/// The failure with the lowest row (designs, then positions) of a batch, and the number of all.
#[derive(Debug)]
pub struct FailureLog {
    first: Mutex<Option<(usize, Failure)>>,
    /// The row of `first`; `usize::MAX` without a failure.
    row: AtomicUsize,
    count: AtomicUsize,
}

impl Default for FailureLog {
    fn default() -> Self {
        let row = AtomicUsize::new(usize::MAX);
        Self { first: Mutex::default(), row, count: AtomicUsize::default() }
    }
}

/// The first failure of a batch.
#[derive(Debug, Clone, PartialEq)]
pub struct FirstFailure {
    /// Its row: design times positions, plus position.
    pub row: usize,
    /// The failure.
    pub failure: Failure,
    /// Number of all failures of the batch.
    pub count: usize,
}

impl FailureLog {
    /// Counts `count` failures from `row` on; describes the first unless an earlier one is known.
    fn record(&self, row: usize, count: usize, describe: impl FnOnce() -> Failure) {
        self.count.fetch_add(count, Ordering::Relaxed);
        let Ok(mut first) = self.first.lock() else { return };
        if first.as_ref().is_none_or(|&(known_row, _)| row < known_row) {
            *first = Some((row, describe()));
            self.row.store(row, Ordering::Relaxed);
        }
    }

    /// The first failure, once the batch is solved.
    #[must_use]
    pub fn first(self) -> Option<FirstFailure> {
        let count = self.count.into_inner();
        let (row, failure) = self.first.into_inner().ok().flatten()?;
        Some(FirstFailure { row, failure, count })
    }
}

/// One thread's access to the log. It counts locally and adds its count when dropped: a shared
/// counter would make threads wait for each other at every design.
#[derive(Debug)]
pub(super) struct FailureCounter<'a> {
    log: &'a FailureLog,
    later: usize,
}

impl<'a> FailureCounter<'a> {
    pub(super) fn new(log: &'a FailureLog) -> Self {
        Self { log, later: 0 }
    }

    /// Counts `count` failures from `row` on; describes the first unless an earlier one is known.
    pub(super) fn record(&self, row: usize, count: usize, describe: impl FnOnce() -> Failure) {
        self.log.record(row, count, describe);
    }

    /// Counts `count` failures from `row` on if an earlier one is known. Otherwise returns false, and
    /// the caller must describe the first with [`record`](Self::record).
    #[inline(always)]
    pub(super) fn count_later(&mut self, row: usize, count: usize) -> bool {
        let later = self.log.row.load(Ordering::Relaxed) < row;
        if later {
            self.later += count;
        }
        later
    }
}

impl Drop for FailureCounter<'_> {
    fn drop(&mut self) {
        self.log.count.fetch_add(self.later, Ordering::Relaxed);
    }
}
