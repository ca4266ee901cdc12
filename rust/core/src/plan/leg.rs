//! The leg of a dyad: the side that turns with one of its unknowns.

use crate::math::lanes::Real;
use crate::math::vector::Vector;

/// The sum of the constant vectors that turn with one unknown rotation, and its length.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Leg<R = f64> {
    /// Vector in the frame of the class.
    pub vector: Vector<R>,
    /// Length.
    pub norm: R,
    /// Length².
    pub norm2: R,
    /// 1/length².
    pub inv_norm2: R,
    /// 1/vector, as complex numbers.
    pub inverse: Vector<R>,
    /// Whether it is known to be along x, as that of every binary link.
    pub along_x: bool,
}

impl<R: Real> Leg<R> {
    /// The leg with this vector.
    #[inline(always)]
    pub(crate) fn of(vector: Vector<R>) -> Self {
        let norm2 = vector.norm2();
        let inv_norm2 = R::ONE / norm2;
        let inverse = vector.conj().scale(inv_norm2);
        Self { vector, norm: norm2.sqrt(), norm2, inv_norm2, inverse, along_x: false }
    }

    /// 1/length.
    #[inline(always)]
    pub(crate) fn inv_norm(&self) -> R {
        self.norm * self.inv_norm2
    }

    /// The rotation that turns the leg to a vector of the same length.
    #[inline(always)]
    pub(crate) fn turn_to(&self, turned: Vector<R>) -> Vector<R> {
        if self.along_x { turned.scale(self.inverse.x) } else { turned * self.inverse }
    }
}

impl Leg {
    /// The leg of one design.
    pub(crate) fn constant(vector: Vector) -> Self {
        Self { along_x: vector.y == 0.0, ..Self::of(vector) }
    }

    /// A vector that turns with the leg, divided by it; without a leg, the vector itself.
    pub(crate) fn part(&self, vector: Vector) -> Vector {
        if self.norm2 == 0.0 { vector } else { self.turn_to(vector) }
    }

    /// The same leg on every lane.
    #[inline(always)]
    pub(crate) fn on_lanes<R: Real>(&self) -> Leg<R> {
        Leg {
            vector: Vector::splat(self.vector),
            norm: R::splat(self.norm),
            norm2: R::splat(self.norm2),
            inv_norm2: R::splat(self.inv_norm2),
            inverse: Vector::splat(self.inverse),
            along_x: self.along_x,
        }
    }
}
