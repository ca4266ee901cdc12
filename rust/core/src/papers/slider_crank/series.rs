//! The stroke as a cosine series whose coefficients are themselves series.

use strum::{IntoStaticStr, VariantNames};
use thiserror::Error;

use super::double_double::DoubleDouble;
use super::jet::Jet;
use crate::description::error::Hint;
use crate::math::trig::sin_cos;

/// Limit of terms of one coefficient: k − 1 = 1e-6 needs some ten million.
const MAX_TERMS: usize = 100_000_000;
/// Fraction of a sum that does not change its 53 bits: 1/64 of half a unit in the last place.
const NEGLIGIBLE: f64 = f64::EPSILON / 256.0;

/// The reason why a series has no value.
#[derive(Debug, Clone, Copy, PartialEq, Error, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "snake_case")]
pub enum SeriesError {
    /// A coefficient would need too many terms: the rod is hardly longer than the crank.
    #[error("k is {k}: so near 1 the coefficients' series do not end")]
    DoesNotEnd {
        /// Rod per crank.
        k: f64,
    },
}

impl Hint for SeriesError {
    fn hint(&self) -> Option<String> {
        Some("give terms, or a longer rod".into())
    }
}

/// Coefficients A0, A1, A2, A4, A6 … (2021, equations 11 and 12).
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    coefficients: Vec<f64>,
}

impl Series {
    /// Series for a rod of k > 1 cranks, up to a harmonic (even, or 1). Each coefficient uses
    /// powers up to sin^(2 `terms`) φ; with `None`, all that contribute.
    ///
    /// `A_2n` = (−1)ⁿ 2 Σ_{m ≥ n} C(2m, m) C(2m, m−n) / ((2m−1) 16^m k^(2m−1)); A0 is 1 plus half
    /// of this for n = 0; A1 = −1. This follows from the binomial series of cos δ and the powers of
    /// the sine. Each coefficient is within 0.51 units in its last place (below 1e-300, within
    /// two).
    ///
    /// # Errors
    ///
    /// [`SeriesError`], if k is too near 1 and `terms` is `None`.
    pub fn new(k: f64, harmonics: usize, terms: Option<usize>) -> Result<Self, SeriesError> {
        // Even A0 would not converge: its last term, x^m / (2π m²) with x^m above e^-16, is some 30
        // times too large.
        if terms.is_none() && (k * k - 1.0) * (MAX_TERMS as f64) < 16.0 {
            return Err(SeriesError::DoesNotEnd { k });
        }
        let mut coefficients =
            vec![(DoubleDouble::from(1.0) + coefficient_sum(k, 0, terms)?).high()];
        if harmonics >= 1 {
            coefficients.push(-1.0);
        }
        for n in 1..=harmonics / 2 {
            let sign = if n % 2 == 0 { 1.0 } else { -1.0 };
            coefficients.push(sign * 2.0 * coefficient_sum(k, n, terms)?.high());
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
        // Small terms first, to keep rounding small.
        for (index, a) in self.coefficients.iter().enumerate().rev() {
            let harmonic = match index {
                0 => 0.0,
                1 => 1.0,
                _ => 2.0 * (index - 1) as f64,
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
///
/// Computed in double-double throughout: term m has accumulated some 5 m roundings, and there may
/// be millions of terms. All are positive, so at least 75 of the 106 bits remain.
fn coefficient_sum(k: f64, n: usize, terms: Option<usize>) -> Result<DoubleDouble, SeriesError> {
    let over_k = DoubleDouble::from(1.0) / k;
    let x = over_k * over_k;
    let shift = n as f64;
    // First term: C(2n, n) / ((2n−1) 16ⁿ k^(2n−1)); for n = 0 that of m = 1, 4 / (16 k).
    let mut term = over_k / 4.0;
    if n > 0 {
        // C(2, 1) / (16 k) for n = 1, then recursively.
        term = over_k / 8.0;
        for i in 1..n {
            let i = i as f64;
            term = term * x * DoubleDouble::from(2.0 * i - 1.0) / (8.0 * (i + 1.0));
        }
    }
    let mut sum = DoubleDouble::from(0.0);
    for m in n.max(1)..=terms.unwrap_or(MAX_TERMS) {
        sum = sum + term;
        let m = m as f64;
        // The divisor is exact up to m = 94 million; later terms are some 1e-8 of the sum.
        let growth =
            DoubleDouble::two_product(m - 0.5, m + 0.5) / ((m + 1.0 - shift) * (m + 1.0 + shift));
        term = term * (x * growth);
        // The growth falls below 1 and then rises toward it, so the remainder is less than a
        // geometric series of this ratio.
        let ratio = x.high() * growth.high().max(1.0);
        if term.high() <= (1.0 - ratio) * sum.high() * NEGLIGIBLE {
            return Ok(sum);
        }
    }
    if terms.is_none() { Err(SeriesError::DoesNotEnd { k }) } else { Ok(sum) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A0, A2, A4 … A12 from the defining integral: mpmath at 70 digits, 1200 trapezoids.
    const EXPECTED: [(f64, [f64; 7]); 3] = [
        (
            1.2,
            [
                1.24891354583870660447146147,
                -0.265525379707387189824461820,
                0.0189155894153929477640364272651,
                -0.00270929787144610175569184032401,
                4.86110192627245042893302030634e-4,
                -9.77913851815473139855823582088e-5,
                2.10911334181125606688486377090e-5,
            ],
        ),
        (
            1.5,
            [
                1.18400767713286809442928484474,
                -0.190473480762433600435742446940,
                0.00692881698796131899179278932649,
                -5.04770700069047333493664885996e-4,
                4.59909376684478923728396924843e-5,
                -4.69445537162230049188166810366e-6,
                5.13485564186599063218378451246e-7,
            ],
        ),
        (
            3.0,
            [
                1.08515507419160979885234419241,
                -0.0857771443213516602634640191140,
                6.31192447026499124048336916807e-4,
                -9.28978203603151530140022453727e-6,
                1.70910474547972148959450575728e-7,
                -3.52171789916800090631217377614e-9,
                7.77510677934819561526964455650e-11,
            ],
        ),
    ];

    #[test]
    fn coefficients_are_correct_to_the_last_bit() {
        for (k, expected) in EXPECTED {
            let series = Series::new(k, 12, None).expect("k is far from 1");
            let [a0, a1, rest @ ..] = series.coefficients() else { panic!("eight coefficients") };
            assert_eq!(*a1, -1.0);
            assert_eq!((*a0, rest), (expected[0], &expected[1..]), "k = {k}");
        }
    }

    /// No terms and one term, equation (14) of the paper.
    #[test]
    fn few_terms_give_the_papers_coefficients() {
        let coefficients =
            |terms| Series::new(3.0, 4, Some(terms)).expect("few terms").coefficients().to_vec();
        assert_eq!(coefficients(0), [1.0, -1.0, 0.0, 0.0]);
        assert_eq!(coefficients(1), [13.0 / 12.0, -1.0, -1.0 / 12.0, 0.0]);
    }

    #[test]
    fn extreme_rods_end_at_once() {
        assert_eq!(
            Series::new(1.0 + 1e-12, 2, None),
            Err(SeriesError::DoesNotEnd { k: 1.0 + 1e-12 })
        );
        let long = Series::new(1e305, 4, None).expect("a long rod");
        assert_eq!(long.coefficients(), [1.0, -1.0, -0.25 / 1e305, 0.0]);
    }
}
