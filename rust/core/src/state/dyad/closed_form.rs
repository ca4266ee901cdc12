//! Closed forms of dyads: one vector equation with two unknowns, solved by square roots and
//! divisions only.

use crate::math::lanes::{Mask, Real};
use crate::math::tolerance::FLAT_CLOSURE;
use crate::math::vector::Vector;
use crate::plan::leg::Leg;

/// Outcome of a dyad's closed form.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DyadSolution<R: Real> {
    /// Lanes where it does not close.
    pub open: R::Mask,
    /// By how much it does not close, relative to the scale (used with one lane only).
    pub gap: R,
    /// By how much it closes, relative to the scale; negative where it does not.
    pub margin: R,
    /// Lanes where it is flat: the two solutions coincide to rounding.
    pub flat: R::Mask,
    /// Square of the sine of the angle between the columns of the closure matrix: between
    /// the legs of two binary links.
    pub sine2: R,
    /// Square of the greatest arm that turns with a leg, divided by the leg's length²; at least 1.
    /// The norm of the inverse of the scaled closure matrix is this arm divided by the sine.
    pub arm2: R,
}

impl<R: Real> DyadSolution<R> {
    /// Sets the arms of the legs.
    #[inline(always)]
    pub(crate) fn with_arm2(self, arm2: R) -> Self {
        Self { arm2: arm2.max(R::ONE), ..self }
    }
}

/// A factor that vanishes where the dyad is flat. If it is negative within rounding, the dyad
/// counts as flat; if it is more negative, as open.
struct Factor<R: Real> {
    value: R,
    flat: R::Mask,
    open: R::Mask,
}

impl<R: Real> Factor<R> {
    #[inline(always)]
    fn of(difference: R, size: R) -> Self {
        let positive = R::ZERO.lt(difference);
        let within = (R::splat(-FLAT_CLOSURE) * size).le(difference);
        let value = R::select(positive, difference, R::ZERO);
        Self { value, flat: positive.not().and(within), open: positive.or(within).not() }
    }

    /// The missing length where it is open, else `or`.
    #[inline(always)]
    fn gap(&self, difference: R, or: R) -> R {
        R::select(self.open, -difference, or)
    }
}

/// `a u₁ + b u₂ = k` for unit vectors u₁, u₂: the intersection of two circles. Gives the legs
/// `a u₁` and `b u₂` (see [`Leg::turn_to`]). `sign` > 0: `a u₁` points to the left of `k`.
#[inline(always)]
pub(crate) fn two_circles<R: Real>(
    a: &Leg<R>,
    b: &Leg<R>,
    k: Vector<R>,
    sign: R,
) -> (Vector<R>, Vector<R>, DyadSolution<R>) {
    let d2 = k.norm2();
    let d = d2.sqrt();
    let (sum, difference) = (a.norm + b.norm, a.norm - b.norm);
    let size = a.norm.max(b.norm).max(d);
    let outer = Factor::of(sum - d, size);
    let inner = Factor::of(d - difference.abs(), size);
    // Outer joints coincide, or a leg has no length: any attitude closes.
    let loose = R::ZERO.lt(d2.min(a.norm2).min(b.norm2)).not();
    // Heron: (2 d h)² = (a+b−d)(a+b+d)(d−a+b)(d+a−b), h the height on k.
    let area2 = outer.value * (sum + d) * inner.value * (d + difference.abs());
    let area = area2.sqrt();
    let half = R::splat(0.5) / d2;
    // Along and across k, as parts of it; (a−b)(a+b) keeps digits when a ≈ b.
    let split = difference * sum;
    let (x, y) = ((d2 + split) * half, sign * area * half);
    let first = k * Vector::new(x, y);
    let second = k * Vector::new((d2 - split) * half, -y);
    let far = size.finite().not();
    let gap = outer.gap(sum - d, inner.gap(d - difference.abs(), R::ZERO));
    let solved = DyadSolution {
        open: outer.open.or(inner.open).or(loose).or(far),
        gap: R::select(far, R::splat(f64::INFINITY), gap),
        margin: (sum - d).min(d - difference.abs()),
        flat: outer.flat.or(inner.flat),
        // `area` is four times the triangle's: (2 a b sin)² = area².
        sine2: area2 * (R::splat(0.25) * a.inv_norm2 * b.inv_norm2),
        arm2: R::ONE,
    };
    (first, second, solved)
}

