//! Integrals of smooth functions.

use std::sync::LazyLock;

use super::trig::sin_cos;

/// Points of a rule.
const POINTS: usize = 12;
/// Halvings of an interval, at most, and of all intervals of an integral: a pole or a root at an end
/// takes a hundred. The rounding of a function that is small beside its parts never agrees.
const HALVINGS: u32 = 48;
const MOST_HALVED: u32 = 4096;
/// Difference between an interval and its halves, as a part of the whole, that is let be: halving
/// gains some seven digits by itself, for a function as smooth as this rule wants it.
const AGREE: f64 = 1.0e-13;

/// Nodes and weights on [−1, 1], of the positive half.
static RULE: LazyLock<[[f64; 2]; POINTS / 2]> = LazyLock::new(|| std::array::from_fn(node));

/// Node `i` of Gauss & Legendre's rule: a zero of Legendre's polynomial, by Newton's iteration
/// (Abramowitz & Stegun, 25.4.29).
fn node(i: usize) -> [f64; 2] {
    let n = POINTS as f64;
    let mut x = sin_cos(std::f64::consts::PI * (i as f64 + 0.75) / (n + 0.5)).1;
    let mut slope = 1.0;
    for _ in 0..8 {
        let (mut last, mut own) = (1.0, x);
        for k in 2..=POINTS {
            let k = k as f64;
            (last, own) = (own, ((2.0 * k - 1.0) * x * own - (k - 1.0) * last) / k);
        }
        slope = n * (x * own - last) / (x * x - 1.0);
        x -= own / slope;
    }
    [x, 2.0 / ((1.0 - x * x) * slope * slope)]
}

/// The integral from `a` to `b`; halves where halves differ from the whole. NaN if they do so nearly
/// everywhere.
pub(crate) fn integral(f: &impl Fn(f64) -> f64, a: f64, b: f64) -> f64 {
    let whole = rule(f, a, b);
    let mut left = MOST_HALVED;
    refined(f, [a, b], whole, (AGREE * whole.abs(), &mut left), HALVINGS)
}

fn rule(f: &impl Fn(f64) -> f64, a: f64, b: f64) -> f64 {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    let sum: f64 =
        RULE.iter().map(|[x, w]| w * (f(middle - half * x) + f(middle + half * x))).sum();
    half * sum
}

fn refined(
    f: &impl Fn(f64) -> f64,
    [a, b]: [f64; 2],
    whole: f64,
    (agree, left): (f64, &mut u32),
    depth: u32,
) -> f64 {
    let Some(fewer) = left.checked_sub(1) else { return f64::NAN };
    *left = fewer;
    let middle = 0.5 * (a + b);
    let halves = [[a, middle], [middle, b]].map(|ends| (ends, rule(f, ends[0], ends[1])));
    let sum = halves[0].1 + halves[1].1;
    // No number is let be as well: it would not become one.
    let differ = (sum - whole).abs() > agree;
    if depth == 0 || !differ {
        return sum;
    }
    halves.map(|(ends, half)| refined(f, ends, half, (agree, left), depth - 1)).iter().sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_and_roots() {
        let exact = integral(&|x: f64| x.powi(23), 0.0, 1.0);
        assert!((exact - 1.0 / 24.0).abs() < 1e-16);
        let root = integral(&|x: f64| (1.0 + x).sqrt(), 0.0, 3.0);
        assert!((root - 14.0 / 3.0).abs() < 1e-14);
        let weights: f64 = RULE.iter().map(|[_, w]| 2.0 * w).sum();
        assert!((weights - 2.0).abs() < 1e-15);
        assert!(integral(&|_| f64::NAN, 0.0, 1.0).is_nan());
    }

    #[test]
    fn nearly_a_pole() {
        let a = 1e-3_f64;
        let sum = integral(&|x: f64| 1.0 / (x * x + a * a), -1.0, 1.0);
        assert!((sum * a / 2.0 - (1.0 / a).atan()).abs() < 1e-13);
    }

    #[test]
    fn noise_has_no_integral() {
        // What rounding leaves of 1 beside 1e16.
        assert!(integral(&|x: f64| (1e16 * x + 1.0) - 1e16 * x, 0.0, 1.0).is_nan());
        let root = integral(&|x: f64| 1.0 / x.sqrt(), 0.0, 1.0);
        assert!((root - 2.0).abs() < 1e-6, "{root}");
    }
}
