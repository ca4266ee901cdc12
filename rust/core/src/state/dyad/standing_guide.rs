//! The dyad of a leg and a slide along a guide that stands still (RRP).

use super::intersections::{Closing, Guided};
use crate::math::derivatives::{ONE_DRIVER, Term};
use crate::math::lanes::{Mask, Real};
use crate::math::vector::Vector;
use crate::plan::tape::DyadOp;
use crate::state::state::{Context, State};

impl<R: Real, const G: usize> State<R, G> {
    /// Solves the dyad for its leg and slide, and their analogues.
    #[inline(always)]
    pub(crate) fn standing_guide(&mut self, cx: &Context<'_>, op: &DyadOp) {
        if R::LANES > 1 || cx.derivatives.drivers > 1 {
            // Lanes rarely need care: one copy for all orders is enough.
            self.guide_of_length::<true>(cx, op, self.len, &|k| &cx.derivatives.rotation[k][..]);
            return;
        }
        match self.len {
            1 => self.guide_of_length::<true>(cx, op, 1, &|k| ONE_DRIVER[k]),
            2 => self.guide_of_length::<true>(cx, op, 2, &|k| ONE_DRIVER[k]),
            3 => self.guide_of_length::<true>(cx, op, 3, &|k| ONE_DRIVER[k]),
            _ => self.guide_of_length::<true>(cx, op, 4, &|k| ONE_DRIVER[k]),
        }
    }

    /// The same for one driver and jets of a constant length, without care.
    #[inline(always)]
    pub(crate) fn bare_standing_guide<const LEN: usize>(&mut self, cx: &Context<'_>, op: &DyadOp) {
        self.guide_of_length::<false>(cx, op, LEN, &|k| ONE_DRIVER[k]);
    }

    #[inline(always)]
    fn guide_of_length<'t, const CAREFUL: bool>(
        &mut self,
        cx: &Context<'_>,
        op: &DyadOp,
        len: usize,
        terms: &impl Fn(usize) -> &'t [Term],
    ) {
        let jet = |i: usize| i * len..i * len + len;
        let (start, end) = (&self.points[jet(op.start)], &self.points[jet(op.end)]);
        let [class, slide] = op.unknowns;
        let leg = &mut self.legs[jet(2 * op.dyad)];
        let (u, s) = (&mut self.theta[jet(class)], &mut self.slides[jet(slide)]);
        let turn = &mut self.class[class];
        let signs = &self.signs[op.sign.unwrap_or(0)];
        let own = &cx.constants.dyads[op.dyad];
        let a = cx.constants.legs[op.dyad][0].on_lanes();
        let (guide, offset) = (Vector::splat(own.guides[1]), Vector::splat(own.offset));
        let (reach, inverse_arm2) = (R::splat(own.reach), R::splat(own.inverse_arm2));
        let bounds = &mut self.bounds[op.dyad];
        let mut closings = [Closing::CLOSED; G];
        for g in 0..self.groups.min(G) {
            let k = (end[0][g] - start[0][g]) - offset;
            let solved = Guided::circle_and_line::<CAREFUL>(&a, guide, k, signs[g], reach);
            if CAREFUL {
                closings[g] = solved.closing;
            } else {
                self.open[g] = self.open[g].or(solved.closing.open);
                bounds[g] = self.bound[g] * (solved.closing.sine2 * inverse_arm2);
            }
            let (a0, inverse) = (solved.turned, solved.inverse_determinant);
            leg[0][g] = a0;
            s[0][g] = solved.slide;
            if CAREFUL || op.turns[0] {
                turn[g] = a.turn_to(a0);
            }
            for k in 1..len {
                let mut rest = end[k][g] - start[k][g];
                let mut a_rest = Vector::ZERO;
                if !terms(k).is_empty() {
                    for term in terms(k) {
                        let factor = R::splat(term.factor);
                        a_rest += leg[term.left][g].scale(factor * u[term.right][g]);
                    }
                    a_rest = a_rest.left();
                    rest = rest - a_rest;
                }
                let rate = -(guide.cross(rest) * inverse);
                u[k][g] = rate;
                s[k][g] = -(a0.dot(rest) * inverse);
                let a_top = a0.left().scale(rate);
                leg[k][g] = if terms(k).is_empty() { a_top } else { a_rest + a_top };
            }
        }
        if CAREFUL {
            self.record_closings(cx, op, &closings);
        }
        self.turn_orientations(cx, op);
    }
}
