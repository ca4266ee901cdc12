//! The dyad of a leg and a slide along a guide on a moving link that is already solved (RRP).

use super::intersections::Guided;
use super::turning_leg::entry;
use crate::math::derivatives::{Term, one_driver};
use crate::math::lanes::{Mask, Real};
use crate::math::vector::Vector;
use crate::plan::tape::DyadOp;
use crate::state::state::{Context, State};

impl<R: Real, const G: usize> State<R, G> {
    /// Solves the dyad for its leg and slide, and their analogues.
    #[inline(always)]
    pub(crate) fn moving_guide(&mut self, cx: &Context<'_>, op: &DyadOp) {
        if R::LANES > 1 || cx.derivatives.drivers > 1 {
            // Lanes rarely take the checked path: one copy for all orders is enough.
            self.moving_of_length::<true>(cx, op, self.len, &|k: usize| {
                (&cx.derivatives.rotation[k][..], &cx.derivatives.mixed[k][..])
            });
        } else {
            self.moving_of_length::<true>(cx, op, self.len, &one_driver);
        }
    }

    /// The same on the unchecked path: one driver, and jets of a constant length.
    #[inline(always)]
    pub(crate) fn unchecked_moving_guide<const LEN: usize>(
        &mut self,
        cx: &Context<'_>,
        op: &DyadOp,
    ) {
        self.moving_of_length::<false>(cx, op, LEN, &one_driver);
    }

    #[inline(always)]
    fn moving_of_length<'t, const CHECKED: bool>(
        &mut self,
        cx: &Context<'_>,
        op: &DyadOp,
        len: usize,
        terms: &impl Fn(usize) -> (&'t [Term], &'t [Term]),
    ) {
        let jet = |i: usize| i * len..i * len + len;
        let Some(carrier) = op.carrier else { return };
        let (start, end) = (&self.pose.points[jet(op.start)], &self.pose.points[jet(op.end)]);
        let carrier = &self.pose.orient[jet(carrier)];
        let [class, slide] = op.unknowns;
        let leg = &mut self.pose.legs[jet(2 * op.dyad)];
        let (u, s) = (&mut self.pose.theta[jet(class)], &mut self.pose.slides[jet(slide)]);
        let turn = &mut self.pose.class[class];
        let signs = &self.pose.signs[op.sign.unwrap_or(0)];
        let dyad = &cx.constants.dyads[op.dyad];
        let a = cx.constants.legs[op.dyad][0].on_lanes();
        let (along, offset) = (Vector::splat(dyad.guides[1]), Vector::splat(dyad.offset));
        let (reach, inverse_arm2) = (R::splat(dyad.reach), R::splat(dyad.inverse_arm2));
        let bounds = &mut self.conditions.bounds[op.dyad];
        for g in 0..self.groups.min(G) {
            let guide = carrier[0][g] * along;
            let chord = (end[0][g] - start[0][g]) - carrier[0][g] * offset;
            let solved = Guided::circle_and_line::<CHECKED>(&a, guide, chord, signs[g], reach);
            if CHECKED {
                self.work.closings[g] = solved.closing;
            } else {
                self.conditions.open[g] = self.conditions.open[g].or(solved.closing.open);
                let dyad_bound = solved.closing.sine2 * inverse_arm2;
                bounds[g] = if op.may_have_upstream() {
                    self.conditions.bound[g] * dyad_bound
                } else {
                    dyad_bound
                };
            }
            let (a0, inverse) = (solved.turned, solved.inverse_determinant);
            leg[0][g] = a0;
            turn[g] = a.turn_to(a0);
            s[0][g] = solved.slide;
            // The point at the slide, in the frame of the carrier.
            let arm = offset + along.scale(solved.slide);
            for k in 1..len {
                let (turning, mixed) = terms(k);
                let mut chord = (end[k][g] - start[k][g]) - carrier[k][g] * arm;
                let mut rest = None;
                if !turning.is_empty() {
                    let (mut of_leg, mut sliding) = (Vector::ZERO, Vector::ZERO);
                    for term in turning {
                        let factor = R::splat(term.factor);
                        of_leg += leg[term.left][g].scale(factor * u[term.right][g]);
                    }
                    for term in mixed {
                        let factor = R::splat(term.factor);
                        sliding += carrier[term.left][g].scale(factor * s[term.right][g]);
                    }
                    let of_leg = of_leg.left();
                    chord = (chord - along * sliding) - of_leg;
                    rest = Some(of_leg);
                }
                u[k][g] = -(guide.cross(chord) * inverse);
                s[k][g] = -(a0.dot(chord) * inverse);
                leg[k][g] = entry(a0, u[k][g], rest);
            }
        }
        if CHECKED {
            self.record_closings(cx, op);
        }
        self.turn_orientations(cx, op);
    }
}
