//! Polynomials: evaluation, and the roots of a cubic in an interval.

use super::root::newton::newton_in_bracket;

/// Evaluates a polynomial in powers of `x`, constant term first.
#[must_use]
pub(crate) fn value(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// Passes each root of a cubic in [0, `width`] to `visit`. Between its extremes the cubic is
/// monotone, so a sign change brackets a root. A double root is an extreme, and rounding decides
/// whether it is found.
pub(crate) fn roots(cubic: &[f64; 4], width: f64, mut visit: impl FnMut(f64)) {
    let [_, c1, c2, c3] = *cubic;
    let mut bounds = [0.0, width, width, width];
    // Roots of c1 + 2 c2 x + 3 c3 x², without cancellation.
    let discriminant = c2 * c2 - 3.0 * c3 * c1;
    if discriminant > 0.0 {
        let sum = -(c2 + discriminant.sqrt().copysign(c2));
        let (mut a, mut b) = (sum / (3.0 * c3), c1 / sum);
        if a > b {
            (a, b) = (b, a);
        }
        let within = |x: f64| if x > 0.0 && x < width { x } else { width };
        (bounds[1], bounds[2]) = if a > 0.0 { (within(a), within(b)) } else { (within(b), width) };
    }
    for ends in bounds.windows(2) {
        if let [low, high] = *ends
            && let Some(root) = root_between(cubic, low, high)
        {
            visit(root);
        }
    }
}

/// The root between two points, if their values differ in sign or one of them is zero.
fn root_between(cubic: &[f64; 4], low: f64, high: f64) -> Option<f64> {
    let (at_low, at_high) = (value(cubic, low), value(cubic, high));
    if at_low == 0.0 {
        return Some(low);
    }
    let sign_changes = at_low * at_high.signum() < 0.0;
    if !sign_changes {
        return (at_high == 0.0 && high > low).then_some(high);
    }
    let [_, c1, c2, c3] = *cubic;
    let slope = |x: f64| value(&[c1, 2.0 * c2, 3.0 * c3], x);
    Some(newton_in_bracket((low, at_low), (high, at_high), |x| value(cubic, x), slope))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all_roots(cubic: [f64; 4], width: f64) -> Vec<f64> {
        let mut list = Vec::new();
        roots(&cubic, width, |x| list.push(x));
        list
    }

    #[test]
    fn finds_the_roots_of_factored_cubics() {
        // (x − 0.1)(x − 0.5)(x − 0.7)
        let three = all_roots([-0.035, 0.47, -1.3, 1.0], 1.0);
        assert_eq!(three.len(), 3);
        for (x, y) in three.iter().zip([0.1, 0.5, 0.7]) {
            assert!((x - y).abs() < 1e-14, "{x}");
        }
        assert_eq!(all_roots([-0.035, 0.47, -1.3, 1.0], 0.6).len(), 2);
        assert!((all_roots([-1.0, 2.0, 0.0, 0.0], 1.0)[0] - 0.5).abs() < 1e-16);
        assert!((all_roots([-1.0, 0.0, 4.0, 0.0], 1.0)[0] - 0.5).abs() < 1e-16);
        assert!(all_roots([1.0, 0.0, 4.0, 0.0], 1.0).is_empty());
        assert!(all_roots([f64::NAN; 4], 1.0).is_empty());
        assert_eq!(all_roots([-1e-300, 0.0, 0.0, 1e-300], 2.0), [1.0]);
    }
}
