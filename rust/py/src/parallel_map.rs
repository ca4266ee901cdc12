//! Maps indices to results on several threads.

use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread::{self, ScopedJoinHandle};

use assur::available_threads;

/// Parts of a thread's share that it takes at once: items may take longer in one half than in the other.
const PARTS: usize = 16;

/// Results of `item` for every index below `count`, on at most one thread for every
/// `min_per_thread` indices. After a cancellation some results are missing.
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
    let is_wanted = |_: &usize| !cancel.load(Ordering::Relaxed);
    if threads == 1 {
        return (0..count).take_while(is_wanted).map(item).collect();
    }
    let part = count.div_ceil(threads * PARTS);
    let taken = AtomicUsize::new(0);
    let run_parts = || -> Vec<(usize, Vec<T>)> {
        let mut done = Vec::new();
        loop {
            let first = taken.fetch_add(part, Ordering::Relaxed);
            if first >= count || cancel.load(Ordering::Relaxed) {
                return done;
            }
            let indices = first..(first + part).min(count);
            done.push((first, indices.take_while(is_wanted).map(item).collect()));
        }
    };
    let mut parts = thread::scope(|scope| {
        let start = |_| {
            let worker = thread::Builder::new().spawn_scoped(scope, run_parts);
            // Where the system refuses another thread, this one helps.
            worker.map_err(|_| run_parts())
        };
        let workers: Vec<_> = (0..threads).map(start).collect();
        let joined =
            workers.into_iter().flat_map(|worker| match worker.map(ScopedJoinHandle::join) {
                Ok(Ok(done)) | Err(done) => done,
                Ok(Err(panic)) => resume_unwind(panic),
            });
        joined.collect::<Vec<_>>()
    });
    parts.sort_unstable_by_key(|&(first, _)| first);
    parts.into_iter().flat_map(|(_, results)| results).collect()
}
