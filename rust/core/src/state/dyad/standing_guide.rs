//! The dyad of a leg and a slide along a fixed guide (RRP).

use super::chord::{Ends, FROM_GROUND, FROM_PIN, POINTS, TO_GROUND, TO_PIN, ends_of};
use super::guide_chord::GuideChord;
use super::intersections::CircleAndLine;
use super::turning_leg::{entry, second_rest, third_rest};
use crate::math::lanes::Real;
use crate::math::stride::Stride;
use crate::math::vector::Vector;
use crate::plan::tape::DyadOp;
use crate::state::state::{Context, State};

/// Terms shared by all entries of the jets of leg and slide, in the frame of the guide: x along it, y
/// across it.
#[derive(Clone, Copy)]
struct LegOnGuide<R: Real> {
    leg: Vector<R>,
    /// 1 / x of the leg
    inverse: R,
}

impl<R: Real> LegOnGuide<R> {
    /// An entry of the angle and of the slide, from that of the chord. Across the guide only the leg
    /// contributes. `rest`: the leg's entry without the angle's own term; `None` for the first.
    #[inline(always)]
    fn rates(&self, chord: Vector<R>, rest: Option<Vector<R>>) -> [R; 2] {
        let rest = if let Some(leg) = rest { chord - leg } else { chord };
        let u = rest.y * self.inverse;
        [u, rest.x + u * self.leg.y]
    }
}

impl<R: Real, const G: usize> State<R, G> {
    /// Solves the dyad for its leg and slide, and their analogues.
    #[inline(always)]
    pub(crate) fn standing_guide(&mut self, cx: &Context<'_>, op: &DyadOp) {
        if cx.derivatives.drivers > 1 {
            self.guide_by_drivers(cx, op);
        } else if op.pin.is_some() {
            self.guide_by_driver::<R, true, TO_PIN>(cx, op, self.len);
        } else {
            self.guide_by_driver::<R, true, POINTS>(cx, op, self.len);
        }
    }

    /// The same on the unchecked path: one driver, jets of a constant length, only what the tape uses.
    #[inline(always)]
    pub(crate) fn unchecked_standing_guide<W: Stride<R>, const LEN: usize>(
        &mut self,
        cx: &Context<'_>,
        op: &DyadOp,
    ) {
        match ends_of(op) {
            FROM_PIN | TO_PIN => self.guide_by_driver::<W, false, TO_PIN>(cx, op, LEN),
            FROM_GROUND => self.guide_by_driver::<W, false, FROM_GROUND>(cx, op, LEN),
            TO_GROUND => self.guide_by_driver::<W, false, TO_GROUND>(cx, op, LEN),
            _ => self.guide_by_driver::<W, false, POINTS>(cx, op, LEN),
        }
    }

