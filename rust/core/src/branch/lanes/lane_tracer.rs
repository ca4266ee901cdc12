//! Traces the branch of one driver by knots solved in lanes, also across gaps: shows that the signs
//! are constant, and unwraps the angles.
//!
//! A scan classifies the cells between its knots. A cell that may hide a change gets a closer scan, and so
//! on. Designs that may have a change point, or angles that cannot be unwrapped in this way, are left to
//! [`super::super::tracer`].

use std::f64::consts::TAU;

use super::cell_test::has;
use super::gap_ends::{GapEnds, TIE, TIE_AT_ENDS};
use super::grid::KNOTS;
use super::scan::Scan;
use super::surveyed_angle::SurveyedAngle;
use super::uniform::UniformTracer;
use crate::branch::branch::Branch;
use crate::math::angle::{is_tie, is_tie_over_period, unwrap_to, whole_turns};
use crate::math::lanes::Real;
use crate::state::kernel::Level;
use crate::state::state::Context;

/// Knots of a closer scan: half of those of a turn.
const CLOSER_KNOTS: usize = KNOTS / 2;
/// Cells of a closer scan.
const CELLS: f64 = (CLOSER_KNOTS - 1) as f64;
/// Levels of scans, each [`CELLS`] times as close as the one before: down to the 50 000th part of a
/// cell.
const LEVELS: usize = 5;
/// Levels at which dead points are scanned: down to the 3 000th part of a cell. Angles at the knot
/// beyond, where the dyad is computed as flat, are those at the dead point to about this accuracy.
const DEAD_POINT_LEVELS: usize = 3;
/// Greatest distance (rad) of an angle from that at a dead point, if it is not defined beyond.
const UNDEFINED: f64 = 0.03125;
/// Most scans of one design.
const MAX_SCANS: usize = 256;
/// Levels at which islands are searched for: down to the 50 000th part of a cell.
const ISLAND_LEVELS: usize = 4;

/// Work space, reused for all designs.
#[derive(Debug, Default)]
pub(crate) struct LaneTracer {
    pub(in crate::branch) scans: [Scan; LEVELS],
    /// Unwrapped angles of the requested classes at the last knot.
    last: Vec<f64>,
    /// The same at the first position that can be reached; empty before it.
    first: Vec<f64>,
    /// Principal angles at the last knot.
    principal: Vec<f64>,
    /// Principal angles at the next knot.
    next: Vec<f64>,
    was_reached: bool,
    /// The ends of gaps between the knots of each scan.
    pub(in crate::branch) ends: [GapEnds; LEVELS],
    /// Angles of the requested classes in a survey.
    pub(in crate::branch) surveyed: Vec<SurveyedAngle>,
    /// Whether these ends replace closer scans of dead points.
    ends_serve: bool,
    /// The turn of each angle between the last knot that can be reached and the next.
    into_gap: Vec<f64>,
    /// The same at the first position that can be reached.
    into_first: Vec<f64>,
    /// Levels at which dead points are scanned.
    dead_point_levels: usize,
    /// Whether an angle steps so nearly by half a turn across a gap that its turn between the knots beside the
    /// gap's ends decides which way is the shorter.
    is_tie: bool,
}

impl LaneTracer {
    /// Traces the solved knots into `branch`, with the angles of `classes`; false if signs may change or
    /// an angle cannot be unwrapped. `start`: the drawing's angles; `settled`: dyads whose signs are
    /// known to be constant.
    #[inline(always)]
    pub(crate) fn trace<L: Level, const G: usize>(
        &mut self,
        cx: &Context<'_>,
        knots: &mut UniformTracer<L::Register, G>,
        (classes, start): (&[usize], &[f64]),
        settled: &[bool],
        branch: &mut Branch,
    ) -> bool {
        self.ends_serve = !classes.is_empty();
        if !self.take_turn(cx, knots, classes, settled) {
            return false;
        }
        if self.ends_serve {
            self.find_ends::<L, G>(cx, knots, classes, 0);
        }
        self.dead_point_levels = DEAD_POINT_LEVELS;
        loop {
            let traced = self.follow_knots::<L, G>(cx, knots, classes, start, settled, branch);
            if !(traced && self.is_tie) {
                return traced;
            }
            if self.ends_serve {
                self.ends_serve = false;
            } else if self.dead_point_levels < LEVELS {
                self.dead_point_levels = LEVELS;
            } else {
                return false;
            }
            self.scans[0].next = 1;
        }
    }

