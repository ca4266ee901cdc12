//! Traces the branch of a driven angle by knots solved side by side, whether or not the design
//! turns fully: shows that its signs are constant, and unwraps angles across its gaps.
//!
//! The knots of a turn are judged cell by cell. A cell where something may happen is divided by
//! knots of its own, and these cells again. A design that may have a change point, or angles that
//! cannot be followed in this way, are left to [`super::tracer`].

use std::f64::consts::TAU;

use super::branch::Branch;
use super::cell_test::{Bits, DyadSamples, Knots, has};
use super::gap_ends::{GapEnds, MAX_STEP, Shown};
use super::uniform::{CELL, KNOTS, UniformTracer, reference_of};
use crate::math::angle::{Reference, unwrap_to, whole_turns};
use crate::math::lanes::{Mask, Real};
use crate::math::tolerance::KNOT_MAX_TURN;
use crate::math::vector::Vector;
use crate::plan::dyad::Dyad;
use crate::state::kernel::Level;
use crate::state::state::Context;

/// Knots of a closer look: half of those of a turn.
const CLOSER_KNOTS: usize = KNOTS / 2;
/// Cells between these.
const CELLS: f64 = (CLOSER_KNOTS - 1) as f64;
/// Levels of looks, each [`CELLS`] times as close as the one before: down to the 50 000th part of a
/// cell.
const LEVELS: usize = 5;
/// Those at which dead points are looked at: down to the 3 000th part of a cell. Angles at the knot
/// beyond, where the dyad is computed flat, are those at the dead point to about as much.
const DEAD_POINT_LEVELS: usize = 3;
/// Looks at one design.
const MAX_LOOKS: usize = 256;
/// Levels at which islands are searched for: down to the 200th part of a cell.
const ISLAND_LEVELS: usize = 2;

/// What one look showed.
#[derive(Debug, Default)]
struct Look {
    /// The first knot, and the width of a cell.
    from: f64,
    cell: f64,
    /// Number of knots.
    count: usize,
    /// The next cell to be judged: that before this knot.
    next: usize,
    dyads: Vec<DyadSamples>,
    /// Cells in which a sign may change …
    uncertain: Bits,
    curved: Bits,
    /// … and that end at a dead point of some dyad that matters.
    dead_point: Bits,
    /// … and those that may hide an island.
    may_hide_island: Bits,
    reached: Bits,
    /// Angle and rate of the classes asked for, at every knot.
    angles: Vec<[f64; KNOTS]>,
    rates: Vec<[f64; KNOTS]>,
}

/// Work space, kept from one design to the next.
#[derive(Debug, Default)]
pub(crate) struct LaneTracer {
    looks: [Look; LEVELS],
    /// Unwrapped angles of the classes asked for at the last knot.
    last: Vec<f64>,
    /// The same where the first position can be reached; empty before.
    first: Vec<f64>,
    /// Angles at the last knot, not unwrapped, and at the next.
    principal: Vec<f64>,
    next: Vec<f64>,
    was_reached: bool,
    ends: GapEnds,
    /// Whether an angle steps by about half a turn across a gap with one of these.
    is_ambiguous: bool,
}

impl LaneTracer {
    /// Traces the turn whose knots have been solved into `branch`, with the angles of `classes`;
    /// false if the design is not one of constant signs and smooth angles. `start`: the drawing's
    /// angles; `settled`: dyads whose signs are known to be constant.
    #[inline(always)]
    pub(crate) fn trace<L: Level, const G: usize>(
        &mut self,
        cx: &Context<'_>,
        knots: &mut UniformTracer<L::Register, G>,
        classes: &[usize],
        start: &[f64],
        settled: &[bool],
        branch: &mut Branch,
    ) -> bool {
        if !self.looks[0].take(cx, knots, classes, settled, (knots.first(), CELL)) {
            return false;
        }
        self.ends.clear();
        if !classes.is_empty() {
            self.ends.find::<L, G>(cx, knots, classes, &self.looks[0].shown());
        }
        let traced = self.follow_knots::<L, G>(cx, knots, classes, start, settled, branch);
        if !self.is_ambiguous {
            return traced;
        }
        self.ends.clear();
        self.looks[0].next = 1;
        self.follow_knots::<L, G>(cx, knots, classes, start, settled, branch)
    }

