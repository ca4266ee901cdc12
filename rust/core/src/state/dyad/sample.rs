//! What a dyad shows at a knot of a branch: how far it is from flat, how fast that changes, and by
//! how much it closes.

use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::dyad::{Dyad, Form};
use crate::plan::tape::{DyadOp, Op};
use crate::state::state::{Context, State};

/// See [`State::sample`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sample<R> {
    /// Discriminant, or the determinant of two guides.
    pub value: R,
    /// Its derivative by the driver.
    pub rate: R,
    /// By how much the dyad closes; negative where it does not.
    pub margin: R,
}

impl<R: Real, const G: usize> State<R, G> {
    /// Samples a dyad at a position with first analogues (see [`State::discriminant`]).
    #[inline(always)]
    pub(crate) fn sample(&self, g: usize, cx: &Context<'_>, dyad: &Dyad, op: &Op) -> Sample<R> {
        match op {
            Op::TwoLegs(op) => self.sample_two_legs(g, cx, op),
            Op::StandingGuide(op) => self.sample_standing_guide(g, cx, op),
            Op::TurningGuide(op) => self.sample_turning_guide(g, cx, op),
            Op::StandingGuides(op) => {
                let [a, b] = cx.constants.dyads[op.dyad].guides;
                Sample { value: R::splat(a.cross(b)), rate: R::ZERO, margin: R::ONE }
            }
            _ => self.sample_steps(g, cx, dyad),
        }
    }

    /// The same for any dyad that was solved carefully.
    #[inline(always)]
    pub(crate) fn sample_steps(&self, g: usize, cx: &Context<'_>, dyad: &Dyad) -> Sample<R> {
        let margin = self.margin[dyad.index][g];
        let (value, rate) = match (dyad.sign, dyad.form) {
            (Some(_), _) => self.discriminant(g, cx, dyad, 1),
            (None, Form::TwoLines) => (self.determinant(g, cx, dyad), R::ZERO),
            (None, _) => (R::ONE, R::ZERO),
        };
        Sample { value, rate, margin }
    }

    /// Value and first analogue of the vector from the start of a dyad to its end.
    #[inline(always)]
    fn chord(&self, g: usize, op: &DyadOp) -> [Vector<R>; 2] {
        let [start, end] = [op.start * self.len, op.end * self.len];
        [
            self.points[end][g] - self.points[start][g],
            self.points[end + 1][g] - self.points[start + 1][g],
        ]
    }

    #[inline(always)]
    fn sample_two_legs(&self, g: usize, cx: &Context<'_>, op: &DyadOp) -> Sample<R> {
        let len = self.len;
        let [a, da] = [0, 1].map(|k| self.legs[2 * op.dyad * len + k][g]);
        let [b, db] = [0, 1].map(|k| self.legs[(2 * op.dyad + 1) * len + k][g]);
        let legs = &cx.constants.legs[op.dyad];
        let inverse = R::splat(legs[0].inv_norm() * legs[1].inv_norm());
        let (sum, difference) = (legs[0].norm + legs[1].norm, (legs[0].norm - legs[1].norm).abs());
        let d = self.chord(g, op)[0].norm();
        Sample {
            value: b.cross(a) * inverse,
            rate: (db.cross(a) + b.cross(da)) * inverse,
            margin: (R::splat(sum) - d).min(d - R::splat(difference)),
        }
    }

    #[inline(always)]
    fn sample_standing_guide(&self, g: usize, cx: &Context<'_>, op: &DyadOp) -> Sample<R> {
        let own = &cx.constants.dyads[op.dyad];
        let leg = &cx.constants.legs[op.dyad][0];
        let inverse = R::splat(-leg.inv_norm());
        let guide = Vector::splat(own.guides[1]);
        let [a, da] = [0, 1].map(|k| self.legs[2 * op.dyad * self.len + k][g]);
        let across = guide.cross(self.chord(g, op)[0] - Vector::splat(own.offset));
        Sample {
            value: guide.dot(a) * inverse,
            rate: guide.dot(da) * inverse,
            margin: R::splat(leg.norm) - across.abs(),
        }
    }

    #[inline(always)]
    fn sample_turning_guide(&self, g: usize, cx: &Context<'_>, op: &DyadOp) -> Sample<R> {
        let direction = cx.constants.dyads[op.dyad].guides[1];
        let guide = Vector::splat(direction);
        let across = direction.cross(cx.constants.legs[op.dyad][0].vector);
        let turn = (2 * op.dyad + 1) * self.len;
        let [unit, rate] = [guide * self.legs[turn][g], guide * self.legs[turn + 1][g]];
        let [chord, change] = self.chord(g, op);
        Sample {
            value: unit.dot(chord),
            rate: rate.dot(chord) + unit.dot(change),
            margin: chord.norm() - R::splat(across.abs()),
        }
    }
}
