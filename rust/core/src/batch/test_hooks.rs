//! A panic on purpose, to test what becomes of one. Only with the feature `test-hooks`, which no
//! release has.

use std::sync::atomic::{AtomicUsize, Ordering};

/// Chunks of work until the panic; 0: none.
static CHUNKS: AtomicUsize = AtomicUsize::new(0);

/// Makes the `number`-th chunk of work from now on panic (0: none does).
pub fn panic_in_chunk(number: usize) {
    CHUNKS.store(number, Ordering::SeqCst);
}

pub(crate) fn before_chunk() {
    let less = |left: usize| left.checked_sub(1);
    let before = CHUNKS.fetch_update(Ordering::SeqCst, Ordering::SeqCst, less);
    assert!(before != Ok(1), "a panic on purpose");
}
