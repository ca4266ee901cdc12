//! Constants of one design in the closed forms of its dyads.

use super::leg::Leg;
use crate::math::lanes::Real;
use crate::math::tolerance::FLAT_CLOSURE;
use crate::math::vector::Vector;

/// The sides of a triangle of two legs and the chord between their ends.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Sides<R = f64> {
    /// (a + b)²
    pub sum2: R,
    /// (a − b)²
    pub difference2: R,
    /// a² − b²
    pub split: R,
    /// The square of the chord may exceed `sum2` and fall below `difference2` by these: the triangle still
    /// counts as flat.
    pub tolerances: [R; 2],
    /// 1 / (4 a² b²)
    pub per_sine2: R,
    /// Lower bound of ((a + b)² − d²)(d² − (a − b)²) for legs and a chord d that close within these
    /// tolerances.
    pub open_area2: R,
}

impl<R: Real> Sides<R> {
    #[inline(always)]
    pub(crate) fn of(a: &Leg<R>, b: &Leg<R>) -> Self {
        let (sum, difference) = (a.norm + b.norm, a.norm - b.norm);
        // The chord of a flat triangle is as long as the sum or the difference of the legs. A small
        // relative error of the chord doubles in its square.
        let within = R::splat(2.0 * FLAT_CLOSURE);
        let per_sine2 = R::splat(0.25) * (a.inv_norm2 * b.inv_norm2);
        // Within the tolerances, (sum² − d²)(d² − difference²) is at least minus the greater tolerance times
        // the other factor, at most 4 a b plus the same tolerance; twice that is safe.
        let excess = within * (sum * sum);
        let lower_bound = R::splat(-2.0) * (excess * (R::splat(4.0) * (a.norm * b.norm) + excess));
        Self {
            open_area2: lower_bound,
            per_sine2,
            sum2: sum * sum,
            difference2: difference * difference,
            // Keeps digits when a ≈ b.
            split: difference * sum,
            tolerances: [excess, within * (a.norm.max(b.norm) * difference.abs())],
        }
    }
}

impl Sides {
    /// The same sides on every lane.
    #[inline(always)]
    pub(crate) fn on_lanes<R: Real>(&self) -> Sides<R> {
        Sides {
            sum2: R::splat(self.sum2),
            difference2: R::splat(self.difference2),
            split: R::splat(self.split),
            tolerances: [R::splat(self.tolerances[0]), R::splat(self.tolerances[1])],
            per_sine2: R::splat(self.per_sine2),
            open_area2: R::splat(self.open_area2),
        }
    }
}

/// Constants of one dyad.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct DyadConstants {
    /// Sides of the triangle of two legs.
    pub sides: Sides,
    /// The fixed part of its loop.
    pub offset: Vector,
    /// Directions of its guides; that of a guide that turns is in the frame of its class.
    pub guides: [Vector; 2],
    /// Upper bound of the lengths of its chord and legs.
    pub reach: f64,
    /// Greatest distance of its inner joint from the origin.
    pub inner_reach: f64,
    /// Inverse of an upper bound of the squared arm in its condition.
    pub inverse_arm2: f64,
    /// [`Sides::per_sine2`] times that.
    pub bounding_per_sine2: f64,
}
