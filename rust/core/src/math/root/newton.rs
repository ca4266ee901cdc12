//! Newton's method in a bracket.

/// Limit of iterations: bisection alone converges within it.
const MAX_STEPS: u32 = 80;

/// Root between two points, given with values that differ in sign: Newton steps, or bisection where
/// they leave the bracket (Press et al., Numerical Recipes, 3rd ed. 2007, 9.4). It starts where the
/// chord is zero.
///
/// Returns the point where the function is zero or a step no longer changes it, or the last one
/// after 80 steps.
pub(crate) fn newton_in_bracket(
    (mut low, at_low): (f64, f64),
    (mut high, at_high): (f64, f64),
    f: impl Fn(f64) -> f64,
    slope: impl Fn(f64) -> f64,
) -> f64 {
    let mut x = low + (high - low) * (at_low / (at_low - at_high));
    for _ in 0..MAX_STEPS {
        let at_x = f(x);
        if at_x == 0.0 {
            break;
        }
        if (at_x > 0.0) == (at_low > 0.0) {
            low = x;
        } else {
            high = x;
        }
        let step = at_x / slope(x);
        let next = x - step;
        let next = if next > low && next < high { next } else { 0.5 * (low + high) };
        if next == x {
            break;
        }
        x = next;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::newton_in_bracket;

    #[test]
    fn finds_roots() {
        let root = newton_in_bracket((0.0, -2.0), (2.0, 2.0), |x| x * x - 2.0, |x| 2.0 * x);
        assert!((root - 2.0_f64.sqrt()).abs() < 4e-16, "{root}");
        // Newton's method alone diverges on an arc tangent from so far away.
        let slope = |x: f64| 1.0 / (1.0 + x * x);
        let (low, high) = (-10.0_f64, 90.0_f64);
        let root = newton_in_bracket((low, low.atan()), (high, high.atan()), f64::atan, slope);
        assert!(root.abs() < 1e-15, "{root}");
    }
}
