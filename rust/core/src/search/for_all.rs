//! The same work for many indices, on some threads.

use std::num::NonZeroUsize;
use std::panic::resume_unwind;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// Does something for all indices below a count. Each thread has its memory; results are in order, the same for any
/// number of threads if they do not depend on that memory.
pub(crate) fn for_all<M: Default, T: Send>(
    threads: NonZeroUsize,
    count: usize,
    work: impl Fn(usize, &mut M) -> T + Sync,
) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let results: Mutex<Vec<(usize, T)>> = Mutex::new(Vec::with_capacity(count));
    let work_until_done = || {
        let mut memory = M::default();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if index >= count {
                return;
            }
            let result = work(index, &mut memory);
            if let Ok(mut results) = results.lock() {
                results.push((index, result));
            }
        }
    };
    thread::scope(|scope| {
        // If the system refuses a thread, there are fewer.
        let helpers: Vec<_> = (1..threads.get().min(count))
            .map_while(|_| thread::Builder::new().spawn_scoped(scope, work_until_done).ok())
            .collect();
        work_until_done();
        for helper in helpers {
            if let Err(panic) = helper.join() {
                resume_unwind(panic);
            }
        }
    });
    let mut results = results.into_inner().unwrap_or_default();
    results.sort_by_key(|(index, _)| *index);
    results.into_iter().map(|(_, result)| result).collect()
}