    /// Whether a design with gaps is plain, to be seen without following its angles knot by knot: no
    /// sign may change between two of the knots that have been solved, all gaps end where they should,
    /// and no angle asked for turns fast or far. Sets the reference of each class.
    #[inline(always)]
    pub(crate) fn survey<L: Level, const G: usize>(
        &mut self,
        cx: &Context<'_>,
        knots: &mut UniformTracer<L::Register, G>,
        (classes, start): (&[usize], &[f64]),
        settled: &[bool],
        references: &mut [Reference],
    ) -> bool {
        if !self.looks[0].take(cx, knots, classes, settled, (knots.first(), CELL)) {
            return false;
        }
        let look = &self.looks[0];
        if look.uncertain | look.curved | look.may_hide_island != 0 {
            return false;
        }
        self.ends.find::<L, G>(cx, knots, classes, &look.shown());
        if self.ends.cells() != look.dead_point {
            return false;
        }
        for (index, &class) in classes.iter().enumerate() {
            let range = self.ends.range(&look.shown(), index, start[class]);
            let Some(reference) = range.and_then(reference_of) else { return false };
            references[class] = reference;
        }
        true
    }

    /// Traces the turn by the knots of the first look, and closer ones.
    #[inline(always)]
    fn follow_knots<L: Level, const G: usize>(
        &mut self,
        cx: &Context<'_>,
        knots: &mut UniformTracer<L::Register, G>,
        classes: &[usize],
        start: &[f64],
        settled: &[bool],
        branch: &mut Branch,
    ) -> bool {
        branch.set_constant_signs(start.len(), cx.signs);
        self.last.clear();
        self.last.extend(classes.iter().map(|&class| start[class]));
        self.first.clear();
        self.is_ambiguous = false;
        if !classes.is_empty() {
            self.push(0, 0, classes, branch);
        }
        let (mut level, mut count) = (0, 0);
        loop {
            if classes.is_empty() {
                self.looks[level].skip_quiet_cells();
            }
            let knot = self.looks[level].next;
            if knot == self.looks[level].count {
                if level == 0 {
                    break;
                }
                level -= 1;
                self.looks[level].next += 1;
                continue;
            }
            let within = (self.looks[level].from, self.looks[level].cell);
            let ends = if level == 0 { self.ends.beside(within, knot) } else { None };
            if let Some(beside) = ends {
                for beside in beside {
                    self.next.clear();
                    let angles = (0..classes.len()).map(|class| self.ends.angle(class, &beside));
                    self.next.extend(angles);
                    self.push_next((beside.at, beside.reached), classes, branch);
                }
            }
            let looked = if ends.is_some() {
                Some(false)
            } else {
                self.needs_closer_look(level, knot, !classes.is_empty())
            };
            let Some(closer) = looked else {
                return false;
            };
            if closer && level + 1 < LEVELS {
                let look = &self.looks[level];
                let (from, width) = (look.from + look.cell * (knot - 1) as f64, look.cell);
                knots.set_between((from, width));
                if !classes.is_empty() && has(look.dead_point, knot) {
                    // Some of these knots are beyond it.
                    knots.solve_carefully::<L>(cx);
                } else {
                    knots.solve::<L>(cx, !classes.is_empty());
                }
                level += 1;
                count += 1;
                let within = (from, width / CELLS);
                let taken = self.looks[level].take(cx, knots, classes, settled, within);
                if !taken || count > MAX_LOOKS {
                    return false;
                }
                continue;
            }
            if !classes.is_empty() {
                self.push(level, knot, classes, branch);
            }
            self.looks[level].next += 1;
        }
        for ((&class, &a), &b) in classes.iter().zip(&self.first).zip(&self.last) {
            branch.gain[class] = TAU * whole_turns(b - a);
            let step = (b - a) - branch.gain[class];
            self.is_ambiguous |= !self.ends.is_empty() && step.abs() > MAX_STEP;
        }
        if !classes.is_empty() {
            branch.period = Some(TAU);
        }
        true
    }

