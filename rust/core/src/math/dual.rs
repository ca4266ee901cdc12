//! Dual numbers: a value and its derivative in one direction, exact to rounding (W. K. Clifford 1873; forward
//! differentiation: Wengert 1964).

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use super::lanes::Real;

/// A number and its rate.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Dual {
    pub value: f64,
    pub rate: f64,
}

impl Dual {
    pub(crate) const fn new(value: f64, rate: f64) -> Self {
        Self { value, rate }
    }

    /// Compares as numbers do; where a choice follows, its rate comes along.
    fn choose(self, other: Self, takes_first: bool) -> Self {
        if takes_first { self } else { other }
    }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.value + other.value, self.rate + other.rate)
    }
}

impl AddAssign for Dual {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.value - other.value, self.rate - other.rate)
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.value, -self.rate)
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::new(self.value * other.value, self.rate * other.value + self.value * other.rate)
    }
}

impl Div for Dual {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self::new(value, (self.rate - value * other.rate) / other.value)
    }
}

impl Real for Dual {
    type Mask = bool;
    const LANES: usize = 1;
    const PARTS: usize = 2;
    const ZERO: Self = Self::new(0.0, 0.0);
    const ONE: Self = Self::new(1.0, 0.0);

    fn splat(value: f64) -> Self {
        Self::new(value, 0.0)
    }

    fn from_lanes(mut number: impl FnMut(usize) -> f64) -> Self {
        Self::splat(number(0))
    }

    fn of_parts(numbers: &[f64]) -> Self {
        Self::new(numbers[0], numbers[1])
    }

    fn of_block(column: &[f64], row: usize, width: usize, entry: usize) -> Self {
        Self::of_parts(&column[2 * (row * width + entry)..])
    }

    fn lane(self, _: usize) -> f64 {
        self.value
    }

    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        Self::new(root, 0.5 * self.rate / root)
    }

    fn abs(self) -> Self {
        if self.value.is_sign_negative() { -self } else { self }
    }

    fn max(self, other: Self) -> Self {
        self.choose(other, self.value > other.value)
    }

    fn min(self, other: Self) -> Self {
        self.choose(other, self.value < other.value)
    }

    fn floor(self) -> Self {
        Self::splat(self.value.floor())
    }

    fn copysign(self, sign: Self) -> Self {
        if self.value.is_sign_negative() == sign.value.is_sign_negative() { self } else { -self }
    }

    fn lt(self, other: Self) -> bool {
        self.value < other.value
    }

    fn le(self, other: Self) -> bool {
        self.value <= other.value
    }

    fn bit(self, bit: u32) -> bool {
        self.value.bit(bit)
    }

    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against derivatives known in closed form.
    #[test]
    fn rates_are_derivatives() {
        let x = Dual::new(0.7, 1.0);
        let three = Dual::splat(3.0);
        let cases = [
            (x * x * x, 3.0 * 0.49),
            (three / x, -3.0 / 0.49),
            (x.sqrt(), 0.5 / 0.7_f64.sqrt()),
            ((-x).abs(), 1.0),
            (x - three * x, -2.0),
            (Real::max(x, three), 0.0),
            (Real::min(x, three), 1.0),
            (x.copysign(-three), -1.0),
            (x.floor(), 0.0),
        ];
        for (found, rate) in cases {
            assert!((found.rate - rate).abs() < 1e-15, "{found:?} has not the rate {rate}");
        }
    }
}
