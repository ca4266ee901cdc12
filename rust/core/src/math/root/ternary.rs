//! Ternary search.

/// Location of the minimum of a function that falls and then rises: two inner points divide the
/// bracket into thirds, and the third beyond the higher one is cut off.
///
/// Returns the middle of the bracket after `steps`, each of which leaves two thirds of it.
pub(crate) fn ternary_search(
    [mut low, mut high]: [f64; 2],
    steps: u32,
    mut f: impl FnMut(f64) -> f64,
) -> f64 {
    for _ in 0..steps {
        let third = (high - low) / 3.0;
        let [a, b] = [low + third, high - third].map(&mut f);
        if a < b { high -= third } else { low += third }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::ternary_search;

    #[test]
    fn finds_a_minimum() {
        let minimum = ternary_search([-1.0, 2.0], 60, |x| (x - 0.3).abs());
        assert!((minimum - 0.3).abs() < 1e-10, "{minimum}");
        // Without a step, the middle.
        assert_eq!(ternary_search([0.0, 1.0], 0, |x| x), 0.5);
    }
}
