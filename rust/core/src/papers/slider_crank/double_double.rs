//! Double-double arithmetic, for sums that must be correct to the last bit.

use std::ops::{Add, Div, Mul};

/// The unevaluated sum `high` + `low`, where `high` is the rounded sum. About 106 bits.
///
/// T. J. Dekker, *Numerische Mathematik* 18 (1971), 224; with the fused multiply-add: M. Joldes,
/// J.-M. Muller and V. Popescu, *ACM Transactions on Mathematical Software* 44(2) (2017), 15, which
/// bounds the error of each algorithm; u = 2^-53.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    /// Rounded to one number.
    pub(crate) fn high(self) -> f64 {
        self.high
    }

    /// a + b exactly (D. E. Knuth, *The Art of Computer Programming* 2, theorem 4.2.2 B).
    fn two_sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let b_part = high - a;
        Self { high, low: (a - (high - b_part)) + (b - b_part) }
    }

    /// The same, for |a| ≥ |b| or a = 0 (Dekker, 4.7).
    fn fast_two_sum(a: f64, b: f64) -> Self {
        let high = a + b;
        Self { high, low: b - (high - a) }
    }

    /// a b exactly, unless it is below 1e-291, where the remainder underflows (T. Ogita, S. M. Rump
    /// and S. Oishi, *SIAM Journal on Scientific Computing* 26 (2005), 1955).
    ///
    /// The fused multiply-add gives the same bits where it is emulated, and unlike Dekker's
    /// splitting does not overflow.
    pub(crate) fn two_product(a: f64, b: f64) -> Self {
        let high = a * b;
        Self { high, low: a.mul_add(b, -high) }
    }
}

impl From<f64> for DoubleDouble {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

/// Joldes, Muller and Popescu, algorithm 6: within 3 u² for a sum that does not cancel.
impl Add for DoubleDouble {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (highs, lows) =
            (Self::two_sum(self.high, other.high), Self::two_sum(self.low, other.low));
        let sum = Self::fast_two_sum(highs.high, highs.low + lows.high);
        Self::fast_two_sum(sum.high, sum.low + lows.low)
    }
}

/// Algorithm 11 (Dekker's `mul2`): within 6 u².
impl Mul for DoubleDouble {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let product = Self::two_product(self.high, other.high);
        let crossed = self.low.mul_add(other.high, self.high * other.low);
        Self::fast_two_sum(product.high, product.low + crossed)
    }
}

/// Algorithm 15: within 3 u².
impl Div<f64> for DoubleDouble {
    type Output = Self;

    fn div(self, divisor: f64) -> Self {
        let quotient = self.high / divisor;
        // The remainder is a double: this is exact.
        let remainder = (-quotient).mul_add(divisor, self.high);
        Self::fast_two_sum(quotient, (remainder + self.low) / divisor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const U: f64 = f64::EPSILON / 2.0;

    #[test]
    fn the_low_part_holds_the_rounding_error() {
        let x = 1.0 + 2.0 * U;
        assert_eq!(
            DoubleDouble::two_product(x, x),
            DoubleDouble { high: 1.0 + 4.0 * U, low: 4.0 * U * U }
        );
        let tiny = DoubleDouble::from(1.0) + DoubleDouble::from(U * U);
        assert_eq!(tiny, DoubleDouble { high: 1.0, low: U * U });
        assert_eq!(tiny + DoubleDouble::from(-1.0), DoubleDouble::from(U * U));
        assert_eq!(tiny * DoubleDouble::from(3.0), DoubleDouble { high: 3.0, low: 3.0 * U * U });
    }

    #[test]
    fn three_thirds_are_one() {
        let third = DoubleDouble::from(1.0) / 3.0;
        // 0.0101…, cut after a 1: a third of 2^-54 is lost.
        assert_eq!(third, DoubleDouble { high: 1.0 / 3.0, low: U / 6.0 });
        let rest = third * DoubleDouble::from(3.0) + DoubleDouble::from(-1.0);
        assert!(rest.high().abs() <= 9.0 * U * U, "{rest:?}");
    }
}
