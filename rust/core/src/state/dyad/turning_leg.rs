//! The jet of a leg by one driver: a vector a of constant length that turns by an angle with jet u.
//! Its entries are a times i u₁, i u₂ − u₁², i u₃ − 3 u₁ u₂ − i u₁³: a term in the angle's own entry,
//! and a rest from lower ones.

use crate::math::lanes::Real;
use crate::math::vector::Vector;

/// The rest of the second entry.
#[inline(always)]
pub(super) fn second_rest<R: Real>(a: Vector<R>, u1: R) -> Vector<R> {
    -a.scale(u1 * u1)
}

/// The rest of the third entry.
#[inline(always)]
pub(super) fn third_rest<R: Real>(a: Vector<R>, u1: R, u2: R) -> Vector<R> {
    a * Vector::new(R::splat(-3.0) * (u1 * u2), -(u1 * u1 * u1))
}

/// An entry, from its rest and the angle's own entry.
#[inline(always)]
pub(super) fn entry<R: Real>(a: Vector<R>, u: R, rest: Option<Vector<R>>) -> Vector<R> {
    let top = a.left().scale(u);
    if let Some(rest) = rest { rest + top } else { top }
}
