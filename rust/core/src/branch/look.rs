//! One look at a turn or at a cell of it: knots solved side by side, and what they show.

use super::cell_test::{Bits, DyadSamples, Knots};
use super::gap_end::Shown;
use super::grid::KNOTS;
use super::uniform::UniformTracer;
use crate::math::lanes::{Mask, Real};
use crate::plan::dyad::Dyad;
use crate::state::state::Context;

/// What one look showed.
#[derive(Debug, Default)]
pub(super) struct Look {
    /// The first knot, and the width of a cell.
    pub from: f64,
    pub cell: f64,
    /// Number of knots.
    pub count: usize,
    /// The next cell to be judged: that before this knot.
    pub next: usize,
    pub dyads: Vec<DyadSamples>,
    /// Cells in which a sign may change …
    pub uncertain: Bits,
    pub curved: Bits,
    /// … and that end at a dead point of some dyad that matters.
    pub dead_point: Bits,
    /// … and those that may hide an island.
    pub may_hide_island: Bits,
    pub reached: Bits,
    /// Angle and rate of the classes asked for, at every knot.
    pub angles: Vec<[f64; KNOTS]>,
    pub rates: Vec<[f64; KNOTS]>,
}

impl Look {
    /// Takes what the knots just solved show; false if one of them is singular.
    #[inline(always)]
    pub(super) fn take<R: Real, const G: usize>(
        &mut self,
        cx: &Context<'_>,
        knots: &UniformTracer<R, G>,
        classes: &[usize],
        settled: &[bool],
        (from, cell): (f64, f64),
    ) -> bool {
        (self.from, self.cell, self.next) = (from, cell, 1);
        let state = &knots.state;
        let groups = state.groups.min(G);
        self.count = groups * R::LANES;
        self.reached = 0;
        for group in 0..groups {
            if knots.not_closed(group).and(state.conditions.open[group].not()).any() {
                return false;
            }
            self.reached |= state.conditions.open[group].not().bits() << (group * R::LANES);
        }
        let islands = !classes.is_empty();
        // Without angles, dyads matter for signs that may change, and up to the last of these.
        let unsettled = |dyad: &Dyad| dyad.sign.is_some() && !settled[dyad.index];
        let last = cx.plan.dyads().filter(|dyad| unsettled(dyad)).last();
        let last = last.map_or(0, |dyad| dyad.index);
        let look = Knots { groups, cell, islands };
        let mut known = Bits::MAX;
        [self.uncertain, self.curved, self.dead_point, self.may_hide_island] = [0; 4];
        for (index, dyad) in cx.plan.dyads().enumerate() {
            if !islands && index > last {
                break;
            }
            if self.dyads.len() == index {
                self.dyads.push(DyadSamples::NONE);
            }
            let own = &mut self.dyads[index];
            let settled = settled[index];
            let Some(cells) = own.judge(state, cx, dyad, look, (known, settled)) else {
                return false;
            };
            known = own.closes;
            self.uncertain |= cells.uncertain;
            self.curved |= cells.curved;
            if islands || index < last {
                self.dead_point |= cells.dead_point;
            }
            self.may_hide_island |= cells.may_hide_island;
        }
        if islands {
            // A later dyad that nothing asked for depends on is sampled, but not solved.
            self.reached &= known;
        }
        self.angles.resize(classes.len(), [0.0; KNOTS]);
        self.rates.resize(classes.len(), [0.0; KNOTS]);
        for (index, &class) in classes.iter().enumerate() {
            for group in 0..groups {
                // Beyond a dead point a rotation's length is not 1.
                let angle = state.pose.class[class][group].angle();
                let rate = state.pose.theta[state.len * class + 1][group];
                for lane in 0..R::LANES {
                    self.angles[index][group * R::LANES + lane] = angle.lane(lane);
                    self.rates[index][group * R::LANES + lane] = rate.lane(lane);
                }
            }
        }
        true
    }

    /// What its knots show of the ends of gaps.
    pub(super) fn shown(&self) -> Shown<'_> {
        let against = self.uncertain | self.curved | self.may_hide_island;
        // Where another dyad is open on both sides, it may close between them.
        let at_one_end = self.reached ^ (self.reached << 1);
        Shown {
            from: self.from,
            cell: self.cell,
            count: self.count,
            cells: self.dead_point & !against & at_one_end & !1,
            reached: self.reached,
            dyads: &self.dyads,
            angles: &self.angles,
            rates: &self.rates,
        }
    }

    /// Goes to the next cell in which something may happen to a sign.
    #[inline(always)]
    pub(super) fn skip_quiet_cells(&mut self) {
        if self.next < self.count {
            let left = (self.uncertain | self.curved | self.dead_point) >> self.next;
            self.next = (self.next + left.trailing_zeros() as usize).min(self.count);
        }
    }

    /// Whether all angles are known at both ends of the cell before a knot: beyond a dead point a
    /// dyad behind it may have no definite position.
    pub(super) fn is_definite(&self, knot: usize) -> bool {
        self.angles.iter().all(|angles| angles[knot].is_finite() && angles[knot - 1].is_finite())
    }

    /// Whether all dyads that close beside the dead point in the cell before a knot stay away from
    /// flat up to it.
    pub(super) fn stays_away(&self, knot: usize) -> bool {
        let change = self.dyads.iter().find_map(|dyad| dyad.change_to_dead_point(knot));
        change.is_none_or(|change| self.dyads.iter().all(|dyad| dyad.stays_away(knot, change)))
    }
}
