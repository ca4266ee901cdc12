//! A deliberate panic, to test how the library handles one. Only the feature `test-hooks` has it,
//! which releases are built without.

use std::sync::atomic::{AtomicUsize, Ordering};

/// Chunks left until the panic; 0: no panic.
static CHUNKS: AtomicUsize = AtomicUsize::new(0);

/// Makes the `number`-th chunk from now on panic (0: none).
pub fn panic_in_chunk(number: usize) {
    CHUNKS.store(number, Ordering::SeqCst);
}

pub(crate) fn before_chunk() {
    let less = |left: usize| left.checked_sub(1);
    let before = CHUNKS.fetch_update(Ordering::SeqCst, Ordering::SeqCst, less);
    assert!(before != Ok(1), "deliberate panic");
}
