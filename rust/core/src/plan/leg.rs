//! A leg of a dyad: what turns with one of its unknown rotations.

use crate::math::lanes::Real;
use crate::math::vector::Vector;

/// What turns with an unknown rotation of a dyad.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Leg<R = f64> {
    /// In the frame of the class.
    pub vector: Vector<R>,
    /// Its length.
    pub norm: R,
    /// The square of that.
    pub norm2: R,
    /// 1/length².
    pub inv_norm2: R,
}

impl<R: Real> Leg<R> {
    /// Measures a vector.
    #[inline(always)]
    pub(crate) fn of(vector: Vector<R>) -> Self {
        let norm2 = vector.norm2();
        Self { vector, norm: norm2.sqrt(), norm2, inv_norm2: R::ONE / norm2 }
    }

    /// 1/length.
    #[inline(always)]
    pub(crate) fn inv_norm(&self) -> R {
        self.norm * self.inv_norm2
    }

    /// The rotation that brings it to a place.
    #[inline(always)]
    pub(crate) fn turn_to(&self, place: Vector<R>) -> Vector<R> {
        (place * self.vector.conj()).scale(self.inv_norm2)
    }
}

impl Leg {
    /// The same on every lane.
    #[inline(always)]
    pub(crate) fn on_lanes<R: Real>(&self) -> Leg<R> {
        Leg {
            vector: Vector::splat(self.vector),
            norm: R::splat(self.norm),
            norm2: R::splat(self.norm2),
            inv_norm2: R::splat(self.inv_norm2),
        }
    }
}
