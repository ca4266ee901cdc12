//! Plane vectors as complex numbers: multiplication rotates.

use std::ops::{Add, AddAssign, Mul, Neg, Sub};

use super::lanes::Real;
use super::trig;

/// A vector, or a unit vector that represents an orientation. With [`super::pair::Lanes`] as `R`,
/// eight of them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Vector<R = f64> {
    /// Component along x.
    pub x: R,
    /// Component along y.
    pub y: R,
}

impl<R: Real> Vector<R> {
    /// The zero vector.
    pub const ZERO: Self = Self { x: R::ZERO, y: R::ZERO };
    /// The unit vector along x: no rotation.
    pub const ONE: Self = Self { x: R::ONE, y: R::ZERO };

    /// From components.
    #[inline(always)]
    #[must_use]
    pub const fn new(x: R, y: R) -> Self {
        Self { x, y }
    }

    /// The same vector on every lane.
    #[inline(always)]
    #[must_use]
    pub fn splat(vector: Vector) -> Self {
        Self { x: R::splat(vector.x), y: R::splat(vector.y) }
    }

    /// Unit vector at an angle.
    #[inline(always)]
    #[must_use]
    pub fn at_angle(angle: R) -> Self {
        let (y, x) = trig::sin_cos(angle);
        Self { x, y }
    }

    /// A vector turned by this rotation, with fewer operations if it is along x (as every binary link).
    #[inline(always)]
    #[must_use]
    pub(crate) fn turn(self, vector: Vector) -> Self {
        if vector.y == 0.0 { self.scale(R::splat(vector.x)) } else { self * Self::splat(vector) }
    }

    /// Complex conjugate: the opposite rotation.
    #[inline(always)]
    #[must_use]
    pub fn conj(self) -> Self {
        Self { x: self.x, y: -self.y }
    }

    /// Rotated by a right angle counter-clockwise.
    #[inline(always)]
    #[must_use]
    pub fn left(self) -> Self {
        Self { x: -self.y, y: self.x }
    }

    /// Multiplied by a scalar.
    #[inline(always)]
    #[must_use]
    pub fn scale(self, factor: R) -> Self {
        Self { x: self.x * factor, y: self.y * factor }
    }

    /// Scalar product.
    #[inline(always)]
    #[must_use]
    pub fn dot(self, other: Self) -> R {
        self.x * other.x + self.y * other.y
    }

    /// Cross product: positive when `other` is to the left.
    #[inline(always)]
    #[must_use]
    pub fn cross(self, other: Self) -> R {
        self.x * other.y - self.y * other.x
    }

    /// Square of the length.
    #[inline(always)]
    #[must_use]
    pub fn norm2(self) -> R {
        self.dot(self)
    }

    /// Length. No guard against overflow: lengths are scaled to about 1.
    #[inline(always)]
    #[must_use]
    pub fn norm(self) -> R {
        self.norm2().sqrt()
    }

    /// Largest absolute component: the length to a factor of √2, without a square root.
    #[inline(always)]
    #[must_use]
    pub fn size(self) -> R {
        self.x.abs().max(self.y.abs())
    }

    /// Angle in [−π, π].
    #[inline(always)]
    #[must_use]
    pub fn angle(self) -> R {
        trig::atan2(self.y, self.x)
    }

    /// The same for a vector of length 1.
    #[inline(always)]
    #[must_use]
    pub fn unit_angle(self) -> R {
        trig::unit_angle(self.x, self.y)
    }
}

impl Vector {
    /// NaN in both components.
    pub const NAN: Self = Self { x: f64::NAN, y: f64::NAN };
}

impl<R: Real> Add for Vector<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y }
    }
}

impl<R: Real> AddAssign for Vector<R> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<R: Real> Sub for Vector<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y }
    }
}

impl<R: Real> Neg for Vector<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y }
    }
}

impl<R: Real> Mul for Vector<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self { x: self.x * other.x - self.y * other.y, y: self.x * other.y + self.y * other.x }
    }
}
