//! What a dyad's closing means for the position: its condition and status.

use super::intersections::Closing;
use crate::math::lanes::{Mask, Real};
use crate::plan::dyad::Unknown;
use crate::plan::plan::Step;
use crate::plan::tape::DyadOp;
use crate::state::state::{Context, State};
use crate::state::status::{Fault, Status};

impl<R: Real, const G: usize> State<R, G> {
    /// Records how a dyad closes; a single position may fail here.
    #[inline(always)]
    pub(crate) fn record_closings(
        &mut self,
        cx: &Context<'_>,
        op: &DyadOp,
        closings: &[Closing<R>; G],
    ) {
        let Step::Dyad(dyad) = &cx.plan.steps[op.step] else { return };
        for g in 0..self.groups.min(G) {
            let closing = &closings[g];
            let upstream2 = self.point_condition[op.start][g].max(self.point_condition[op.end][g]);
            if let Some(sign) = op.sign {
                self.upstream_condition2[sign][g] = upstream2;
            }
            self.margin[op.dyad][g] = closing.margin;
            self.open[g] = self.open[g].or(closing.open);
            self.mark_open(g, closing.open, || Fault::NotClosed {
                step: op.step,
                gap: closing.gap.lane(0),
            });
            if self.status == Status::Unreachable {
                return;
            }
            let rounding = self.rounding_arm2(g, dyad);
            let mut arm2 = R::ONE;
            for (unknown, per) in dyad.unknowns.into_iter().zip(closing.per_arm2) {
                if let Unknown::Class(class) = unknown {
                    arm2 = (R::splat(cx.constants.max_arm2[class]).max(rounding) * per).max(arm2);
                }
            }
            let condition = upstream2 * arm2 / closing.sine2;
            for unknown in dyad.unknowns {
                match unknown {
                    Unknown::Class(class) => self.class_condition[class][g] = condition,
                    Unknown::Slide(slide) => self.slide_condition[slide][g] = condition,
                }
            }
            self.condition2[g] = condition.max(self.condition2[g]);
            self.needs_scalar[g] = self.needs_scalar[g].or(closing.flat);
            if R::LANES == 1 && closing.flat.any() {
                self.fault.get_or_insert(Fault::Singular { step: op.step });
                self.status = Status::Singular;
                self.set_nan_analogues(g, dyad);
            }
        }
    }

    /// Sets the orientations that turn with a dyad.
    #[inline(always)]
    pub(crate) fn turn_orientations(&mut self, cx: &Context<'_>, op: &DyadOp) {
        for &(orientation, class) in &op.orientations {
            for g in 0..self.groups.min(G) {
                self.update_orientation(g, cx, orientation, class);
            }
        }
    }
}
