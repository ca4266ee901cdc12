//! Closed forms of dyads: one vector equation with two unknowns, with one square root and at most
//! one division.
//!
//! `CHECKED` adds margin, gap and exact masks, and gives the values of the flat dyad where a dyad is
//! flat or open. All other positions have the same bits without it.

use crate::math::lanes::{Mask, Real};
use crate::math::tolerance::FLAT_CLOSURE;
use crate::math::vector::Vector;
use crate::plan::dyad_constants::Sides;
use crate::plan::leg::Leg;
use crate::state::closing::Closing;
use crate::state::status::FLAT2;

/// `value` where it is positive, else 0; NaN becomes 0.
#[inline(always)]
fn positive<R: Real>(value: R) -> R {
    value.max(R::ZERO)
}

/// Lanes where both solutions coincide, or would if the dyad closed: its values are those of the
/// flat dyad.
#[inline(always)]
fn degenerate<R: Real>(product: R, sine2: R) -> R::Mask {
    R::ZERO.lt(product).not().or(sine2.lt(R::splat(FLAT2)))
}

/// `a u₁ + b u₂ = k` for unit vectors u₁, u₂: the intersection of two circles.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TwoCircles<R: Real> {
    /// The legs `a u₁` and `b u₂`.
    pub legs: [Vector<R>; 2],
    /// 1 / (`a u₁` × `b u₂`)
    pub inverse_determinant: R,
    pub closing: Closing<R>,
}

impl<R: Real> TwoCircles<R> {
    /// `sign` > 0: `a u₁` points to the left of `k`.
    #[inline(always)]
    pub(crate) fn solve<const CHECKED: bool>(
        [a, b]: [&Leg<R>; 2],
        sides: &Sides<R>,
        k: Vector<R>,
        sign: R,
    ) -> Self {
        let d2 = k.norm2();
        let (outer, inner) = (sides.sum2 - d2, d2 - sides.difference2);
        let [outer_limit, inner_limit] = [-sides.tolerances[0], -sides.tolerances[1]];
        // Heron: (2 d h)² = ((a+b)² − d²)(d² − (a−b)²), h the height on k.
        let area2 = if CHECKED { positive(outer) * positive(inner) } else { outer * inner };
        let sine2 = area2 * sides.per_sine2;
        let mut open = area2.lt(sides.open_area2);
        if CHECKED {
            // Outer joints coincide, or a leg has no length: any attitude closes.
            let loose = R::ZERO.lt(d2.min(a.norm2).min(b.norm2)).not();
            open = outer_limit.le(outer).and(inner_limit.le(inner)).not().or(loose);
        }
        let area = area2.sqrt();
        let inverse = R::splat(0.5) / (d2 * area);
        let signed = sign * inverse;
        // Along and across k, as parts of it.
        let mut half = area * inverse;
        let mut across = area2 * signed;
        let mut closing = Closing { open, sine2, ..Closing::CLOSED };
        if CHECKED {
            closing.per_arm2 = [a.inv_norm2, b.inv_norm2];
            let flat = degenerate(area2, sine2);
            let flat_half = R::splat(0.5) / d2;
            half = R::select(flat, flat_half, half);
            across = R::select(flat, (sign * area) * flat_half, across);
            closing.flat = flat.and(open.not());
            let (d, sum) = (d2.sqrt(), a.norm + b.norm);
            let difference = (a.norm - b.norm).abs();
            closing.margin = (sum - d).min(d - difference);
            let missing = R::select(
                outer.lt(outer_limit),
                d - sum,
                R::select(inner.lt(inner_limit), difference - d, R::ZERO),
            );
            let far = d.finite().not();
            closing.gap = R::select(far, R::splat(f64::INFINITY), missing);
        }
        let first = k * Vector::new((d2 + sides.split) * half, across);
        Self {
            legs: [first, k - first],
            inverse_determinant: R::splat(-4.0) * (d2 * signed),
            closing,
        }
    }
}

/// `a u + s = k` for a unit vector u and a slide s, in the frame of the guide: the intersection of a
/// circle and a line along x.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CircleAndLine<R: Real> {
    /// The leg `a u`.
    pub leg: Vector<R>,
    pub slide: R,
    /// 1 / x of the leg: minus 1 / determinant of the closure matrix.
    pub inverse: R,
    pub closing: Closing<R>,
}

