//! The dyad of two legs (RRR): most dyads are of this kind.

use super::intersections::{Closing, TwoCircles};
use crate::math::derivatives::{ONE_DRIVER, Term};
use crate::math::lanes::{Mask, Real};
use crate::math::vector::Vector;
use crate::plan::tape::DyadOp;
use crate::state::state::{Context, State};

impl<R: Real, const G: usize> State<R, G> {
    /// Solves the dyad for its legs, their rotations and analogues.
    #[inline(always)]
    pub(crate) fn two_legs(&mut self, cx: &Context<'_>, op: &DyadOp) {
        if R::LANES > 1 || cx.derivatives.drivers > 1 {
            // Lanes rarely need care: one copy for all orders is enough.
            self.legs_of_length::<true>(cx, op, self.len, &|k| &cx.derivatives.rotation[k][..]);
            return;
        }
        match self.len {
            1 => self.legs_of_length::<true>(cx, op, 1, &|k| ONE_DRIVER[k]),
            2 => self.legs_of_length::<true>(cx, op, 2, &|k| ONE_DRIVER[k]),
            3 => self.legs_of_length::<true>(cx, op, 3, &|k| ONE_DRIVER[k]),
            _ => self.legs_of_length::<true>(cx, op, 4, &|k| ONE_DRIVER[k]),
        }
    }

    /// The same for one driver and jets of a constant length, without care.
    #[inline(always)]
    pub(crate) fn bare_two_legs<const LEN: usize>(&mut self, cx: &Context<'_>, op: &DyadOp) {
        self.legs_of_length::<false>(cx, op, LEN, &|k| ONE_DRIVER[k]);
    }

    #[inline(always)]
    fn legs_of_length<'t, const CAREFUL: bool>(
        &mut self,
        cx: &Context<'_>,
        op: &DyadOp,
        len: usize,
        terms: &impl Fn(usize) -> &'t [Term],
    ) {
        let jet = |i: usize| i * len..i * len + len;
        let (start, end) = (&self.points[jet(op.start)], &self.points[jet(op.end)]);
        let (Ok([a_jet, b_jet]), Ok([u, v]), Ok([a_turn, b_turn])) = (
            self.legs.get_disjoint_mut([2 * op.dyad, 2 * op.dyad + 1].map(jet)),
            self.theta.get_disjoint_mut(op.unknowns.map(jet)),
            self.class.get_disjoint_mut(op.unknowns),
        ) else {
            return;
        };
        let signs = &self.signs[op.sign.unwrap_or(0)];
        let (legs, own) = (&cx.constants.legs[op.dyad], &cx.constants.dyads[op.dyad]);
        let (a, b) = (legs[0].on_lanes(), legs[1].on_lanes());
        let (sides, inverse_arm2) = (own.sides.on_lanes(), R::splat(own.inverse_arm2));
        let bounds = &mut self.bounds[op.dyad];
        let mut closings = [Closing::CLOSED; G];
        for g in 0..self.groups.min(G) {
            let k = end[0][g] - start[0][g];
            let solved = TwoCircles::solve::<CAREFUL>([&a, &b], &sides, k, signs[g]);
            if CAREFUL {
                closings[g] = solved.closing;
            } else {
                self.open[g] = self.open[g].or(solved.closing.open);
                bounds[g] = self.bound[g] * (solved.closing.sine2 * inverse_arm2);
            }
            let ([a0, b0], inverse) = (solved.legs, solved.inverse_determinant);
            a_jet[0][g] = a0;
            b_jet[0][g] = b0;
            if CAREFUL || op.turns[0] {
                a_turn[g] = a.turn_to(a0);
            }
            if CAREFUL || op.turns[1] {
                b_turn[g] = b.turn_to(b0);
            }
            for k in 1..len {
                let chord = end[k][g] - start[k][g];
                // Of the legs' own terms, without those in the analogues of this order.
                let (mut a_rest, mut b_rest) = (Vector::ZERO, Vector::ZERO);
                let mut rest = chord;
                if !terms(k).is_empty() {
                    for term in terms(k) {
                        let factor = R::splat(term.factor);
                        a_rest += a_jet[term.left][g].scale(factor * u[term.right][g]);
                        b_rest += b_jet[term.left][g].scale(factor * v[term.right][g]);
                    }
                    (a_rest, b_rest) = (a_rest.left(), b_rest.left());
                    rest = (chord - a_rest) - b_rest;
                }
                let rate = b0.dot(rest) * inverse;
                u[k][g] = rate;
                v[k][g] = -(a0.dot(rest) * inverse);
                let a_top = a0.left().scale(rate);
                let a_next = if terms(k).is_empty() { a_top } else { a_rest + a_top };
                a_jet[k][g] = a_next;
                b_jet[k][g] = chord - a_next;
            }
        }
        if CAREFUL {
            self.record_closings(cx, op, &closings);
        }
        self.turn_orientations(cx, op);
    }
}
