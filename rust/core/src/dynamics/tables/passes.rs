//! Passes over the rows of a table that end once the work is cancelled.

use std::sync::atomic::{AtomicBool, Ordering};

/// Rows between two checks for cancellation: some hundred microseconds.
const ROWS_PER_CHECK: usize = 4096;

/// Whether the work is cancelled, checked every [`ROWS_PER_CHECK`] rows.
pub(crate) fn is_cancelled(row: usize, cancel: &AtomicBool) -> bool {
    row.is_multiple_of(ROWS_PER_CHECK) && cancel.load(Ordering::Relaxed)
}

/// `count` items; fewer once `cancel` is true.
pub(crate) fn collected<T>(
    count: usize,
    cancel: &AtomicBool,
    mut item: impl FnMut(usize) -> T,
) -> Vec<T> {
    let mut items = Vec::with_capacity(count);
    while items.len() < count && !cancel.load(Ordering::Relaxed) {
        let from = items.len();
        items.extend((from..count.min(from + ROWS_PER_CHECK)).map(&mut item));
    }
    items
}
