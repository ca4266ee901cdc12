//! Work spaces kept from one call to the next: making one takes longer than solving one design.

use std::any::Any;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};

/// Most work spaces kept, for all mechanisms together. Each thread of a call takes one.
const MAX_KEPT: usize = 8;

/// Kept work spaces of any type, each with the number of its plan. The oldest comes first.
static KEPT: Mutex<Vec<(u64, Box<dyn Any + Send>)>> = Mutex::new(Vec::new());

/// Number of a plan, by which its work spaces are found. Copies of a plan share it; equality ignores
/// it.
#[derive(Debug, Clone)]
pub(crate) struct PlanNumber(u64);

impl PlanNumber {
    /// A number that no other plan has.
    pub(crate) fn next() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        Self(NEXT.fetch_add(1, Ordering::Relaxed))
    }

    /// Takes a kept work space that fits, if any.
    pub(crate) fn take<T: Any + Send>(&self, fits: impl Fn(&T) -> bool) -> Option<Box<T>> {
        // Must not wait: in a forked process the lock may be held by a thread that no longer exists.
        let mut kept = KEPT.try_lock().ok()?;
        let fits = |(plan, space): &(u64, Box<dyn Any + Send>)| {
            *plan == self.0 && space.downcast_ref().is_some_and(&fits)
        };
        let index = kept.iter().rposition(fits)?;
        kept.remove(index).1.downcast().ok()
    }

    /// A kept object that fits, shared by calls, or a new one.
    pub(crate) fn share<T: Any + Send + Sync>(
        &self,
        fits: impl Fn(&T) -> bool,
        make: impl FnOnce() -> T,
    ) -> Arc<T> {
        let kept = self.take(|kept: &Arc<T>| fits(kept));
        let kept = kept.unwrap_or_else(|| Box::new(Arc::new(make())));
        let shared = Arc::clone(&kept);
        self.keep(kept);
        shared
    }

    /// Keeps a work space, in place of the oldest if [`MAX_KEPT`] are kept.
    pub(crate) fn keep<T: Any + Send>(&self, space: Box<T>) {
        let oldest = {
            let Ok(mut kept) = KEPT.try_lock() else { return };
            let oldest = if kept.len() == MAX_KEPT { Some(kept.remove(0)) } else { None };
            kept.push((self.0, space));
            oldest
        };
        // Free it after releasing the lock.
        drop(oldest);
    }
}

impl PartialEq for PlanNumber {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A separate type, because other tests keep work spaces at the same time.
    #[derive(Debug, PartialEq)]
    struct Space(usize);

    /// Other tests may push this work space out, but a wrong one is never found.
    #[test]
    fn what_is_kept_is_found_once_and_for_its_plan_alone() {
        let (number, other_number) = (PlanNumber::next(), PlanNumber::next());
        assert_eq!(number.take(|_: &Space| true), None);
        let is_found = (0..100).any(|_| {
            number.keep(Box::new(Space(1)));
            number.keep(Box::new(Space(2)));
            assert_eq!(other_number.take(|_: &Space| true), None);
            assert_eq!(number.take(|_: &u8| true), None);
            let latest = number.take(|_: &Space| true);
            latest.is_some_and(|space| *space == Space(2))
        });
        assert!(is_found);
        while number.take(|_: &Space| true).is_some() {}
        assert_eq!(number.take(|_: &Space| true), None);
    }

    #[test]
    fn no_more_than_the_most_is_kept() {
        let plan = PlanNumber::next();
        for number in 0..3 * MAX_KEPT {
            plan.keep(Box::new(Space(number)));
        }
        let count = std::iter::from_fn(|| plan.take(|_: &Space| true)).count();
        assert!(count <= MAX_KEPT);
    }
}
