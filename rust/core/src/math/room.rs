//! Checks that memory has room before it is needed.

use std::hint::black_box;

/// Whether memory has room for `numbers` numbers. A list of the standard library aborts where it cannot
/// grow, so lists as long as a user's arrays are checked first.
pub(crate) fn has_room(numbers: usize) -> bool {
    // The compiler may remove an allocation that is never used.
    black_box(Vec::<f64>::new()).try_reserve_exact(numbers).is_ok()
}

#[cfg(test)]
mod tests {
    use super::has_room;

    #[test]
    fn there_is_room_for_little_and_none_for_all() {
        assert!(has_room(1000));
        assert!(!has_room(usize::MAX / 16));
        assert!(!has_room(1 << 58));
    }
}