    #[inline(always)]
    fn guide_by_driver<W: Stride<R>, const CHECKED: bool, const ENDS: Ends>(
        &mut self,
        cx: &Context<'_>,
        op: &DyadOp,
        len: usize,
    ) {
        let jet = |i: usize| i * len..i * len + len;
        let chord = GuideChord::new(cx, op, &self.pose.points, &self.pose.unit, len);
        let [class, slide] = op.unknowns;
        let leg = &mut self.pose.legs[jet(2 * op.dyad)];
        let (u, s) = (&mut self.pose.theta[jet(class)], &mut self.pose.slides[jet(slide)]);
        let turn = &mut self.pose.class[class];
        let (turns, keeps) = (CHECKED || op.turns[0], CHECKED || op.keeps[0]);
        let signs = &self.pose.signs[op.sign.unwrap_or(0)];
        let dyad = &cx.constants.dyads[op.dyad];
        let a = &cx.constants.legs[op.dyad][0];
        let guide = dyad.guides[1];
        let to_turn = guide * a.inverse;
        let a = a.on_lanes::<W>();
        let (reach, inverse_arm2) = (W::splat(dyad.reach), W::splat(dyad.inverse_arm2));
        let bounds = &mut self.conditions.bounds[op.dyad];
        for g in (0..self.groups.min(G)).step_by(W::REGISTERS) {
            let turning = chord.turning::<W, ENDS>(g);
            let k = chord.at::<W, ENDS>(0, g, turning);
            let sign = W::load(signs, g);
            let solved = CircleAndLine::solve::<CHECKED>(&a, k, sign, reach);
            if CHECKED {
                self.work.closings[g] = solved.closing.first();
            } else {
                W::add_to(solved.closing.open, &mut self.conditions.open, g);
                let mut bound = solved.closing.sine2 * inverse_arm2;
                if ENDS != TO_PIN {
                    bound = W::load(&self.conditions.bound, g) * bound;
                }
                bound.store(bounds, g);
            }
            if turns {
                W::store_vectors(solved.leg.turn(to_turn), turn, g);
            }
            if keeps {
                W::store_vectors(solved.leg.turn(guide), &mut leg[0], g);
            }
            solved.slide.store(&mut s[0], g);
            let on_guide = LegOnGuide { leg: solved.leg, inverse: solved.inverse };
            let mut rates = [W::ZERO; 2];
            for k in 1..len {
                let [u1, u2] = rates;
                let rest: Option<Vector<W>> = match k {
                    1 => None,
                    2 => Some(second_rest(solved.leg, u1)),
                    _ => Some(third_rest(solved.leg, u1, u2)),
                };
                let entries = on_guide.rates(chord.at::<W, ENDS>(k, g, turning), rest);
                if k < 3 {
                    rates[k - 1] = entries[0];
                }
                entries[1].store(&mut s[k], g);
                if turns {
                    entries[0].store(&mut u[k], g);
                }
                if keeps {
                    let next = entry(solved.leg, entries[0], rest);
                    W::store_vectors(next.turn(guide), &mut leg[k], g);
                }
            }
        }
        if CHECKED {
            self.record_closings(cx, op);
        }
        self.turn_orientations(cx, op);
    }

    /// The checked path for any number of drivers.
    #[inline(always)]
    fn guide_by_drivers(&mut self, cx: &Context<'_>, op: &DyadOp) {
        let len = self.len;
        let jet = |i: usize| i * len..i * len + len;
        let (start, end) = (&self.pose.points[jet(op.start)], &self.pose.points[jet(op.end)]);
        let [class, slide] = op.unknowns;
        let leg = &mut self.pose.legs[jet(2 * op.dyad)];
        let (u, s) = (&mut self.pose.theta[jet(class)], &mut self.pose.slides[jet(slide)]);
        let turn = &mut self.pose.class[class];
        let signs = &self.pose.signs[op.sign.unwrap_or(0)];
        let dyad = &cx.constants.dyads[op.dyad];
        let a = &cx.constants.legs[op.dyad][0];
        let guide = dyad.guides[1];
        let (into, to_turn) = (guide.conj(), guide * a.inverse);
        let a = a.on_lanes();
        let (offset, reach) = (Vector::splat(dyad.offset), R::splat(dyad.reach));
        for g in 0..self.groups.min(G) {
            let k = ((end[0][g] - start[0][g]) - offset).turn(into);
            let solved = CircleAndLine::solve::<true>(&a, k, signs[g], reach);
            self.work.closings[g] = solved.closing;
            (leg[0][g], s[0][g]) = (solved.leg.turn(guide), solved.slide);
            turn[g] = solved.leg.turn(to_turn);
            let on_guide = LegOnGuide { leg: solved.leg, inverse: solved.inverse };
            for k in 1..len {
                let mut sum = Vector::ZERO;
                for term in &cx.derivatives.rotation[k] {
                    let factor = R::splat(term.factor);
                    sum += leg[term.left][g].scale(factor * u[term.right][g]);
                }
                let chord = (end[k][g] - start[k][g]).turn(into);
                let rest = sum.left().turn(into);
                [u[k][g], s[k][g]] = on_guide.rates(chord, Some(rest));
                leg[k][g] = entry(solved.leg, u[k][g], Some(rest)).turn(guide);
            }
        }
        self.record_closings(cx, op);
        self.turn_orientations(cx, op);
    }
}
