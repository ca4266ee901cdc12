//! Small turns of unit vectors.

use crate::math::lanes::Real;
use crate::math::vector::Vector;

/// A unit vector turned by a small angle: by Taylor polynomials of the third degree, then
/// normalised by one Newton step for 1/√.
#[inline(always)]
pub(crate) fn turned<R: Real>(unit: Vector<R>, angle: R) -> Vector<R> {
    let half2 = angle * angle * R::splat(0.5);
    let turn = Vector::new(R::ONE - half2, angle * (R::ONE - half2 * R::splat(1.0 / 3.0)));
    let new = unit * turn;
    new.scale(R::splat(1.5) - R::splat(0.5) * new.norm2())
}