    /// Whether the cell before a knot needs a closer look; `None` if none would be close enough.
    #[inline(always)]
    fn needs_closer_look(&self, level: usize, knot: usize, angles: bool) -> Option<bool> {
        let look = &self.looks[level];
        let last = level + 1 == LEVELS;
        if has(look.uncertain, knot) {
            return (!last).then_some(true);
        }
        if has(look.curved, knot) && !last {
            return Some(true);
        }
        if has(look.dead_point, knot) {
            return Some(if angles {
                level < DEAD_POINT_LEVELS || !look.is_definite(knot)
            } else {
                !look.stays_away(knot)
            });
        }
        if has(look.may_hide_island, knot) && level < ISLAND_LEVELS {
            return Some(true);
        }
        if !(angles && has(look.reached, knot) && has(look.reached, knot - 1)) {
            return Some(false);
        }
        let mut fast = false;
        for (index, (angles, rates)) in look.angles.iter().zip(&look.rates).enumerate() {
            let turned = unwrap_to(angles[knot], self.last[index]) - self.last[index];
            if last && turned.abs() > KNOT_MAX_TURN {
                return None;
            }
            let rate = rates[knot].abs().max(rates[knot - 1].abs());
            fast |= turned.abs() > KNOT_MAX_TURN || rate * look.cell > KNOT_MAX_TURN;
        }
        Some(fast)
    }

    /// Adds a knot of a look to the branch.
    #[inline(always)]
    fn push(&mut self, level: usize, knot: usize, classes: &[usize], branch: &mut Branch) {
        let look = &self.looks[level];
        self.next.clear();
        self.next.extend(look.angles.iter().map(|angles| angles[knot]));
        let at = look.from + look.cell * knot as f64;
        self.push_next((at, has(look.reached, knot)), classes, branch);
    }

    /// Adds a knot with the next angles to the branch.
    #[inline(always)]
    fn push_next(&mut self, (at, reached): (f64, bool), classes: &[usize], branch: &mut Branch) {
        let width = branch.gain.len();
        let row = branch.angles.len();
        let is_first = branch.at.is_empty();
        branch.at.push(at);
        branch.reached.push(reached);
        branch.angles.resize(row + width, 0.0);
        let has_first = !self.first.is_empty();
        let was_reached = self.was_reached && !is_first;
        for (index, &class) in classes.iter().enumerate() {
            let next = self.next[index];
            let last = &mut self.last[index];
            if !is_first && !was_reached && reached {
                // Through the dead point between both knots.
                let before = *last;
                follow(last, self.principal[index]);
                self.is_ambiguous |= !self.ends.is_empty() && (*last - before).abs() > MAX_STEP;
            }
            if reached && !has_first {
                self.first.push(if is_first { unwrap_to(next, *last) } else { *last });
            }
            if reached || was_reached {
                follow(last, next);
            }
            branch.angles[row + class] = *last;
        }
        self.was_reached = reached;
        std::mem::swap(&mut self.principal, &mut self.next);
    }
}

/// Follows an angle to its next value, if that is definite.
#[inline(always)]
fn follow(last: &mut f64, next: f64) {
    if next.is_finite() {
        *last = unwrap_to(next, *last);
    }
}

impl Look {
    /// Takes what the knots just solved show; false if one of them is singular.
    #[inline(always)]
    fn take<R: Real, const G: usize>(
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
    fn shown(&self) -> Shown<'_> {
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
    fn skip_quiet_cells(&mut self) {
        if self.next < self.count {
            let left = (self.uncertain | self.curved | self.dead_point) >> self.next;
            self.next = (self.next + left.trailing_zeros() as usize).min(self.count);
        }
    }

    /// Whether all angles are known at both ends of the cell before a knot: beyond a dead point a
    /// dyad behind it may have no definite position.
    fn is_definite(&self, knot: usize) -> bool {
        self.angles.iter().all(|angles| angles[knot].is_finite() && angles[knot - 1].is_finite())
    }

    /// Whether all dyads that close beside the dead point in the cell before a knot stay away from
    /// flat up to it.
    fn stays_away(&self, knot: usize) -> bool {
        let change = self.dyads.iter().find_map(|dyad| dyad.change_to_dead_point(knot));
        change.is_none_or(|change| self.dyads.iter().all(|dyad| dyad.stays_away(knot, change)))
    }
}

impl<R: Real, const G: usize> UniformTracer<R, G> {
    /// Sets [`CLOSER_KNOTS`] between `from` and a cell's width beyond it.
    #[inline(always)]
    fn set_between(&mut self, (from, width): (f64, f64)) {
        self.state.groups = CLOSER_KNOTS / R::LANES;
        for group in 0..self.state.groups.min(G) {
            let place = R::from_lanes(|lane| (group * R::LANES + lane) as f64);
            let at = R::splat(from) + R::splat(width / CELLS) * place;
            self.state.pose.q[0][group] = at;
            self.state.pose.unit[0][group] = Vector::at_angle(at);
        }
    }
}
