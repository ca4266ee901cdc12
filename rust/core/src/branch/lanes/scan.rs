//! A scan: evenly spaced knots solved in lanes over the whole grid or over one cell, to classify the cells
//! between them.

use super::cell_test::{Bits, DyadSamples, ScanGrid};
use super::gap_end::ScanView;
use super::grid::{KNOTS, previous};
use super::uniform::UniformTracer;
use crate::math::angle::unwrap_to;
use crate::math::lanes::{Mask, Real};
use crate::math::tolerance::KNOT_MAX_TURN;
use crate::plan::dyad::Dyad;
use crate::state::state::Context;

/// Samples at the knots of a scan, and the classification of its cells.
#[derive(Debug, Default)]
pub(in crate::branch) struct Scan {
    /// The first knot, and the width of a cell.
    pub from: f64,
    pub cell: f64,
    /// Number of knots.
    pub count: usize,
    /// The knot at the end of the next cell to trace.
    pub next: usize,
    pub dyads: Vec<DyadSamples>,
    /// Cells in which a sign may change.
    pub uncertain: Bits,
    /// Cells whose discriminants vary too fast for two knots.
    pub curved: Bits,
    /// Cells with a dead point that matters for the requested angles or for a sign.
    pub dead_point: Bits,
    pub may_hide_island: Bits,
    /// Cells over which a requested angle turns fast.
    pub fast: Bits,
    /// Knots that can be reached.
    pub reached: Bits,
    /// Angle and rate of the requested classes at every knot.
    pub angles: Vec<[f64; KNOTS]>,
    pub rates: Vec<[f64; KNOTS]>,
}

impl Scan {
    /// Scans the knots just solved; false if one of them is singular.
    #[inline(always)]
    pub(in crate::branch) fn take<R: Real, const G: usize>(
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
        // Without angles only signs that may change matter, and the dyads before the last of them.
        let unsettled = |dyad: &Dyad| dyad.sign.is_some() && !settled[dyad.index];
        let last = cx.plan.dyads().filter(|dyad| unsettled(dyad)).last();
        let last = last.map_or(0, |dyad| dyad.index);
        let grid = ScanGrid { groups, cell, islands };
        let mut closing = Bits::MAX;
        [self.uncertain, self.curved, self.dead_point, self.may_hide_island] = [0; 4];
        self.fast = 0;
        for (index, dyad) in cx.plan.dyads().enumerate() {
            if !islands && index > last {
                break;
            }
            if self.dyads.len() == index {
                self.dyads.push(DyadSamples::NONE);
            }
            let samples = &mut self.dyads[index];
            let settled = settled[index];
            let Some(cells) = samples.classify(state, cx, dyad, grid, (closing, settled)) else {
                return false;
            };
            closing = samples.closes;
            self.uncertain |= cells.uncertain;
            self.curved |= cells.curved;
            if islands || index < last {
                self.dead_point |= cells.dead_point;
            }
            self.may_hide_island |= cells.may_hide_island;
        }
        if islands {
            // A later dyad that no requested quantity depends on is sampled, but not solved.
            self.reached &= closing;
        }
        self.angles.resize(classes.len(), [0.0; KNOTS]);
        self.rates.resize(classes.len(), [0.0; KNOTS]);
        for (index, &class) in classes.iter().enumerate() {
            let (mut last, limit, cell) = (R::ZERO, R::splat(KNOT_MAX_TURN), R::splat(cell));
            let mut last_rate = R::ZERO;
            for group in 0..groups {
                // Beyond a dead point a rotation's length is not 1, so `unit_angle` would be wrong.
                let angle = state.pose.class[class][group].angle();
                let rate = state.pose.theta[state.len * class + 1][group];
                let before = previous(last.lane(R::LANES - 1), angle);
                let turned = unwrap_to(angle, before) - before;
                let rate_before = previous(last_rate.lane(R::LANES - 1), rate);
                let is_fast =
                    turns_fast(turned, [rate_before, rate].map(|rate| rate * cell), limit);
                self.fast |= is_fast.bits() << (group * R::LANES);
                (last, last_rate) = (angle, rate);
                for lane in 0..R::LANES {
                    self.angles[index][group * R::LANES + lane] = angle.lane(lane);
                    self.rates[index][group * R::LANES + lane] = rate.lane(lane);
                }
            }
        }
        true
    }

    /// The data of the scan on the ends of gaps.
    pub(in crate::branch) fn view(&self) -> ScanView<'_> {
        ScanView {
            from: self.from,
            cell: self.cell,
            cells: self.dead_point & !self.uncertain_cells() & !1,
            reached: self.reached,
            dyads: &self.dyads,
            angles: &self.angles,
            rates: &self.rates,
        }
    }

    /// Cells in which a sign may change, or a gap or an island may hide.
    pub(in crate::branch) fn uncertain_cells(&self) -> Bits {
        self.uncertain | self.curved | self.may_hide_island
    }

    /// Cells that can be reached from end to end, over which a requested angle turns fast.
    pub(in crate::branch) fn fast_cells(&self) -> Bits {
        self.fast & self.reached & self.reached << 1
    }

    /// Skips cells in which no sign can change.
    #[inline(always)]
    pub(in crate::branch) fn skip_quiet_cells(&mut self) {
        if self.next < self.count {
            let left = (self.uncertain | self.curved | self.dead_point) >> self.next;
            self.next = (self.next + left.trailing_zeros() as usize).min(self.count);
        }
    }

    /// The knot at the end of the cells from [`Self::next`] on that do not need a closer scan and lie
    /// within or outside the reachable range.
    pub(in crate::branch) fn end_of_quiet_cells(&self, with_islands: bool) -> usize {
        if self.next >= self.count {
            return self.next;
        }
        let changes = self.reached ^ (self.reached << 1);
        let islands = if with_islands { self.may_hide_island } else { 0 };
        let busy =
            self.uncertain | self.curved | self.dead_point | self.fast_cells() | changes | islands;
        (self.next + (busy >> self.next).trailing_zeros() as usize).min(self.count)
    }

    /// Whether all angles are defined at both ends of the cell before a knot: beyond a dead point a
    /// later dyad may have no position.
    pub(in crate::branch) fn is_definite(&self, knot: usize) -> bool {
        self.angles.iter().all(|angles| angles[knot].is_finite() && angles[knot - 1].is_finite())
    }

    /// Whether all dyads that close beside the dead point in the cell before a knot stay away from
    /// flat up to it.
    pub(in crate::branch) fn stays_away(&self, knot: usize) -> bool {
        let change = self.dyads.iter().find_map(|dyad| dyad.change_to_dead_point(knot));
        change.is_none_or(|change| self.dyads.iter().all(|dyad| dyad.stays_away(knot, change)))
    }
}

/// Whether an angle turns too fast over a cell for two knots to count its turns. `turned`: its change, in
/// which whole turns may be missing; `tangents`: its rates at both knots, times the cell.
#[inline(always)]
fn turns_fast<R: Real>(turned: R, tangents: [R; 2], limit: R) -> R::Mask {
    let [from, to] = tangents;
    let (turns, steepest) = (turned.abs(), from.abs().max(to.abs()));
    let slow = turns.le(limit).and(steepest.le(limit));
    // A smooth turn agrees with the trapezoidal rule.
    let apart = (turned - R::splat(0.5) * (from + to)).abs();
    let smooth = apart.le(R::splat(0.5) * limit).and(turns.le(R::splat(2.0) * limit));
    slow.or(smooth.and(steepest.le(R::splat(3.0) * limit))).not()
}