impl<R: Real> CircleAndLine<R> {
    /// `sign` > 0: the slide is ahead of the foot of the perpendicular from the circle's centre.
    /// `reach`: an upper bound of |k|.
    #[inline(always)]
    pub(crate) fn solve<const CHECKED: bool>(a: &Leg<R>, k: Vector<R>, sign: R, reach: R) -> Self {
        let across = k.y;
        let inner = a.norm - across.abs();
        let mut open = inner.lt(R::splat(-FLAT_CLOSURE) * (a.norm + reach));
        let mut chord2 = inner * (a.norm + across.abs());
        let far = across.finite().not();
        if CHECKED {
            let within = R::splat(-FLAT_CLOSURE) * a.norm.max(k.size());
            open = within.le(inner).not().or(R::ZERO.lt(a.norm2).not()).or(far);
            chord2 = positive(inner) * (a.norm + across.abs());
        }
        let chord = chord2.sqrt();
        let sine2 = chord2 * a.inv_norm2;
        let mut closing = Closing { open, sine2, ..Closing::CLOSED };
        if CHECKED {
            closing.per_arm2[0] = a.inv_norm2;
            closing.flat = degenerate(chord2, sine2).and(open.not());
            closing.margin = inner;
            closing.gap = R::select(far, R::splat(f64::INFINITY), positive(-inner));
        }
        let opposite = -sign;
        let along = opposite * chord;
        Self {
            leg: Vector::new(along, across),
            slide: k.x - along,
            inverse: opposite / chord,
            closing,
        }
    }
}

/// `a u + s b = k` for a unit vector u and a slide s along the unit vector b, or `(a + s b) u = k`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Guided<R: Real> {
    /// The leg `a u`; for a guide that turns, u alone.
    pub turned: Vector<R>,
    pub slide: R,
    /// 1 / determinant of the closure matrix.
    pub inverse_determinant: R,
    pub closing: Closing<R>,
}

impl<R: Real> Guided<R> {
    /// A circle and a line in direction `b`; see [`CircleAndLine::solve`].
    #[inline(always)]
    pub(crate) fn circle_and_line<const CHECKED: bool>(
        a: &Leg<R>,
        b: Vector<R>,
        k: Vector<R>,
        sign: R,
        reach: R,
    ) -> Self {
        let k = Vector::new(b.dot(k), b.cross(k));
        let CircleAndLine { leg, slide, inverse, closing } =
            CircleAndLine::solve::<CHECKED>(a, k, sign, reach);
        Self { turned: b * leg, slide, inverse_determinant: -inverse, closing }
    }

