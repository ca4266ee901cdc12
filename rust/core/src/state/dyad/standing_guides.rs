//! The dyad of two slides along fixed guides (PRP, RPP).

use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::tape::DyadOp;
use crate::state::closing::Closing;
use crate::state::state::{Context, State};

impl<R: Real, const G: usize> State<R, G> {
    /// Solves the dyad for its slides and their analogues by Cramer's rule: all are linear in the
    /// chord.
    #[inline(always)]
    pub(crate) fn standing_guides<const CHECKED: bool>(&mut self, cx: &Context<'_>, op: &DyadOp) {
        let len = self.len;
        let jet = |i: usize| i * len..i * len + len;
        let (start, end) = (&self.pose.points[jet(op.start)], &self.pose.points[jet(op.end)]);
        let Ok([s, t]) = self.pose.slides.get_disjoint_mut(op.unknowns.map(jet)) else { return };
        let dyad = &cx.constants.dyads[op.dyad];
        let [a, b] = dyad.guides;
        let determinant = a.cross(b);
        let inverse = R::splat(1.0 / determinant);
        let (a, b) = (Vector::splat(a), Vector::splat(b));
        let offset = Vector::splat(dyad.offset);
        let sine2 = R::splat(determinant * determinant);
        let bounds = &mut self.conditions.bounds[op.dyad];
        for k in 0..len {
            for g in 0..self.groups.min(G) {
                let mut chord = end[k][g] - start[k][g];
                if k == 0 {
                    chord = chord - offset;
                }
                s[k][g] = chord.cross(b) * inverse;
                t[k][g] = a.cross(chord) * inverse;
            }
        }
        for g in 0..self.groups.min(G) {
            if CHECKED {
                self.work.closings[g] = Closing::of_lines(s[0][g], t[0][g], R::splat(determinant));
            } else {
                bounds[g] =
                    if op.may_have_upstream() { self.conditions.bound[g] * sine2 } else { sine2 };
            }
        }
        if CHECKED {
            self.record_closings(cx, op);
        }
    }
}
