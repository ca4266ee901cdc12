//! The stroke as a cosine series, each coefficient itself a series.

use super::jet::Jet;
use super::twofold::Twofold;
use crate::math::trig::sin_cos;

/// Terms of one coefficient, at most: for k − 1 of 1e-6 some ten millions are needed.
const MOST_TERMS: usize = 100_000_000;
/// Part of a sum that adds nothing to its 53 bits: 1/64 of half a unit in the last place.
const NOTHING: f64 = f64::EPSILON / 256.0;

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
    /// 1 more; A1 = −1. From the binomial series of cos δ and the powers of the sine. Each is within
    /// 0.51 units in its last place (below 1e-300, within two).
    ///
    /// # Errors
    ///
    /// [`SlowSeries`].
    pub fn new(k: f64, harmonics: usize, terms: Option<usize>) -> Result<Self, SlowSeries> {
        // Not even A0's series would end: its last term, x^m / (2π m²) with x^m above e^-16, is some
        // 30 times too great.
        if terms.is_none() && (k * k - 1.0) * (MOST_TERMS as f64) < 16.0 {
            return Err(SlowSeries { k });
        }
        let mut coefficients = vec![(Twofold::from(1.0) + inner(k, 0, terms)?).high()];
        if harmonics >= 1 {
            coefficients.push(-1.0);
        }
        for n in 1..=harmonics / 2 {
            let sign = if n % 2 == 0 { 1.0 } else { -1.0 };
            coefficients.push(sign * 2.0 * inner(k, n, terms)?.high());
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
///
/// With twice the digits throughout: a term is a product of some 5 m roundings, and there may be
/// millions of terms. All are positive, so that of 106 bits at least 75 are left.
fn inner(k: f64, n: usize, terms: Option<usize>) -> Result<Twofold, SlowSeries> {
    let over_k = Twofold::from(1.0) / k;
    let x = over_k * over_k;
    let shift = n as f64;
    // The first term: C(2n, n) / ((2n−1) 16ⁿ k^(2n−1)), of n = 0 that of m = 1: 4 / (16 k).
    let mut term = over_k / 4.0;
    if n > 0 {
        // C(2, 1) / (16 k) for n = 1, and from one n to the next.
        term = over_k / 8.0;
        for i in 1..n {
            let i = i as f64;
            term = term * x * Twofold::from(2.0 * i - 1.0) / (8.0 * (i + 1.0));
        }
    }
    let mut sum = Twofold::from(0.0);
    for m in n.max(1)..=terms.unwrap_or(MOST_TERMS) {
        sum = sum + term;
        let m = m as f64;
        // The divisor is exact to m of 94 millions; later terms are some 1e-8 of the sum.
        let growth = Twofold::product(m - 0.5, m + 0.5) / ((m + 1.0 - shift) * (m + 1.0 + shift));
        term = term * (x * growth);
        // Growth falls below 1 and then rises to it, so that what is left is less than a geometric
        // series of this ratio.
        let ratio = x.high() * growth.high().max(1.0);
        if term.high() <= (1.0 - ratio) * sum.high() * NOTHING {
            return Ok(sum);
        }
    }
    if terms.is_none() { Err(SlowSeries { k }) } else { Ok(sum) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A0, A2, A4 … A12 by the integral that defines them: mpmath at 70 digits, 1200 trapezoids.
    const WANTED: [(f64, [f64; 7]); 3] = [
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
    fn coefficients_to_the_last_bit() {
        for (k, wanted) in WANTED {
            let series = Series::new(k, 12, None).expect("k is far from 1");
            let [a0, a1, others @ ..] = series.coefficients() else {
                panic!("eight are asked for")
            };
            assert_eq!(*a1, -1.0);
            assert_eq!((*a0, others), (wanted[0], &wanted[1..]), "k = {k}");
        }
    }

    /// Of no terms and of one: (14) of the paper, and nothing beyond.
    #[test]
    fn few_terms() {
        let of = |terms| Series::new(3.0, 4, Some(terms)).expect("it ends").coefficients().to_vec();
        assert_eq!(of(0), [1.0, -1.0, 0.0, 0.0]);
        assert_eq!(of(1), [13.0 / 12.0, -1.0, -1.0 / 12.0, 0.0]);
    }

    #[test]
    fn long_and_short_rods() {
        assert_eq!(Series::new(1.0 + 1e-12, 2, None), Err(SlowSeries { k: 1.0 + 1e-12 }));
        let long = Series::new(1e305, 4, None).expect("it ends at once");
        assert_eq!(long.coefficients(), [1.0, -1.0, -0.25 / 1e305, 0.0]);
    }
}
