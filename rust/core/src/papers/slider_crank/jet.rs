//! A function of the crank angle with its first and second derivatives.

use std::ops::{Add, Div, Mul, Sub};

use crate::math::trig::sin_cos;

/// Value, first and second derivative by the crank angle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Jet(pub [f64; 3]);

impl Jet {
    /// A constant.
    #[must_use]
    pub const fn constant(value: f64) -> Self {
        Self([value, 0.0, 0.0])
    }

    /// Sine and cosine of the crank angle.
    #[must_use]
    pub fn sin_cos(angle: f64) -> (Self, Self) {
        let (s, c) = sin_cos(angle);
        (Self([s, c, -s]), Self([c, -s, -c]))
    }

    /// 1 − cos of the angle, accurate where the angle is small.
    #[must_use]
    pub fn versine(angle: f64) -> Self {
        let (half, _) = sin_cos(0.5 * angle);
        let (s, c) = sin_cos(angle);
        Self([2.0 * half * half, s, c])
    }

    /// Multiplied by a number.
    #[must_use]
    pub fn scale(self, factor: f64) -> Self {
        Self(self.0.map(|x| factor * x))
    }

    /// Square root.
    #[must_use]
    pub fn sqrt(self) -> Self {
        let [x, x1, x2] = self.0;
        let root = x.sqrt();
        let first = 0.5 * x1 / root;
        Self([root, first, (0.5 * x2 - first * first) / root])
    }

    /// Integer power, `n` at least 1.
    #[must_use]
    pub fn power(self, n: u32) -> Self {
        (1..n).fold(self, |product, _| product * self)
    }
}

impl Add for Jet {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] + other.0[k]))
    }
}

impl Sub for Jet {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] - other.0[k]))
    }
}

impl Mul for Jet {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let ([a, a1, a2], [b, b1, b2]) = (self.0, other.0);
        Self([a * b, a1 * b + a * b1, a2 * b + 2.0 * a1 * b1 + a * b2])
    }
}

impl Div for Jet {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let ([a, a1, a2], [b, b1, b2]) = (self.0, other.0);
        let q = a / b;
        let q1 = (a1 - q * b1) / b;
        Self([q, q1, (a2 - 2.0 * q1 * b1 - q * b2) / b])
    }
}
