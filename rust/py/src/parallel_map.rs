//! Maps indices to results on several threads.

use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, ScopedJoinHandle};

use assur::available_threads;

/// Results of `item` for every index below `count`, on at most one thread for every
/// `min_per_thread` indices. After a cancellation the rest of each thread's results is missing.
pub(crate) fn parallel_map<T: Send>(
    count: usize,
    min_per_thread: usize,
    threads: Option<usize>,
    cancel: &AtomicBool,
    item: &(impl Fn(usize) -> T + Sync),
) -> Vec<T> {
    let most = count.div_ceil(min_per_thread).max(1);
    let threads =
        if most == 1 { 1 } else { threads.unwrap_or_else(available_threads).min(most).max(1) };
    let share = count.div_ceil(threads);
    let run_share = |first: usize| -> Vec<T> {
        let indices = first..(first + share).min(count);
        indices.take_while(|_| !cancel.load(Ordering::Relaxed)).map(item).collect()
    };
    if threads == 1 {
        return run_share(0);
    }
    thread::scope(|scope| {
        let start = |first: usize| {
            let worker = thread::Builder::new().spawn_scoped(scope, move || run_share(first));
            // Where the system refuses another thread, this one does the share.
            worker.map_err(|_| run_share(first))
        };
        let workers: Vec<_> = (0..count).step_by(share).map(start).collect();
        let joined =
            workers.into_iter().flat_map(|worker| match worker.map(ScopedJoinHandle::join) {
                Ok(Ok(done)) | Err(done) => done,
                Ok(Err(panic)) => resume_unwind(panic),
            });
        joined.collect()
    })
}