/// `a u + s b = k` for a unit vector u and a slide s along the unit vector b: a
/// circle and a line. `sign` > 0: the slide is ahead of the foot of the
/// perpendicular from the circle's centre.
#[inline(always)]
pub(crate) fn circle_and_line<R: Real>(
    a: &Leg<R>,
    b: Vector<R>,
    k: Vector<R>,
    sign: R,
) -> (Vector<R>, R, DyadSolution<R>) {
    let (along, across) = (b.dot(k), b.cross(k));
    let size = a.norm.max(k.size());
    let inner = Factor::of(a.norm - across.abs(), size);
    let chord2 = inner.value * (a.norm + across.abs());
    let signed = sign * chord2.sqrt();
    let leg = b * Vector::new(-signed, across);
    let far = size.finite().not();
    let solved = DyadSolution {
        open: inner.open.or(R::ZERO.lt(a.norm2).not()).or(far),
        gap: R::select(far, R::splat(f64::INFINITY), inner.gap(a.norm - across.abs(), R::ZERO)),
        margin: a.norm - across.abs(),
        flat: inner.flat,
        sine2: chord2 * a.inv_norm2,
        arm2: R::ONE,
    };
    ((leg * a.vector.conj()).scale(a.inv_norm2), along + signed, solved)
}

/// `(a + s b) u = k` for a unit vector u and a slide s along the unit vector b
/// that turns with it. `sign` > 0: the slide is above the value at which it is
/// nearest to the far joint. Third: 1/|k|².
#[inline(always)]
pub(crate) fn turning_guide<R: Real>(
    a: Vector<R>,
    b: Vector<R>,
    k: Vector<R>,
    sign: R,
) -> (Vector<R>, R, R, DyadSolution<R>) {
    let (along, across) = (b.dot(a), b.cross(a));
    let d2 = k.norm2();
    let d = d2.sqrt();
    let size = d.max(a.size());
    let inner = Factor::of(d - across.abs(), size);
    let chord2 = inner.value * (d + across.abs());
    let signed = sign * chord2.sqrt();
    let arm = b * Vector::new(signed, across);
    let per = R::ONE / d2;
    let far = size.finite().not();
    let solved = DyadSolution {
        // The far joint is on the guide's own pivot: every attitude closes.
        open: inner.open.or(R::ZERO.lt(d2).not()).or(far),
        gap: R::select(far, R::splat(f64::INFINITY), inner.gap(d - across.abs(), R::ZERO)),
        margin: d - across.abs(),
        flat: inner.flat,
        sine2: chord2 * per,
        arm2: R::ONE,
    };
    ((k * arm.conj()).scale(per), signed - along, per, solved)
}

/// `s a + t b = k` for two slides along unit vectors (Cramer).
#[inline(always)]
pub(crate) fn two_lines<R: Real>(
    a: Vector<R>,
    b: Vector<R>,
    k: Vector<R>,
) -> (R, R, DyadSolution<R>) {
    let determinant = a.cross(b);
    let (s, t) = (k.cross(b) / determinant, a.cross(k) / determinant);
    let solved = DyadSolution {
        open: s.finite().and(t.finite()).not(),
        gap: R::splat(f64::INFINITY),
        margin: R::ONE,
        flat: R::Mask::NONE,
        sine2: determinant * determinant,
        arm2: R::ONE,
    };
    (s, t, solved)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOLERANCE: f64 = 1e-15;

    fn leg(x: f64, y: f64) -> Leg {
        Leg::of(Vector::new(x, y))
    }

    #[test]
    fn right_triangle_three_four_five() {
        let (a, b) = (leg(3.0, 0.0), leg(4.0, 0.0));
        let (first, second, solved) = two_circles(&a, &b, Vector::new(5.0, 0.0), 1.0);
        let (u, v) = (a.turn_to(first), b.turn_to(second));
        assert!(!solved.flat && !solved.open && (solved.sine2 - 1.0).abs() < TOLERANCE);
        assert!((u.x - 0.6).abs() < TOLERANCE && (u.y - 0.8).abs() < TOLERANCE);
        assert!((v.x - 0.8).abs() < TOLERANCE && (v.y + 0.6).abs() < TOLERANCE);
    }

    #[test]
    fn circles_that_do_not_meet_report_the_gap() {
        let unit = leg(1.0, 0.0);
        let (_, _, solved) = two_circles(&unit, &unit, Vector::new(2.5, 0.0), 1.0);
        assert!(solved.open && (solved.gap - 0.5).abs() < TOLERANCE);
    }

    #[test]
    fn circle_meets_line_on_the_named_side() {
        let (a, b) = (Vector::new(5.0, 0.0), Vector::new(1.0, 0.0));
        let k = Vector::new(10.0, 3.0);
        for sign in [1.0, -1.0] {
            let (u, s, _) = circle_and_line(&Leg::of(a), b, k, sign);
            assert!((s - (10.0 + sign * 4.0)).abs() < TOLERANCE * 10.0);
            let closed = u * a + b.scale(s) - k;
            assert!(closed.norm() < 1e-14);
        }
    }

    #[test]
    fn turning_guide_closes() {
        let (a, b) = (Vector::new(0.3, 0.4), Vector::new(0.6, 0.8));
        let k = Vector::new(-1.0, 2.0);
        for sign in [1.0, -1.0] {
            let (u, s, _, _) = turning_guide(a, b, k, sign);
            assert!(((a + b.scale(s)) * u - k).norm() < 1e-14);
            assert!((u.norm() - 1.0).abs() < 1e-14);
        }
    }
}
