//! Condition and status of a position, from how a dyad closes.

use crate::math::lanes::{Mask, Real};
use crate::plan::dyad::{Dyad, Unknown};
use crate::plan::plan::{EdgeSlide, Plan, Step};
use crate::plan::tape::DyadOp;
use crate::state::closing::Closing;
use crate::state::state::{Context, State};
use crate::state::status::{Fault, Status};

impl<R: Real, const G: usize> State<R, G> {
    /// Records how a dyad closes, as its kernel left it; a single position may fail here.
    #[inline(always)]
    pub(crate) fn record_closings(&mut self, cx: &Context<'_>, op: &DyadOp) {
        let Step::Dyad(dyad) = &cx.plan.steps[op.step] else { return };
        for g in 0..self.groups.min(G) {
            let mut upstream2 =
                self.conditions.of_point[op.start][g].max(self.conditions.of_point[op.end][g]);
            if let Some(carrier) = op.carrier {
                let class = cx.plan.orientations[carrier].class;
                upstream2 = upstream2.max(self.conditions.of_class[class][g]);
            }
            let closing = self.work.closings[g];
            self.record_closing(g, cx, (dyad, op.step), &closing, upstream2);
            if R::LANES == 1 && self.status == Status::Singular && closing.flat.any() {
                self.set_nan_analogues(g, dyad);
            }
        }
    }

    /// Records how a dyad (step `index`) closes; `upstream2`: the squared condition of everything that
    /// it depends on.
    #[inline(always)]
    pub(crate) fn record_closing(
        &mut self,
        g: usize,
        cx: &Context<'_>,
        (dyad, index): (&Dyad, usize),
        closing: &Closing<R>,
        upstream2: R,
    ) {
        if let Some(sign) = dyad.sign {
            self.conditions.upstream[sign][g] = upstream2;
        }
        self.conditions.margin[dyad.index][g] = closing.margin;
        self.conditions.open[g] = self.conditions.open[g].or(closing.open);
        self.mark_open(g, closing.open, || Fault::NotClosed {
            step: index,
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
                Unknown::Class(class) => self.conditions.of_class[class][g] = condition,
                Unknown::Slide(slide) => self.conditions.of_slide[slide][g] = condition,
            }
        }
        self.conditions.greatest[g] = condition.max(self.conditions.greatest[g]);
        self.conditions.needs_scalar[g] = self.conditions.needs_scalar[g].or(closing.flat);
        if R::LANES == 1 && closing.flat.any() {
            // Where a length is 0, only its own analogues are unknown: any other dyad counts more.
            if self.fault.is_none() || self.is_at_zero_length(cx.plan) && !dyad.is_length {
                self.fault = Some(Fault::Singular { step: index });
            }
            self.status = Status::Singular;
        }
    }

    /// Whether a position is singular only because a slide whose value is a length is 0: its direction and
    /// analogues are not determined, all others are.
    pub(crate) fn is_at_zero_length(&self, plan: &Plan) -> bool {
        let Some(Fault::Singular { step }) = self.fault else { return false };
        matches!(&plan.steps[step], Step::Dyad(dyad) if dyad.is_length)
    }

    /// Solves a dyad without a kernel (step `index`).
    #[inline(always)]
    pub(crate) fn general_dyad(&mut self, g: usize, cx: &Context<'_>, dyad: &Dyad, index: usize) {
        let mut upstream2 =
            self.conditions.of_point[dyad.start][g].max(self.conditions.of_point[dyad.end][g]);
        for term in &dyad.others {
            if term.turns.is_none() {
                upstream2 = upstream2.max(self.conditions.of_class[cx.plan.class_of(term.edge)][g]);
            }
            if let (EdgeSlide::Slide(slide), None) = (cx.plan.edges[term.edge].along, term.slides) {
                upstream2 = upstream2.max(self.conditions.of_slide[slide][g]);
            }
        }
        let closing = self.solve_dyad(g, cx, dyad);
        self.record_closing(g, cx, (dyad, index), &closing, upstream2);
        match self.status {
            Status::Unreachable if R::LANES == 1 => {}
            Status::Singular if R::LANES == 1 && closing.flat.any() => {
                self.set_nan_analogues(g, dyad);
            }
            _ => self.analogues(g, cx, dyad),
        }
    }

    /// Square of the arm to which the rounding of a dyad's outer joints corresponds: half of their
    /// greatest coordinate (the bounds have a margin for the rest).
    #[inline(always)]
    fn rounding_arm2(&self, g: usize, dyad: &Dyad) -> R {
        R::splat(0.25)
            * self.conditions.coordinate_scale2[dyad.start][g]
                .max(self.conditions.coordinate_scale2[dyad.end][g])
    }

    /// Updates the orientations that turn with a dyad's unknowns.
    #[inline(always)]
    pub(crate) fn turn_orientations(&mut self, cx: &Context<'_>, op: &DyadOp) {
        for &(orientation, class) in &op.orientations {
            for g in 0..self.groups.min(G) {
                self.update_orientation(g, cx, orientation, class);
            }
        }
    }
}
