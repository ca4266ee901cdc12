//! Work space that one call leaves to later ones: making it takes longer than solving one design.

use std::any::Any;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

/// The most that is kept, of all mechanisms together; each thread of a call takes its own.
const MAX_KEPT: usize = 8;

/// Work spaces of any type, with the plans that they fit. The oldest goes first.
static KEPT: Mutex<Vec<(u64, Box<dyn Any + Send>)>> = Mutex::new(Vec::new());

/// Number of a plan, by which work space made for it is found again. Copies of a plan share it;
/// equality ignores it.
#[derive(Debug, Clone)]
pub(crate) struct PlanNumber(u64);

impl PlanNumber {
    /// The next number.
    pub(crate) fn next() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        Self(NEXT.fetch_add(1, Ordering::Relaxed))
    }

    /// Takes work space that fits, if some is kept.
    pub(crate) fn take<T: Any + Send>(&self, fits: impl Fn(&T) -> bool) -> Option<Box<T>> {
        // Never waits: in a forked process the lock may be held by a thread that is gone.
        let mut kept = KEPT.try_lock().ok()?;
        let fits = |(plan, space): &(u64, Box<dyn Any + Send>)| {
            *plan == self.0 && space.downcast_ref().is_some_and(&fits)
        };
        let index = kept.iter().rposition(fits)?;
        kept.remove(index).1.downcast().ok()
    }

    /// Keeps work space, if need be in place of the oldest.
    pub(crate) fn keep<T: Any + Send>(&self, space: Box<T>) {
        let oldest = {
            let Ok(mut kept) = KEPT.try_lock() else { return };
            let oldest = if kept.len() == MAX_KEPT { Some(kept.remove(0)) } else { None };
            kept.push((self.0, space));
            oldest
        };
        // Freed without the lock.
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

    /// A type of its own, since other tests keep work space at the same time.
    #[derive(Debug, PartialEq)]
    struct Space(usize);

    /// What others keep meanwhile may drive work space out, but nothing else is ever found.
    #[test]
    fn what_is_kept_is_found_once_and_for_its_plan_alone() {
        let (one, other) = (PlanNumber::next(), PlanNumber::next());
        assert_eq!(one.take(|_: &Space| true), None);
        let found = (0..100).any(|_| {
            one.keep(Box::new(Space(1)));
            one.keep(Box::new(Space(2)));
            assert_eq!(other.take(|_: &Space| true), None);
            assert_eq!(one.take(|_: &u8| true), None);
            let latest = one.take(|_: &Space| true);
            latest.is_some_and(|space| *space == Space(2))
        });
        assert!(found);
        while one.take(|_: &Space| true).is_some() {}
        assert_eq!(one.take(|_: &Space| true), None);
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
