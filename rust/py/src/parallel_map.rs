//! Maps indices to results on several threads.

use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

use assur::available_threads;

/// Results of `one` for every index below `count`, on at most one thread for every
/// `min_per_thread` indices. After a cancellation the rest of each thread's results is missing.
pub(crate) fn parallel_map<T: Send>(
    count: usize,
    min_per_thread: usize,
    threads: Option<usize>,
    cancel: &AtomicBool,
    one: &(impl Fn(usize) -> T + Sync),
) -> Vec<T> {
    let most = count.div_ceil(min_per_thread).max(1);
    let threads =
        if most == 1 { 1 } else { threads.unwrap_or_else(available_threads).min(most).max(1) };
    let share = count.div_ceil(threads);
    let run_share = |first: usize| -> Vec<T> {
        let indices = first..(first + share).min(count);
        indices.take_while(|_| !cancel.load(Ordering::Relaxed)).map(one).collect()
    };
    if threads == 1 {
        return run_share(0);
    }
    thread::scope(|scope| {
        let workers: Vec<_> =
            (0..count).step_by(share).map(|first| scope.spawn(move || run_share(first))).collect();
        let joined = workers.into_iter().flat_map(|worker| match worker.join() {
            Ok(done) => done,
            Err(panic) => resume_unwind(panic),
        });
        joined.collect()
    })
}
