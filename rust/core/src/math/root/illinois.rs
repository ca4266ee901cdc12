//! Regula falsi with the Illinois weights, and the bracket it needs.

/// Growth of the steps while bracketing the root.
const GROWTH: f64 = 2.0;
/// Limit of bracketing steps: they cover a range of 2^±200.
const MAX_BRACKET_STEPS: u32 = 24;
/// Limit of iterations inside the bracket: bisection alone converges within it.
const MAX_STEPS: u32 = 120;

/// Root of an increasing function of a positive number, from a first guess: growing steps bracket
/// it, and regula falsi with the Illinois weights narrows the bracket (M. Dowell & P. Jarratt, A
/// modified regula falsi method, BIT 11 (1971)).
///
/// Returns the point where the function is zero or a step no longer changes it, or the last one
/// after 120 steps. `None` if no bracket was found or the function is NaN inside it.
pub(crate) fn find_root(f: impl Fn(f64) -> f64, guess: f64) -> Option<f64> {
    find_root_to(f, guess, 0.0)
}

/// The same, ending at a step within a relative tolerance.
pub(crate) fn find_root_to(mut f: impl FnMut(f64) -> f64, guess: f64, rtol: f64) -> Option<f64> {
    let at_guess = f(guess);
    if at_guess == 0.0 {
        return Some(guess);
    }
    let up = at_guess < 0.0;
    let (mut near, mut at_near) = (guess, at_guess);
    let (mut far, mut at_far) = (guess, at_guess);
    let mut factor = 1.0 + 1.0 / 16.0;
    for _ in 0..MAX_BRACKET_STEPS {
        (near, at_near) = (far, at_far);
        far = if up { far * factor } else { far / factor };
        at_far = f(far);
        if at_far.is_nan() || (at_far > 0.0) == up {
            break;
        }
        factor = 1.0 + (factor - 1.0) * GROWTH;
    }
    let bracketed = at_far * at_near.signum() <= 0.0;
    if !bracketed {
        return None;
    }
    let (mut a, mut at_a, mut b, mut at_b) = (near, at_near, far, at_far);
    for _ in 0..MAX_STEPS {
        if at_b == 0.0 || at_a == at_b {
            return Some(b);
        }
        let mut next = b - at_b * (b - a) / (at_b - at_a);
        if !(next > a.min(b) && next < a.max(b)) {
            next = 0.5 * (a + b);
        }
        let value = f(next);
        if value.is_nan() {
            return None;
        }
        if next == a || next == b || (next - b).abs() <= rtol * next.abs() {
            return Some(next);
        }
        if (value > 0.0) == (at_b > 0.0) {
            at_a *= 0.5;
        } else {
            (a, at_a) = (b, at_b);
        }
        (b, at_b) = (next, value);
    }
    Some(b)
}

#[cfg(test)]
mod tests {
    use super::{find_root, find_root_to};

    #[test]
    fn finds_roots() {
        let root = find_root(|x| x * x - 2.0, 1.0).expect("the root of 2");
        assert!((root - 2.0_f64.sqrt()).abs() < 4e-16);
        let small = find_root(|x| x.ln() + 50.0, 1.0).expect("e^-50");
        assert!((small.ln() + 50.0).abs() < 1e-13);
        assert!(find_root(|x| x + 1.0, 1.0).is_none());
        assert!(find_root(|_| f64::NAN, 1.0).is_none());
    }

    #[test]
    fn a_tolerance_saves_evaluations() {
        let count = |rtol: f64| {
            let mut count = 0;
            let f = |x: f64| {
                count += 1;
                x * x - 2.0
            };
            let root = find_root_to(f, 1.0, rtol).expect("the root of 2");
            assert!((root - 2.0_f64.sqrt()).abs() <= 2.0 * rtol, "{root}");
            count
        };
        assert!(count(1e-3) < count(1e-15));
    }
}
