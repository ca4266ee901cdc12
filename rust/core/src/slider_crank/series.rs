//! The stroke as a cosine series, each coefficient itself a series.

use super::jet::Jet;
use crate::lanes::trig::sin_cos;

/// Terms of one coefficient, at most: for k − 1 of 1e-6 some ten millions are needed.
const MOST_TERMS: usize = 100_000_000;

/// A coefficient whose series would need more terms than can be waited for: k is too near 1.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("k is {k}: so near 1 the coefficients' series do not end; give terms, or a longer rod")]
pub struct SlowSeries {
    /// Rod per crank.
    pub k: f64,
}

/// Coefficients A0, A1, A2, A4, A6 … (2021, equations 11 and 12).
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    coefficients: Vec<f64>,
}

impl Series {
    /// For a rod of k > 1 cranks: up to a harmonic (even, or 1), each coefficient with powers up to
    /// sin^(2 `terms`) φ, none: all that add anything.
    ///
    /// `A_2n` = (−1)ⁿ 2 Σ_{m ≥ n} C(2m, m) C(2m, m−n) / ((2m−1) 16^m k^(2m−1)), of A0 half that, and
    /// 1 more; A1 = −1. From the binomial series of cos δ and the powers of the sine.
    ///
    /// # Errors
    ///
    /// [`SlowSeries`].
    pub fn new(k: f64, harmonics: usize, terms: Option<usize>) -> Result<Self, SlowSeries> {
        let mut coefficients = vec![1.0 + inner(k, 0, terms)?];
        if harmonics >= 1 {
            coefficients.push(-1.0);
        }
        for n in 1..=harmonics / 2 {
            let sign = if n % 2 == 0 { 1.0 } else { -1.0 };
            coefficients.push(sign * 2.0 * inner(k, n, terms)?);
        }
        Ok(Self { coefficients })
    }

    /// A0, A1, A2, A4, A6 …
    #[must_use]
    pub fn coefficients(&self) -> &[f64] {
        &self.coefficients
    }

    /// The stroke per crank length and its derivatives.
    #[must_use]
    pub fn stroke(&self, phi: f64) -> Jet {
        let mut sum = [0.0; 3];
        // The small ones first.
        for (place, a) in self.coefficients.iter().enumerate().rev() {
            let harmonic = match place {
                0 => 0.0,
                1 => 1.0,
                _ => 2.0 * (place - 1) as f64,
            };
            let (s, c) = sin_cos(harmonic * phi);
            sum[0] += a * c;
            sum[1] -= a * harmonic * s;
            sum[2] -= a * harmonic * harmonic * c;
        }
        Jet(sum)
    }
}

/// Σ_{m = max(n, 1)}^{terms} C(2m, m) C(2m, m−n) / ((2m−1) 16^m k^(2m−1)).
fn inner(k: f64, n: usize, terms: Option<usize>) -> Result<f64, SlowSeries> {
    let x = 1.0 / (k * k);
    let shift = n as f64;
    let mut m = n.max(1) as f64;
    // The first term: C(2n, n) / ((2n−1) 16ⁿ k^(2n−1)), of n = 0 that of m = 1: 4 / (16 k).
    let mut term = 0.25 / k;
    if n > 0 {
        // C(2, 1) / (16 k) for n = 1, and from one n to the next.
        term = 0.125 / k;
        for i in 1..n {
            let i = i as f64;
            term *= (2.0 * i - 1.0) / (8.0 * (i + 1.0)) * x;
        }
    }
    let (mut sum, mut lost) = (0.0, 0.0);
    let last = terms.unwrap_or(MOST_TERMS);
    let mut count = n.max(1);
    while count <= last {
        // Kahan's sum: there may be millions.
        let y = term - lost;
        let new = sum + y;
        lost = (new - sum) - y;
        sum = new;
        // What is left is less than a geometric series of x.
        if terms.is_none() && term * x <= (1.0 - x) * sum * (0.25 * f64::EPSILON) {
            return Ok(sum);
        }
        term *= (m - 0.5) * (m + 0.5) / ((m + 1.0 - shift) * (m + 1.0 + shift)) * x;
        m += 1.0;
        count += 1;
    }
    if terms.is_none() { Err(SlowSeries { k }) } else { Ok(sum) }
}
