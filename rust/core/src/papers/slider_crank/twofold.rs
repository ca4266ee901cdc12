//! Numbers of twice the digits, for sums whose last bit must be right.

use std::ops::{Add, Div, Mul};

/// The sum `high` + `low`, not carried out; `high` is that sum rounded. About 106 bits.
///
/// T. J. Dekker, *Numerische Mathematik* 18 (1971), 224; with the fused multiply-add: M. Joldes,
/// J.-M. Muller and V. Popescu, *ACM Transactions on Mathematical Software* 44(2) (2017), 15, where
/// each algorithm's error is bounded: u = 2^-53.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Twofold {
    high: f64,
    low: f64,
}

impl Twofold {
    /// Rounded to one number.
    pub(crate) fn high(self) -> f64 {
        self.high
    }

    /// a + b, exactly (D. E. Knuth, *The Art of Computer Programming* 2, theorem 4.2.2 B).
    fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let back = high - a;
        Self { high, low: (a - (high - back)) + (b - back) }
    }

    /// The same, for |a| ≥ |b| or a = 0 (Dekker, 4.7).
    fn sum_falling(a: f64, b: f64) -> Self {
        let high = a + b;
        Self { high, low: b - (high - a) }
    }

    /// a b, exactly unless it is below 1e-291, where the least numbers are too great for what is left
    /// (T. Ogita, S. M. Rump and S. Oishi, *SIAM Journal on Scientific Computing* 26 (2005), 1955).
    ///
    /// The fused multiply-add gives the same bits where the processor has none, and does not
    /// overflow as Dekker's halves do.
    pub(crate) fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        Self { high, low: a.mul_add(b, -high) }
    }
}

impl From<f64> for Twofold {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

/// Joldes, Muller and Popescu, algorithm 6: within 3 u² for a sum that does not cancel.
impl Add for Twofold {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (highs, lows) = (Self::sum(self.high, other.high), Self::sum(self.low, other.low));
        let most = Self::sum_falling(highs.high, highs.low + lows.high);
        Self::sum_falling(most.high, most.low + lows.low)
    }
}

/// Algorithm 11 (Dekker's `mul2`): within 6 u².
impl Mul for Twofold {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        let crossed = self.low.mul_add(other.high, self.high * other.low);
        Self::sum_falling(product.high, product.low + crossed)
    }
}

/// Algorithm 15: within 3 u².
impl Div<f64> for Twofold {
    type Output = Self;

    fn div(self, divisor: f64) -> Self {
        let quotient = self.high / divisor;
        // What is left is a number of its own: nothing is lost.
        let left = (-quotient).mul_add(divisor, self.high);
        Self::sum_falling(quotient, (left + self.low) / divisor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const U: f64 = f64::EPSILON / 2.0;

    #[test]
    fn what_rounding_loses_is_kept() {
        let x = 1.0 + 2.0 * U;
        assert_eq!(Twofold::product(x, x), Twofold { high: 1.0 + 4.0 * U, low: 4.0 * U * U });
        let tiny = Twofold::from(1.0) + Twofold::from(U * U);
        assert_eq!(tiny, Twofold { high: 1.0, low: U * U });
        assert_eq!(tiny + Twofold::from(-1.0), Twofold::from(U * U));
        assert_eq!(tiny * Twofold::from(3.0), Twofold { high: 3.0, low: 3.0 * U * U });
    }

    #[test]
    fn a_third_three_times_is_one() {
        let third = Twofold::from(1.0) / 3.0;
        // 0.0101…, cut after a 1: a third of 2^-54 is lost.
        assert_eq!(third, Twofold { high: 1.0 / 3.0, low: U / 6.0 });
        let rest = third * Twofold::from(3.0) + Twofold::from(-1.0);
        assert!(rest.high().abs() <= 9.0 * U * U, "{rest:?}");
    }
}
