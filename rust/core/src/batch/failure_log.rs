//! The first failure of a batch, recorded while it is solved.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::query::failure::Failure;

/// The failure with the lowest row (designs, then positions) of a batch, and the number of all.
#[derive(Debug, Default)]
pub struct FailureLog {
    first: Mutex<Option<(usize, Failure)>>,
    count: AtomicUsize,
}

/// The first failure of a batch.
#[derive(Debug, Clone, PartialEq)]
pub struct FirstFailure {
    /// Its row: design times positions, plus position.
    pub row: usize,
    /// What failed.
    pub failure: Failure,
    /// Number of all failures of the batch.
    pub count: usize,
}

impl FailureLog {
    /// Counts failures of rows from `row` on; describes the first if none before it is known.
    pub(crate) fn record(&self, row: usize, count: usize, describe: impl FnOnce() -> Failure) {
        self.count.fetch_add(count, Ordering::Relaxed);
        let Ok(mut first) = self.first.lock() else { return };
        if first.as_ref().is_none_or(|&(known, _)| row < known) {
            *first = Some((row, describe()));
        }
    }

    /// Counts a failure of a row if one before it is known; else the caller has to describe it by
    /// [`record`](Self::record).
    pub(crate) fn count_later(&self, row: usize) -> bool {
        let is_later =
            |first: &Option<(usize, Failure)>| matches!(first, &Some((known, _)) if known < row);
        let later = self.first.lock().is_ok_and(|first| is_later(&first));
        if later {
            self.count.fetch_add(1, Ordering::Relaxed);
        }
        later
    }

    /// The first failure, once the batch is solved.
    #[must_use]
    pub fn first(self) -> Option<FirstFailure> {
        let count = self.count.into_inner();
        let (row, failure) = self.first.into_inner().ok().flatten()?;
        Some(FirstFailure { row, failure, count })
    }
}