    /// Scans the solved knots; false if one of them is singular.
    #[inline(always)]
    pub(in crate::branch) fn take_turn<R: Real, const G: usize>(
        &mut self,
        cx: &Context<'_>,
        knots: &UniformTracer<R, G>,
        classes: &[usize],
        settled: &[bool],
    ) -> bool {
        let grid = knots.grid();
        self.scans[0].take(cx, knots, classes, settled, (grid.from, grid.cell))
    }

    /// Finds the ends of gaps between the knots of a scan.
    #[inline(always)]
    pub(in crate::branch) fn find_ends<L: Level, const G: usize>(
        &mut self,
        cx: &Context<'_>,
        knots: &mut UniformTracer<L::Register, G>,
        classes: &[usize],
        level: usize,
    ) {
        self.ends[level].find::<L, G>(cx, knots, classes, &self.scans[level].view());
    }

    /// Scans the cell before the next knot of a scan more closely, one level down; false if one of the
    /// knots is singular. `flat`: whether the angles of flat dyads are needed beyond dead points.
    #[inline(always)]
    pub(in crate::branch) fn scan_closer<L: Level, const G: usize>(
        &mut self,
        cx: &Context<'_>,
        knots: &mut UniformTracer<L::Register, G>,
        classes: &[usize],
        settled: &[bool],
        (level, flat): (usize, bool),
    ) -> bool {
        let scan = &self.scans[level];
        let (from, width) = (scan.from + scan.cell * (scan.next - 1) as f64, scan.cell);
        knots.set_between((from, width));
        if flat && has(scan.dead_point, scan.next) {
            // Some of these knots are beyond the dead point.
            knots.solve_checked::<L>(cx);
        } else {
            knots.solve::<L>(cx, flat);
            if !classes.is_empty() {
                knots.check_uncertain::<L>(cx);
            }
        }
        self.scans[level + 1].take(cx, knots, classes, settled, (from, width / CELLS))
    }

