//! Cubics: their values and their zeros within an interval.

/// Steps of the search for a zero, at most: halving alone ends after so many.
const STEPS: u32 = 80;

/// A polynomial in powers, from the constant on, at a place.
#[must_use]
pub(crate) fn value(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// Tells the zeros of a cubic within [0, `width`] to `found`: between its own extremes, where it is
/// monotone, a change of sign shows them (a double one is an extreme and counts only by luck).
pub(crate) fn zeros(cubic: &[f64; 4], width: f64, mut found: impl FnMut(f64)) {
    let [_, c1, c2, c3] = *cubic;
    let mut places = [0.0, width, width, width];
    // Zeros of c1 + 2 c2 x + 3 c3 x², without cancellation.
    let discriminant = c2 * c2 - 3.0 * c3 * c1;
    if discriminant > 0.0 {
        let sum = -(c2 + discriminant.sqrt().copysign(c2));
        let (mut a, mut b) = (sum / (3.0 * c3), c1 / sum);
        if a > b {
            (a, b) = (b, a);
        }
        let within = |x: f64| if x > 0.0 && x < width { x } else { width };
        (places[1], places[2]) = if a > 0.0 { (within(a), within(b)) } else { (within(b), width) };
    }
    for ends in places.windows(2) {
        if let [low, high] = *ends
            && let Some(zero) = zero_between(cubic, low, high)
        {
            found(zero);
        }
    }
}

/// The zero between two places with values of different signs: Newton's steps as long as they stay
/// between, else halves.
fn zero_between(cubic: &[f64; 4], low: f64, high: f64) -> Option<f64> {
    let (mut low, mut high) = (low, high);
    let (at_low, at_high) = (value(cubic, low), value(cubic, high));
    if at_low == 0.0 {
        return Some(low);
    }
    let differ = at_low * at_high.signum() < 0.0;
    if !differ {
        return (at_high == 0.0 && high > low).then_some(high);
    }
    let [_, c1, c2, c3] = *cubic;
    let mut x = low + (high - low) * (at_low / (at_low - at_high));
    for _ in 0..STEPS {
        let here = value(cubic, x);
        if here == 0.0 {
            break;
        }
        if (here > 0.0) == (at_low > 0.0) {
            low = x;
        } else {
            high = x;
        }
        let step = here / value(&[c1, 2.0 * c2, 3.0 * c3], x);
        let next = x - step;
        let next = if next > low && next < high { next } else { 0.5 * (low + high) };
        if next == x {
            break;
        }
        x = next;
    }
    Some(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(cubic: [f64; 4], width: f64) -> Vec<f64> {
        let mut zeros_found = Vec::new();
        zeros(&cubic, width, |x| zeros_found.push(x));
        zeros_found
    }

    #[test]
    fn zeros_of_products() {
        // (x − 0.1)(x − 0.5)(x − 0.7)
        let three = all([-0.035, 0.47, -1.3, 1.0], 1.0);
        assert_eq!(three.len(), 3);
        for (x, y) in three.iter().zip([0.1, 0.5, 0.7]) {
            assert!((x - y).abs() < 1e-14, "{x}");
        }
        assert_eq!(all([-0.035, 0.47, -1.3, 1.0], 0.6).len(), 2);
        assert!((all([-1.0, 2.0, 0.0, 0.0], 1.0)[0] - 0.5).abs() < 1e-16);
        assert!((all([-1.0, 0.0, 4.0, 0.0], 1.0)[0] - 0.5).abs() < 1e-16);
        assert!(all([1.0, 0.0, 4.0, 0.0], 1.0).is_empty());
        assert!(all([f64::NAN; 4], 1.0).is_empty());
        assert_eq!(all([-1e-300, 0.0, 0.0, 1e-300], 2.0), [1.0]);
    }
}
