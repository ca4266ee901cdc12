//! Adaptive Gauss-Legendre integration of smooth functions.

use std::sync::LazyLock;

use super::trig::sin_cos;

/// Points of the rule.
const POINTS: usize = 12;
/// Limit of bisections of one interval, and of intervals bisected in one integral: a pole or a root
/// at an end needs about a hundred. A function that is only rounding error never converges.
const MAX_DEPTH: u32 = 48;
const MAX_BISECTIONS: u32 = 4096;
/// Accepted difference between an interval and its two halves, relative to the integral. Bisection
/// by itself gains some seven digits for a function as smooth as this rule expects.
const RTOL: f64 = 1.0e-13;

/// Nodes and weights on [−1, 1], of the positive half.
static RULE: LazyLock<[[f64; 2]; POINTS / 2]> = LazyLock::new(|| std::array::from_fn(node));

/// Node `i` of the Gauss-Legendre rule: a root of the Legendre polynomial, by Newton's method
/// (Abramowitz & Stegun, 25.4.29).
fn node(i: usize) -> [f64; 2] {
    let n = POINTS as f64;
    let mut x = sin_cos(std::f64::consts::PI * (i as f64 + 0.75) / (n + 0.5)).1;
    let mut slope = 1.0;
    for _ in 0..8 {
        let (mut previous, mut p) = (1.0, x);
        for k in 2..=POINTS {
            let k = k as f64;
            (previous, p) = (p, ((2.0 * k - 1.0) * x * p - (k - 1.0) * previous) / k);
        }
        slope = n * (x * p - previous) / (x * x - 1.0);
        x -= p / slope;
    }
    [x, 2.0 / ((1.0 - x * x) * slope * slope)]
}

/// Integral from `a` to `b`, bisecting where the halves differ from the whole. NaN if the number of
/// bisections exceeds its limit.
pub(crate) fn integral(f: &impl Fn(f64) -> f64, a: f64, b: f64) -> f64 {
    let whole = rule(f, a, b);
    let mut budget = MAX_BISECTIONS;
    refine(f, [a, b], whole, (RTOL * whole.abs(), &mut budget), MAX_DEPTH)
}

fn rule(f: &impl Fn(f64) -> f64, a: f64, b: f64) -> f64 {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    let sum: f64 =
        RULE.iter().map(|[x, w]| w * (f(middle - half * x) + f(middle + half * x))).sum();
    half * sum
}

fn refine(
    f: &impl Fn(f64) -> f64,
    [a, b]: [f64; 2],
    whole: f64,
    (tolerance, budget): (f64, &mut u32),
    depth: u32,
) -> f64 {
    let Some(rest) = budget.checked_sub(1) else { return f64::NAN };
    *budget = rest;
    let middle = 0.5 * (a + b);
    let halves = [[a, middle], [middle, b]].map(|ends| (ends, rule(f, ends[0], ends[1])));
    let sum = halves[0].1 + halves[1].1;
    // NaN ends the recursion too: bisection cannot remove it.
    let differs = (sum - whole).abs() > tolerance;
    if depth == 0 || !differs {
        return sum;
    }
    halves.map(|(ends, half)| refine(f, ends, half, (tolerance, budget), depth - 1)).iter().sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrates_polynomials_and_square_roots() {
        let exact = integral(&|x: f64| x.powi(23), 0.0, 1.0);
        assert!((exact - 1.0 / 24.0).abs() < 1e-16);
        let root = integral(&|x: f64| (1.0 + x).sqrt(), 0.0, 3.0);
        assert!((root - 14.0 / 3.0).abs() < 1e-14);
        let weights: f64 = RULE.iter().map(|[_, w]| 2.0 * w).sum();
        assert!((weights - 2.0).abs() < 1e-15);
        assert!(integral(&|_| f64::NAN, 0.0, 1.0).is_nan());
    }

    #[test]
    fn integrates_a_narrow_peak() {
        let a = 1e-3_f64;
        let sum = integral(&|x: f64| 1.0 / (x * x + a * a), -1.0, 1.0);
        assert!((sum * a / 2.0 - (1.0 / a).atan()).abs() < 1e-13);
    }

    #[test]
    fn rounding_noise_gives_nan() {
        // The rest of 1 after rounding beside 1e16.
        assert!(integral(&|x: f64| (1e16 * x + 1.0) - 1e16 * x, 0.0, 1.0).is_nan());
        let root = integral(&|x: f64| 1.0 / x.sqrt(), 0.0, 1.0);
        assert!((root - 2.0).abs() < 1e-6, "{root}");
    }
}