    /// Traces the knots of the first scan, with closer scans where they are needed.
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
        self.into_first.clear();
        self.into_gap.clear();
        self.into_gap.resize(classes.len(), 0.0);
        self.is_tie = false;
        if !classes.is_empty() {
            self.push(0, 0, classes, branch);
        }
        let flat = !classes.is_empty();
        let (mut level, mut count) = (0, 0);
        loop {
            if classes.is_empty() {
                self.scans[level].skip_quiet_cells();
            } else {
                self.push_quiet_cells(level, classes, branch);
            }
            let knot = self.scans[level].next;
            if knot == self.scans[level].count {
                if level == 0 {
                    break;
                }
                level -= 1;
                self.scans[level].next += 1;
                continue;
            }
            let within = (self.scans[level].from, self.scans[level].cell);
            let ends = if self.ends_serve { self.ends[level].beside(within, knot) } else { None };
            if let Some(beside) = ends {
                for beside in beside {
                    self.next.clear();
                    let angles =
                        (0..classes.len()).map(|class| self.ends[level].angle(class, &beside));
                    self.next.extend(angles);
                    self.push_next((beside.at, beside.reached), classes, branch);
                }
            }
            let is_shut = self.ends_serve && self.ends[level].is_shut(knot);
            let looked = if ends.is_some() || is_shut {
                Some(false)
            } else {
                self.needs_closer_scan(level, knot, !classes.is_empty())
            };
            let Some(closer) = looked else {
                return false;
            };
            if closer && level + 1 < LEVELS {
                let taken = self.scan_closer::<L, G>(cx, knots, classes, settled, (level, flat));
                level += 1;
                count += 1;
                if !taken || count > MAX_SCANS {
                    return false;
                }
                if self.ends_serve {
                    self.find_ends::<L, G>(cx, knots, classes, level);
                }
                continue;
            }
            if !classes.is_empty() {
                self.push(level, knot, classes, branch);
            }
            self.scans[level].next += 1;
        }
        if !knots.grid().is_turn {
            return true;
        }
        for (index, &class) in classes.iter().enumerate().take(self.first.len()) {
            let [a, b] = [self.first[index], self.last[index]];
            branch.gain[class] = TAU * whole_turns(b - a);
            let slack = self.into_gap[index] + self.into_first[index];
            self.is_tie |= is_tie_over_period(b - a, slack + self.tie());
        }
        if !classes.is_empty() {
            branch.period = Some(TAU);
        }
        true
    }

    /// Distance from half a turn at which it is not clear which way an angle steps across a gap.
    fn tie(&self) -> f64 {
        if self.ends_serve { TIE_AT_ENDS } else { TIE }
    }

    /// Whether the cell before a knot needs a closer scan; `None` if none would be close enough.
    #[inline(always)]
    fn needs_closer_scan(&self, level: usize, knot: usize, angles: bool) -> Option<bool> {
        let scan = &self.scans[level];
        let last = level + 1 == LEVELS;
        if has(scan.uncertain, knot) {
            return (!last).then_some(true);
        }
        if has(scan.curved, knot) && !last {
            return Some(true);
        }
        if has(scan.dead_point, knot) {
            return Some(if angles {
                level < self.dead_point_levels || !scan.is_definite(knot)
            } else {
                !scan.stays_away(knot)
            });
        }
        if has(scan.may_hide_island, knot) && level < ISLAND_LEVELS {
            return Some(true);
        }
        if !(angles && has(scan.reached, knot) && has(scan.reached, knot - 1)) {
            return Some(false);
        }
        let fast = has(scan.fast, knot);
        if fast && last {
            return None;
        }
        Some(fast)
    }

    /// Adds the knots at the ends of the next cells in which nothing happens to the branch.
    #[inline(always)]
    fn push_quiet_cells(&mut self, level: usize, classes: &[usize], branch: &mut Branch) {
        let scan = &mut self.scans[level];
        let knots = scan.next..scan.end_of_quiet_cells(level < ISLAND_LEVELS);
        if knots.is_empty() || self.was_reached != has(scan.reached, scan.next - 1) {
            return;
        }
        scan.next = knots.end;
        branch.at.extend(knots.clone().map(|knot| scan.from + scan.cell * knot as f64));
        branch.reached.resize(branch.at.len(), self.was_reached);
        let (width, row) = (branch.gain.len(), branch.angles.len());
        branch.angles.resize(row + width * knots.len(), 0.0);
        for (index, &class) in classes.iter().enumerate() {
            let last = &mut self.last[index];
            let unwrapped = branch.angles[row + class..].iter_mut().step_by(width);
            for (unwrapped, &angle) in unwrapped.zip(&scan.angles[index][knots.clone()]) {
                if self.was_reached {
                    follow(last, angle);
                }
                *unwrapped = *last;
            }
            self.principal[index] = scan.angles[index][knots.end - 1];
        }
    }

    /// Adds a knot of a scan to the branch.
    #[inline(always)]
    fn push(&mut self, level: usize, knot: usize, classes: &[usize], branch: &mut Branch) {
        let scan = &self.scans[level];
        self.next.clear();
        self.next.extend(scan.angles.iter().map(|angles| angles[knot]));
        let at = scan.from + scan.cell * knot as f64;
        self.push_next((at, has(scan.reached, knot)), classes, branch);
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
                let beyond = turn_between(self.principal[index], next);
                self.is_tie |=
                    is_tie(last - self.last[index], self.into_gap[index] + beyond + self.tie());
                if !has_first {
                    self.into_first.push(beyond);
                }
            } else if reached && !has_first {
                self.into_first.push(0.0);
            }
            if reached && !has_first {
                self.first.push(if is_first { unwrap_to(next, last) } else { last });
            }
            if was_reached && !reached {
                self.into_gap[index] = turn_between(last, next);
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

/// Unwraps an angle to its next value, if that is defined.
#[inline(always)]
fn follow(last: &mut f64, next: f64) {
    if next.is_finite() {
        *last = unwrap_to(next, *last);
    }
}

/// The turn of an angle between two knots beside a dead point.
#[inline(always)]
fn turn_between(a: f64, b: f64) -> f64 {
    if a.is_finite() && b.is_finite() { (unwrap_to(b, a) - a).abs() } else { UNDEFINED }
}

impl<R: Real, const G: usize> UniformTracer<R, G> {
    /// Sets [`CLOSER_KNOTS`] evenly from `from` to `from + width`.
    #[inline(always)]
    fn set_between(&mut self, (from, width): (f64, f64)) {
        self.state.groups = CLOSER_KNOTS / R::LANES;
        for group in 0..self.state.groups.min(G) {
            self.set_group(group, |lane| from + (width / CELLS) * lane as f64);
        }
    }
}
