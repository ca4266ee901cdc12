//! Sample of a dyad at a knot of a branch: its distance from flat, and the rate of that.

use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::dyad::{Dyad, Form};
use crate::plan::tape::{DyadOp, Op};
use crate::state::state::{Context, State};

/// See [`State::sample`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct DyadSample<R> {
    /// Square of the discriminant; negative where the dyad does not close. It follows from the
    /// chord alone, and a dead point is a simple root of it.
    pub square: R,
    /// Its derivative by the driver. For a dyad without a kernel it is unknown (NaN) where the dyad does
    /// not close.
    pub rate: R,
    /// Determinant of the directions of two guides; 1 for any other dyad.
    pub side: R,
    /// Its sign shows which way the dyad is flat where it does not close; see [`State::flat_side`].
    pub flat: R,
}

impl<R: Real, const G: usize> State<R, G> {
    /// Samples a dyad at a position with first analogues of its points.
    #[inline(always)]
    pub(crate) fn sample(&self, g: usize, cx: &Context<'_>, dyad: &Dyad, op: &Op) -> DyadSample<R> {
        match op {
            Op::TwoLegs(op) => self.sample_two_legs(g, cx, op),
            Op::StandingGuide(op) => self.sample_standing_guide(g, cx, op),
            Op::MovingGuide(op) => self.sample_moving_guide(g, cx, op),
            Op::TurningGuide(op) => self.sample_turning_guide(g, cx, op),
            Op::StandingGuides(op) => {
                let [a, b] = cx.constants.dyads[op.dyad].guides;
                DyadSample {
                    square: R::ONE,
                    rate: R::ZERO,
                    side: R::splat(a.cross(b)),
                    flat: R::ONE,
                }
            }
            _ => self.sample_solved(g, cx, dyad),
        }
    }

    /// The same for a dyad without a kernel, solved with checks.
    #[inline(always)]
    fn sample_solved(&self, g: usize, cx: &Context<'_>, dyad: &Dyad) -> DyadSample<R> {
        let margin = self.conditions.margin[dyad.index][g];
        let closes = R::ZERO.lt(margin);
        if dyad.sign.is_some() {
            let (value, rate) = self.discriminant(g, cx, dyad, 1);
            let square = R::select(closes, value * value, margin);
            let rate = R::splat(2.0) * (value * rate);
            return DyadSample {
                square,
                rate: R::select(closes, rate, R::splat(f64::NAN)),
                side: R::ONE,
                flat: self.flat_side(g, cx, dyad),
            };
        }
        let two_lines = dyad.form == Form::TwoLines;
        let side = if two_lines { self.determinant(g, cx, dyad) } else { R::ONE };
        DyadSample { square: R::select(closes, R::ONE, margin), rate: R::ZERO, side, flat: R::ONE }
    }

    /// Value and first analogue of the vector from the start of a dyad to its end.
    #[inline(always)]
    fn chord(&self, g: usize, op: &DyadOp) -> [Vector<R>; 2] {
        let [start, end] = [op.start * self.len, op.end * self.len];
        [
            self.pose.points[end][g] - self.pose.points[start][g],
            self.pose.points[end + 1][g] - self.pose.points[start + 1][g],
        ]
    }

    /// The sine of the angle between the legs, from its cosine.
    #[inline(always)]
    fn sample_two_legs(&self, g: usize, cx: &Context<'_>, op: &DyadOp) -> DyadSample<R> {
        let [a, b] = &cx.constants.legs[op.dyad];
        let per = a.inv_norm() * b.inv_norm();
        let [k, dk] = self.chord(g, op);
        let cos = (R::splat(a.norm2 + b.norm2) - k.norm2()) * R::splat(0.5 * per);
        let rate = (cos * k.dot(dk)) * R::splat(2.0 * per);
        DyadSample { square: (R::ONE - cos) * (R::ONE + cos), rate, side: R::ONE, flat: cos }
    }

    /// The cosine of the angle between leg and guide, from its sine.
    #[inline(always)]
    fn sample_standing_guide(&self, g: usize, cx: &Context<'_>, op: &DyadOp) -> DyadSample<R> {
        let dyad = &cx.constants.dyads[op.dyad];
        let per = R::splat(cx.constants.legs[op.dyad][0].inv_norm());
        let guide = Vector::splat(dyad.guides[1]);
        let [k, dk] = self.chord(g, op);
        let sin = guide.cross(k - Vector::splat(dyad.offset)) * per;
        let rate = R::splat(-2.0) * (sin * (guide.cross(dk) * per));
        DyadSample { square: (R::ONE - sin) * (R::ONE + sin), rate, side: R::ONE, flat: sin }
    }

    /// Value and first analogue of the guide's direction, and of the chord to where it starts.
    #[inline(always)]
    fn moving_guide_chord(&self, g: usize, cx: &Context<'_>, op: &DyadOp) -> [[Vector<R>; 2]; 2] {
        let dyad = &cx.constants.dyads[op.dyad];
        let (along, offset) = (Vector::splat(dyad.guides[1]), Vector::splat(dyad.offset));
        let carrier = op.carrier.unwrap_or(0) * self.len;
        let turned = [self.pose.orient[carrier][g], self.pose.orient[carrier + 1][g]];
        let [k, dk] = self.chord(g, op);
        [[turned[0] * along, k - turned[0] * offset], [turned[1] * along, dk - turned[1] * offset]]
    }

    /// As with a fixed guide.
    #[inline(always)]
    fn sample_moving_guide(&self, g: usize, cx: &Context<'_>, op: &DyadOp) -> DyadSample<R> {
        let per = R::splat(cx.constants.legs[op.dyad][0].inv_norm());
        let [[guide, k], [turning, dk]] = self.moving_guide_chord(g, cx, op);
        let sin = guide.cross(k) * per;
        let rate = R::splat(-2.0) * (sin * ((turning.cross(k) + guide.cross(dk)) * per));
        DyadSample { square: (R::ONE - sin) * (R::ONE + sin), rate, side: R::ONE, flat: sin }
    }

    /// The part of the chord along the guide.
    #[inline(always)]
    fn sample_turning_guide(&self, g: usize, cx: &Context<'_>, op: &DyadOp) -> DyadSample<R> {
        let across = across_guide(cx, op);
        let [k, dk] = self.chord(g, op);
        DyadSample {
            square: k.norm2() - R::splat(across * across),
            rate: R::splat(2.0) * k.dot(dk),
            side: R::ONE,
            flat: R::ONE,
        }
    }
}

/// The distance of a turning guide from its pivot.
#[inline(always)]
fn across_guide(cx: &Context<'_>, op: &DyadOp) -> f64 {
    cx.constants.dyads[op.dyad].guides[1].cross(cx.constants.legs[op.dyad][0].vector)
}