    /// A guide that turns, `a` from its pivot in direction `b`. `sign` > 0: the slide is above the
    /// value at which it is nearest to the far joint.
    #[inline(always)]
    pub(crate) fn turning_guide<const CHECKED: bool>(
        a: Vector<R>,
        b: Vector<R>,
        k: Vector<R>,
        sign: R,
    ) -> Self {
        let (along, across) = (b.dot(a), b.cross(a));
        let d2 = k.norm2();
        let inner = d2 - across * across;
        // The tolerance of two legs with the shorter one of length 0.
        let within = R::splat(-2.0 * FLAT_CLOSURE) * (a.size().max(across.abs()) * across.abs());
        let mut open = inner.lt(within);
        let mut chord2 = inner;
        if CHECKED {
            // The far joint is on the guide's own pivot: every attitude closes.
            open = within.le(inner).not().or(R::ZERO.lt(d2).not());
            chord2 = positive(inner);
        }
        let chord = chord2.sqrt();
        let signed = sign * chord;
        let inverse = R::ONE / (d2 * chord);
        let mut per = chord * inverse;
        let mut closing = Closing { open, ..Closing::CLOSED };
        if CHECKED {
            let flat_per = R::ONE / d2;
            let flat = degenerate(chord2, chord2 * flat_per);
            per = R::select(flat, flat_per, per);
            closing.flat = flat.and(open.not());
            let d = d2.sqrt();
            closing.margin = d - across.abs();
            let far = d.finite().not();
            closing.gap = R::select(far, R::splat(f64::INFINITY), positive(-closing.margin));
        }
        closing.sine2 = chord2 * per;
        closing.per_arm2[0] = per;
        let arm = b * Vector::new(signed, across);
        Self {
            turned: (k * arm.conj()).scale(per),
            slide: signed - along,
            inverse_determinant: -(sign * (d2 * inverse)),
            closing,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOLERANCE: f64 = 1e-15;

    fn leg(x: f64, y: f64) -> Leg {
        Leg::of(Vector::new(x, y))
    }

    fn two_circles(a: &Leg, b: &Leg, k: Vector, sign: f64) -> TwoCircles<f64> {
        let sides = Sides::of(a, b);
        let checked = TwoCircles::solve::<true>([a, b], &sides, k, sign);
        let unchecked = TwoCircles::solve::<false>([a, b], &sides, k, sign);
        if !(checked.closing.open || checked.closing.flat) {
            assert_eq!(
                (unchecked.legs, unchecked.inverse_determinant),
                (checked.legs, checked.inverse_determinant)
            );
        }
        checked
    }

    #[test]
    fn right_triangle_three_four_five() {
        let (a, b) = (leg(3.0, 0.0), leg(4.0, 0.0));
        let solved = two_circles(&a, &b, Vector::new(5.0, 0.0), 1.0);
        let [u, v] = [a.turn_to(solved.legs[0]), b.turn_to(solved.legs[1])];
        let closing = solved.closing;
        assert!(!closing.flat && !closing.open && (closing.sine2 - 1.0).abs() < TOLERANCE);
        assert!((u.x - 0.6).abs() < TOLERANCE && (u.y - 0.8).abs() < TOLERANCE);
        assert!((v.x - 0.8).abs() < TOLERANCE && (v.y + 0.6).abs() < TOLERANCE);
        assert!((solved.inverse_determinant + 1.0 / 12.0).abs() < TOLERANCE);
    }

    #[test]
    fn circles_that_do_not_meet_report_the_gap() {
        let unit = leg(1.0, 0.0);
        let closing = two_circles(&unit, &unit, Vector::new(2.5, 0.0), 1.0).closing;
        assert!(closing.open && (closing.gap - 0.5).abs() < TOLERANCE);
        assert!((closing.margin + 0.5).abs() < TOLERANCE);
    }

    #[test]
    fn circles_that_touch_are_flat() {
        let (a, b) = (leg(3.0, 0.0), leg(4.0, 0.0));
        for (distance, first) in [(7.0, 3.0), (1.0, -3.0)] {
            let solved = two_circles(&a, &b, Vector::new(distance, 0.0), 1.0);
            assert!(solved.closing.flat && !solved.closing.open);
            assert!((solved.legs[0] - Vector::new(first, 0.0)).norm() < 4.0 * TOLERANCE);
        }
    }

    #[test]
    fn lines_are_flat_where_rounding_cannot_tell_them_from_parallel_ones() {
        let limit = FLAT2.sqrt();
        for (sine, flat) in [(0.9 * limit, true), (-0.9 * limit, true), (1.1 * limit, false)] {
            let closing = Closing::of_lines(1.0, 2.0, sine);
            assert!(closing.flat == flat && !closing.open);
        }
        let closing = Closing::of_lines(f64::INFINITY, 2.0, 0.0);
        assert!(closing.open && !closing.flat);
    }

    #[test]
    fn circle_meets_line_on_the_named_side() {
        let (a, b) = (leg(5.0, 0.0), Vector::new(1.0, 0.0));
        let k = Vector::new(10.0, 3.0);
        for sign in [1.0, -1.0] {
            let solved = Guided::circle_and_line::<true>(&a, b, k, sign, 20.0);
            assert!((solved.slide - (10.0 + sign * 4.0)).abs() < TOLERANCE * 10.0);
            assert!((solved.turned + b.scale(solved.slide) - k).norm() < 1e-14);
            let unchecked = Guided::circle_and_line::<false>(&a, b, k, sign, 20.0);
            assert_eq!((unchecked.turned, unchecked.slide), (solved.turned, solved.slide));
        }
    }

    #[test]
    fn turning_guide_closes() {
        let (a, b) = (Vector::new(0.3, 0.4), Vector::new(0.6, 0.8));
        let k = Vector::new(-1.0, 2.0);
        for sign in [1.0, -1.0] {
            let solved = Guided::turning_guide::<true>(a, b, k, sign);
            assert!(((a + b.scale(solved.slide)) * solved.turned - k).norm() < 1e-14);
            assert!((solved.turned.norm() - 1.0).abs() < 1e-14);
            let unchecked = Guided::turning_guide::<false>(a, b, k, sign);
            assert_eq!((unchecked.turned, unchecked.slide), (solved.turned, solved.slide));
        }
    }
}
