//! The dyad with a guide that turns (RPR).

use super::intersections::Guided;
use crate::math::derivatives::{Term, one_driver};
use crate::math::lanes::{Mask, Real};
use crate::math::vector::Vector;
use crate::plan::tape::DyadOp;
use crate::state::state::{Context, State};

impl<R: Real, const G: usize> State<R, G> {
    /// Solves the dyad for the rotation and value of its slide, and their analogues.
    #[inline(always)]
    pub(crate) fn turning_guide(&mut self, cx: &Context<'_>, op: &DyadOp) {
        if R::LANES > 1 || cx.derivatives.drivers > 1 {
            // Lanes rarely take the checked path: one copy for all orders is enough.
            self.turning_of_length::<true>(cx, op, self.len, &|k: usize| {
                (&cx.derivatives.rotation[k][..], &cx.derivatives.mixed[k][..])
            });
            return;
        }
        match self.len {
            1 => self.turning_of_length::<true>(cx, op, 1, &one_driver),
            2 => self.turning_of_length::<true>(cx, op, 2, &one_driver),
            3 => self.turning_of_length::<true>(cx, op, 3, &one_driver),
            _ => self.turning_of_length::<true>(cx, op, 4, &one_driver),
        }
    }

    /// The same on the unchecked path: one driver, and jets of a constant length.
    #[inline(always)]
    pub(crate) fn unchecked_turning_guide<const LEN: usize>(
        &mut self,
        cx: &Context<'_>,
        op: &DyadOp,
    ) {
        self.turning_of_length::<false>(cx, op, LEN, &one_driver);
    }

    /// The rotation's jet takes the slot of the second leg, which this dyad does not have.
    #[inline(always)]
    fn turning_of_length<'t, const CHECKED: bool>(
        &mut self,
        cx: &Context<'_>,
        op: &DyadOp,
        len: usize,
        terms: &impl Fn(usize) -> (&'t [Term], &'t [Term]),
    ) {
        let jet = |i: usize| i * len..i * len + len;
        let (start, end) = (&self.pose.points[jet(op.start)], &self.pose.points[jet(op.end)]);
        let [class, slide] = op.unknowns;
        let Ok([leg, turn]) =
            self.pose.legs.get_disjoint_mut([2 * op.dyad, 2 * op.dyad + 1].map(jet))
        else {
            return;
        };
        let (u, s) = (&mut self.pose.theta[jet(class)], &mut self.pose.slides[jet(slide)]);
        let rotation = &mut self.pose.class[class];
        let signs = &self.pose.signs[op.sign.unwrap_or(0)];
        let dyad = &cx.constants.dyads[op.dyad];
        let a = Vector::splat(cx.constants.legs[op.dyad][0].vector);
        let (guide, inverse_arm2) = (Vector::splat(dyad.guides[1]), R::splat(dyad.inverse_arm2));
        let bounds = &mut self.conditions.bounds[op.dyad];
        for g in 0..self.groups.min(G) {
            let chord = end[0][g] - start[0][g];
            let solved = Guided::turning_guide::<CHECKED>(a, guide, chord, signs[g]);
            if CHECKED {
                self.work.closings[g] = if op.is_length {
                    let scale2 = &self.conditions.coordinate_scale2;
                    let scale2 = scale2[op.start][g].max(scale2[op.end][g]);
                    solved.closing.of_length(chord.norm2(), guide.cross(a), scale2)
                } else {
                    solved.closing
                };
            } else {
                self.conditions.open[g] = self.conditions.open[g].or(solved.closing.open);
                // The arm is relative to the distance.
                let distance2 = R::ONE.min(chord.norm2() * inverse_arm2);
                let dyad_bound = solved.closing.sine2 * distance2;
                bounds[g] = if op.may_have_upstream() {
                    self.conditions.bound[g] * dyad_bound
                } else {
                    dyad_bound
                };
            }
            let (unit, inverse) = (solved.turned, solved.inverse_determinant);
            turn[0][g] = unit;
            rotation[g] = unit;
            s[0][g] = solved.slide;
            let arm = a + guide.scale(solved.slide);
            let along = guide * unit;
            if CHECKED {
                leg[0][g] = unit * a;
            }
            for k in 1..len {
                let (turning, mixed) = terms(k);
                let mut rest = end[k][g] - start[k][g];
                let mut unit_rest = Vector::ZERO;
                if !turning.is_empty() {
                    for term in turning {
                        let factor = R::splat(term.factor);
                        unit_rest += turn[term.left][g].scale(factor * u[term.right][g]);
                    }
                    unit_rest = unit_rest.left();
                    let mut sliding = Vector::ZERO;
                    for term in mixed {
                        let factor = R::splat(term.factor);
                        sliding += turn[term.left][g].scale(factor * s[term.right][g]);
                    }
                    rest = (rest - arm * unit_rest) - guide * sliding;
                }
                let rate = -(along.cross(rest) * inverse);
                u[k][g] = rate;
                s[k][g] = -(chord.dot(rest) * inverse);
                turn[k][g] = unit_rest + unit.left().scale(rate);
                if CHECKED {
                    leg[k][g] = turn[k][g] * a;
                }
            }
        }
        if CHECKED {
            self.record_closings(cx, op);
        }
        self.turn_orientations(cx, op);
    }
}
