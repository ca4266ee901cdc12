//! Vectors of the plane as complex numbers: turning is multiplication.

use std::ops::{Add, AddAssign, Mul, Neg, Sub};

/// A vector (or a unit vector standing for an orientation).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Vector {
    /// Component along x.
    pub x: f64,
    /// Component along y.
    pub y: f64,
}

impl Vector {
    /// The zero vector.
    pub const ZERO: Self = Self { x: 0.0, y: 0.0 };
    /// No turn.
    pub const ONE: Self = Self { x: 1.0, y: 0.0 };
    /// Neither component is a number.
    pub const NAN: Self = Self { x: f64::NAN, y: f64::NAN };

    /// From components.
    #[inline]
    #[must_use]
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// Unit vector at an angle.
    #[inline]
    #[must_use]
    pub fn at_angle(angle: f64) -> Self {
        let (y, x) = angle.sin_cos();
        Self { x, y }
    }

    /// Turned by the same angle to the other side.
    #[inline]
    #[must_use]
    pub fn conj(self) -> Self {
        Self { x: self.x, y: -self.y }
    }

    /// Turned by a right angle, counter-clockwise.
    #[inline]
    #[must_use]
    pub fn left(self) -> Self {
        Self { x: -self.y, y: self.x }
    }

    /// Stretched.
    #[inline]
    #[must_use]
    pub fn scale(self, factor: f64) -> Self {
        Self { x: self.x * factor, y: self.y * factor }
    }

    /// Scalar product.
    #[inline]
    #[must_use]
    pub fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y
    }

    /// Vector product: positive when `other` is to the left.
    #[inline]
    #[must_use]
    pub fn cross(self, other: Self) -> f64 {
        self.x * other.y - self.y * other.x
    }

    /// Square of the length.
    #[inline]
    #[must_use]
    pub fn norm2(self) -> f64 {
        self.dot(self)
    }

    /// Length (no guard against overflow: lengths are scaled to about 1).
    #[inline]
    #[must_use]
    pub fn norm(self) -> f64 {
        self.norm2().sqrt()
    }

    /// Angle in (−π, π].
    #[inline]
    #[must_use]
    pub fn angle(self) -> f64 {
        self.y.atan2(self.x)
    }
}

impl Add for Vector {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y }
    }
}

impl AddAssign for Vector {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sub for Vector {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y }
    }
}

impl Neg for Vector {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y }
    }
}

impl Mul for Vector {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self { x: self.x * other.x - self.y * other.y, y: self.x * other.y + self.y * other.x }
    }
}
