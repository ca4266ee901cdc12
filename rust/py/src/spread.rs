//! Many small tasks on some threads.

use std::num::NonZero;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

/// Does `one` for every index, at least `together` on a thread; what is cancelled is left out at
/// the end.
pub(crate) fn spread<T: Send>(
    count: usize,
    together: usize,
    threads: Option<usize>,
    cancel: &AtomicBool,
    one: &(impl Fn(usize) -> T + Sync),
) -> Vec<T> {
    let available = || thread::available_parallelism().map_or(1, NonZero::get);
    let threads = threads.unwrap_or_else(available).min(count.div_ceil(together)).max(1);
    let share = count.div_ceil(threads);
    let part = |first: usize| -> Vec<T> {
        let own = first..(first + share).min(count);
        own.take_while(|_| !cancel.load(Ordering::Relaxed)).map(one).collect()
    };
    if threads == 1 {
        return part(0);
    }
    thread::scope(|scope| {
        let parts: Vec<_> =
            (0..count).step_by(share).map(|first| scope.spawn(move || part(first))).collect();
        let joined = parts.into_iter().flat_map(|part| match part.join() {
            Ok(done) => done,
            Err(panic) => resume_unwind(panic),
        });
        joined.collect()
    })
}
