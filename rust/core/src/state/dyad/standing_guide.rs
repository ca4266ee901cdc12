//! The dyad of a leg and a slide along a guide that stands still (RRP).

use super::chord::{Chord, Ends, FROM_GROUND, FROM_PIN, POINTS, TO_GROUND, TO_PIN, ends_of};
use super::intersections::{Closing, Guided};
use super::turning_leg::{entry, second_rest, third_rest};
use crate::math::lanes::Real;
use crate::math::stride::Stride;
use crate::math::vector::Vector;
use crate::plan::tape::DyadOp;
use crate::state::state::{Context, State};

/// What all entries of the jets of leg and slide have in common.
#[derive(Clone, Copy)]
struct LegOnGuide<R: Real> {
    leg: Vector<R>,
    guide: Vector<R>,
    /// 1 / determinant of the closure matrix
    inverse: R,
}

impl<R: Real> LegOnGuide<R> {
    /// An entry of the angle and of the slide, from that of the chord. `rest`: what the leg has
    /// without the angle's own entry; none in the first.
    #[inline(always)]
    fn rates(&self, chord: Vector<R>, rest: Option<Vector<R>>) -> [R; 2] {
        let rest = if let Some(leg) = rest { chord - leg } else { chord };
        [-(self.guide.cross(rest) * self.inverse), -(self.leg.dot(rest) * self.inverse)]
    }
}

impl<R: Real, const G: usize> State<R, G> {
    /// Solves the dyad for its leg and slide, and their analogues.
    #[inline(always)]
    pub(crate) fn standing_guide(&mut self, cx: &Context<'_>, op: &DyadOp) {
        if cx.derivatives.drivers > 1 {
            self.guide_by_drivers(cx, op);
        } else {
            self.guide_by_driver::<R, true, POINTS>(cx, op, self.len);
        }
    }

    /// The same for one driver and jets of a constant length, without care, and only what is used.
    #[inline(always)]
    pub(crate) fn bare_standing_guide<W: Stride<R>, const LEN: usize>(
        &mut self,
        cx: &Context<'_>,
        op: &DyadOp,
    ) {
        match ends_of(op) {
            FROM_PIN => self.guide_by_driver::<W, false, FROM_PIN>(cx, op, LEN),
            TO_PIN => self.guide_by_driver::<W, false, TO_PIN>(cx, op, LEN),
            FROM_GROUND => self.guide_by_driver::<W, false, FROM_GROUND>(cx, op, LEN),
            TO_GROUND => self.guide_by_driver::<W, false, TO_GROUND>(cx, op, LEN),
            _ => self.guide_by_driver::<W, false, POINTS>(cx, op, LEN),
        }
    }

    #[inline(always)]
    fn guide_by_driver<W: Stride<R>, const CAREFUL: bool, const ENDS: Ends>(
        &mut self,
        cx: &Context<'_>,
        op: &DyadOp,
        len: usize,
    ) {
        let jet = |i: usize| i * len..i * len + len;
        let chord = Chord::new(cx, op, &self.pose.points, &self.pose.unit, len);
        let [class, slide] = op.unknowns;
        let leg = &mut self.pose.legs[jet(2 * op.dyad)];
        let (u, s) = (&mut self.pose.theta[jet(class)], &mut self.pose.slides[jet(slide)]);
        let turn = &mut self.pose.class[class];
        let (turns, keeps) = (CAREFUL || op.turns[0], CAREFUL || op.keeps[0]);
        let signs = &self.pose.signs[op.sign.unwrap_or(0)];
        let own = &cx.constants.dyads[op.dyad];
        let a = cx.constants.legs[op.dyad][0].on_lanes::<W>();
        let (guide, offset) = (Vector::splat(own.guides[1]), Vector::splat(own.offset));
        let (reach, inverse_arm2) = (W::splat(own.reach), W::splat(own.inverse_arm2));
        let bounds = &mut self.conditions.bounds[op.dyad];
        let mut closings = [Closing::CLOSED; G];
        for g in (0..self.groups.min(G)).step_by(W::REGISTERS) {
            let arm = chord.arm::<W, ENDS>(g);
            let k = chord.at::<W, ENDS>(0, g, arm) - offset;
            let sign = W::load(signs, g);
            let solved = Guided::circle_and_line::<CAREFUL>(&a, guide, k, sign, reach);
            if CAREFUL {
                closings[g] = solved.closing.first();
            } else {
                W::add_to(solved.closing.open, &mut self.conditions.open, g);
                let upstream = W::load(&self.conditions.bound, g);
                op.bound_with(upstream, solved.closing.sine2 * inverse_arm2).store(bounds, g);
            }
            let a0 = solved.turned;
            if turns {
                W::store_vectors(a.turn_to(a0), turn, g);
            }
            if keeps {
                W::store_vectors(a0, &mut leg[0], g);
            }
            solved.slide.store(&mut s[0], g);
            let on_guide = LegOnGuide { leg: a0, guide, inverse: solved.inverse_determinant };
            let mut rates = [W::ZERO; 2];
            for k in 1..len {
                let [u1, u2] = rates;
                let rest: Option<Vector<W>> = match k {
                    1 => None,
                    2 => Some(second_rest(a0, u1)),
                    _ => Some(third_rest(a0, u1, u2)),
                };
                let own = on_guide.rates(chord.at::<W, ENDS>(k, g, arm), rest);
                if k < 3 {
                    rates[k - 1] = own[0];
                }
                own[1].store(&mut s[k], g);
                if turns {
                    own[0].store(&mut u[k], g);
                }
                if keeps {
                    W::store_vectors(entry(a0, own[0], rest), &mut leg[k], g);
                }
            }
        }
        if CAREFUL {
            self.record_closings(cx, op, &closings);
        }
        self.turn_orientations(cx, op);
    }

    /// The same carefully, for any number of drivers.
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
        let own = &cx.constants.dyads[op.dyad];
        let a = cx.constants.legs[op.dyad][0].on_lanes();
        let (guide, offset) = (Vector::splat(own.guides[1]), Vector::splat(own.offset));
        let reach = R::splat(own.reach);
        let mut closings = [Closing::CLOSED; G];
        for g in 0..self.groups.min(G) {
            let k = (end[0][g] - start[0][g]) - offset;
            let solved = Guided::circle_and_line::<true>(&a, guide, k, signs[g], reach);
            closings[g] = solved.closing;
            let a0 = solved.turned;
            (leg[0][g], s[0][g], turn[g]) = (a0, solved.slide, a.turn_to(a0));
            let on_guide = LegOnGuide { leg: a0, guide, inverse: solved.inverse_determinant };
            for k in 1..len {
                let mut sum = Vector::ZERO;
                for term in &cx.derivatives.rotation[k] {
                    let factor = R::splat(term.factor);
                    sum += leg[term.left][g].scale(factor * u[term.right][g]);
                }
                let rest = Some(sum.left());
                [u[k][g], s[k][g]] = on_guide.rates(end[k][g] - start[k][g], rest);
                leg[k][g] = entry(a0, u[k][g], rest);
            }
        }
        self.record_closings(cx, op, &closings);
        self.turn_orientations(cx, op);
    }
}
