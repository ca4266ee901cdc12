//! Traces the branch of a driven angle, or of a driven slide, by knots solved side by side, whether or
//! not the design reaches them all: shows that its signs are constant, and unwraps angles across its
//! gaps.
//!
//! The knots of a turn or of a stretch are judged cell by cell. A cell where something may happen is divided by
//! knots of its own, and these cells again. A design that may have a change point, or angles that
//! cannot be followed in this way, are left to [`super::tracer`].

use std::f64::consts::{PI, TAU};

use super::branch::Branch;
use super::cell_test::has;
use super::gap_end::Shown;
use super::gap_ends::GapEnds;
use super::grid::KNOTS;
use super::look::Look;
use super::uniform::UniformTracer;
use crate::math::angle::{unwrap_to, whole_turns};
use crate::math::lanes::Real;
use crate::math::tolerance::{GAP_MAX_TURN, KNOT_MAX_TURN};
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
/// How far (rad) an angle may step across a gap whose ends are known from looks alone: not so nearly
/// half a turn that their errors decide which way it goes.
const MAX_KNOWN_STEP: f64 = PI - 0.0625;
/// Looks at one design.
const MAX_LOOKS: usize = 256;
/// Levels at which islands are searched for: down to the 200th part of a cell.
const ISLAND_LEVELS: usize = 2;

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
    pub(super) ends: GapEnds,
    /// Whether an angle steps by about half a turn across a gap with one of these.
    is_ambiguous: bool,
    /// Whether it does so across any gap, so nearly that ends have to be known to rounding.
    is_tie: bool,
}

impl LaneTracer {
    /// Traces the turn, or the stretch, whose knots have been solved into `branch`, with the angles of `classes`;
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
        if !self.take_turn(cx, knots, classes, settled) {
            return false;
        }
        self.ends.clear();
        if !classes.is_empty() {
            self.find_ends::<L, G>(cx, knots, classes);
        }
        loop {
            let traced = self.follow_knots::<L, G>(cx, knots, classes, start, settled, branch);
            if !self.is_ambiguous {
                return traced && !self.is_tie;
            }
            self.ends.clear();
            self.looks[0].next = 1;
        }
    }

    /// Takes what the knots of the turn show; false if one of them is singular.
    #[inline(always)]
    pub(super) fn take_turn<R: Real, const G: usize>(
        &mut self,
        cx: &Context<'_>,
        knots: &UniformTracer<R, G>,
        classes: &[usize],
        settled: &[bool],
    ) -> bool {
        let grid = knots.grid();
        self.looks[0].take(cx, knots, classes, settled, (grid.from, grid.cell))
    }

    /// Finds the ends of its gaps.
    #[inline(always)]
    pub(super) fn find_ends<L: Level, const G: usize>(
        &mut self,
        cx: &Context<'_>,
        knots: &mut UniformTracer<L::Register, G>,
        classes: &[usize],
    ) {
        self.ends.find::<L, G>(cx, knots, classes, &self.looks[0].shown());
    }

    /// What the knots of the turn show of the ends of gaps.
    pub(super) fn turn(&self) -> Shown<'_> {
        self.looks[0].shown()
    }

    /// Whether a sign may change between two knots of the turn.
    pub(super) fn has_uncertain_cells(&self) -> bool {
        let look = &self.looks[0];
        look.uncertain | look.curved | look.may_hide_island != 0
    }

    /// Whether every end of a gap has been found.
    pub(super) fn has_found_all_ends(&self) -> bool {
        self.ends.cells() == self.looks[0].dead_point
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
        (self.is_ambiguous, self.is_tie) = (false, false);
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
        if !knots.grid().is_turn {
            return true;
        }
        for (index, &class) in classes.iter().enumerate().take(self.first.len()) {
            let [a, b] = [self.first[index], self.last[index]];
            branch.gain[class] = TAU * whole_turns(b - a);
            self.judge_step((a + branch.gain[class]) - b);
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
            fast |= turned.abs() > KNOT_MAX_TURN || rate * look.cell.abs() > KNOT_MAX_TURN;
        }
        Some(fast)
    }

    /// Whether a step across a gap leaves open which way is the shorter.
    #[inline(always)]
    fn judge_step(&mut self, step: f64) {
        self.is_ambiguous |= !self.ends.is_empty() && step.abs() > GAP_MAX_TURN;
        self.is_tie |= step.abs() > MAX_KNOWN_STEP;
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
            let mut last = self.last[index];
            if !is_first && !was_reached && reached {
                // Through the dead point between both knots.
                follow(&mut last, self.principal[index]);
                self.judge_step(last - self.last[index]);
            }
            if reached && !has_first {
                self.first.push(if is_first { unwrap_to(next, last) } else { last });
            }
            if reached || was_reached {
                follow(&mut last, next);
            }
            branch.angles[row + class] = last;
            self.last[index] = last;
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

impl<R: Real, const G: usize> UniformTracer<R, G> {
    /// Sets [`CLOSER_KNOTS`] between `from` and a cell's width beyond it.
    #[inline(always)]
    fn set_between(&mut self, (from, width): (f64, f64)) {
        self.state.groups = CLOSER_KNOTS / R::LANES;
        for group in 0..self.state.groups.min(G) {
            self.set_group(group, |lane| from + (width / CELLS) * lane as f64);
        }
    }
}
