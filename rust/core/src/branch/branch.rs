//! The branch from the drawing: signs that change at change points, angles followed continuously.
//!
//! At a change point a dyad with two solutions is flat and both solutions meet. The smooth motion
//! goes from one to the other, so the dyad's sign changes there. An angle is known up to whole
//! turns. Signs and turns are found by tracing q from the drawing over knots that depend on the
//! design alone: equal cells, halved where a link turns fast. So the result does not depend on the
//! positions requested.

use std::f64::consts::TAU;

use super::hermite::HermiteCell;
use super::knot::{ChangePoint, InitialGuess, Knot, SignInterval};
use super::tracer::BranchTracer;
use crate::plan::plan::Plan;
use crate::state::state::{Context, State};

/// Cells per turn of a driven angle: the knots fill the lanes of four groups, and an odd number of
/// cells keeps knots off the point half a turn from the drawing.
pub(crate) const CELLS_PER_TURN: u32 = 31;
/// Cells per unit (of the scale, or rad) along a driven slide or a segment.
pub(super) const CELLS_PER_UNIT: f64 = 16.0;
/// Factor by which cells far away are farther from the drawing than the ones before.
const GROWTH: f64 = 1.25;
/// Steps per cell with which the length of an island between two knots is measured.
const ISLAND_STEPS: f64 = 1024.0;
/// Most cells of a segment; callers limit their coordinates to fit.
const MAX_CELLS: f64 = 1.0e6;
/// Turns after which the signs must be those of the drawing again; a kite needs two.
pub(crate) const MAX_TURNS: u32 = 64;

/// Angles and signs along one path.
#[derive(Debug, Clone, Default)]
pub(crate) struct Branch {
    /// Parameters of the knots.
    pub(crate) at: Vec<f64>,
    /// Whether each knot can be reached.
    pub(crate) reached: Vec<bool>,
    /// Unwrapped angle of every class at every knot (at an unreached knot, that of the last reached
    /// one).
    pub(crate) angles: Vec<f64>,
    pub(crate) sign_intervals: Vec<SignInterval>,
    pub(crate) changes: Vec<ChangePoint>,
    /// Change of every class angle over a period.
    pub(crate) gain: Vec<f64>,
    pub(crate) period: Option<f64>,
    /// Interval in which the branch is known; `None`: everywhere.
    pub(crate) covered: Option<[f64; 2]>,
    /// Polynomials of the groups' unknowns, for the cell after each knot.
    pub(crate) cells: Vec<HermiteCell>,
    /// Whether each group's determinant is positive on the branch.
    pub(crate) det_signs: Vec<bool>,
    /// Knots per unit of the parameter, if all are reached and equally spaced.
    pub(crate) inverse_width: Option<f64>,
}

impl Branch {
    /// A branch without a single position: the dimensions cannot be followed from the drawing's, or
    /// the branch ends where it begins.
    ///
    /// It still has the signs of the drawing, because lanes are filled with signs before their
    /// coordinates are checked.
    pub(crate) fn empty(classes: usize, signs: &[f64]) -> Self {
        let covered = Some([f64::INFINITY, f64::NEG_INFINITY]);
        let sign_intervals = vec![SignInterval { from: f64::NEG_INFINITY, signs: signs.to_vec() }];
        Self { gain: vec![0.0; classes], sign_intervals, covered, ..Self::default() }
    }

    /// Makes this a branch without knots: the same signs everywhere, and no angles.
    pub(crate) fn set_constant_signs(&mut self, classes: usize, signs: &[f64]) {
        self.at.clear();
        self.reached.clear();
        self.angles.clear();
        self.changes.clear();
        self.cells.clear();
        self.gain.clear();
        self.gain.resize(classes, 0.0);
        self.sign_intervals.resize_with(1, SignInterval::default);
        self.sign_intervals[0].from = f64::NEG_INFINITY;
        self.sign_intervals[0].signs.clear();
        self.sign_intervals[0].signs.extend_from_slice(signs);
        self.period = None;
        self.covered = None;
        self.inverse_width = None;
    }

    /// Prepends the knots of a branch that was traced downward from where this one begins.
    pub(super) fn extend_down(&mut self, below: Self) {
        let Self { mut at, mut reached, mut angles, .. } = below;
        if at.is_empty() {
            return;
        }
        let shared = usize::from(!self.at.is_empty());
        at.reverse();
        reached.reverse();
        at.truncate(at.len() - shared);
        reached.truncate(reached.len() - shared);
        let classes = self.gain.len();
        angles.reverse();
        angles.chunks_exact_mut(classes).for_each(<[f64]>::reverse);
        angles.truncate(at.len() * classes);
        at.append(&mut self.at);
        reached.append(&mut self.reached);
        angles.append(&mut self.angles);
        (self.at, self.reached, self.angles) = (at, reached, angles);
    }

    /// Whether the knots that can be reached come first, and include the very first.
    pub(super) fn ends_once(&self) -> bool {
        self.at.is_empty() || self.reached[0] && self.reached.is_sorted_by(|a, b| a >= b)
    }

    /// Whether the branch is known everywhere and has no change points.
    pub(crate) fn is_whole(&self) -> bool {
        self.covered.is_none() && self.changes.is_empty()
    }

    /// Traces one driven angle from `q0` upward. A periodic motion covers all q; if a group folds, it
    /// is traced downward too.
    pub(crate) fn over_turns(
        cx: &Context<'_>,
        state: &mut State,
        q0: f64,
        start: &InitialGuess<'_>,
    ) -> Self {
        let point = |at: f64, q: &mut [f64]| q[0] = at;
        let mut tracer = BranchTracer::new(cx, state, &point, &[1.0], (q0, 1.0), start);
        if tracer.ended {
            return Self::empty(start.angles.len(), cx.signs);
        }
        let mut turns = 0;
        let mut returned = false;
        while turns < MAX_TURNS && !returned {
            for cell in 1..=CELLS_PER_TURN {
                let turned = f64::from(turns) + f64::from(cell) / f64::from(CELLS_PER_TURN);
                tracer.advance(q0 + TAU * turned);
            }
            if tracer.ended {
                break;
            }
            turns += 1;
            returned = tracer.has_returned();
        }
        let sign_intervals = tracer.sign_intervals();
        let gain = tracer.gain();
        let BranchTracer { knots, changes, ended, .. } = tracer;
        if ended {
            // A group folds ahead: trace backward as well.
            let cells = [f64::from(MAX_TURNS * CELLS_PER_TURN); 2];
            let end = |cell: f64| cell * (TAU / f64::from(CELLS_PER_TURN));
            let branch = Self::bidirectional(cx, state, q0, cells, end, start);
            let ends = [branch.at.first(), branch.at.last()].map(|end| end.copied().unwrap_or(q0));
            return Self { covered: Some(ends), ..branch };
        }
        let period = returned.then_some(TAU * f64::from(turns));
        let end = if returned { f64::INFINITY } else { q0 + TAU * f64::from(turns) };
        let covered = [if returned { f64::NEG_INFINITY } else { q0 }, end];
        Self {
            sign_intervals,
            changes,
            gain,
            period,
            covered: Some(covered),
            ..Self::from_knots(&knots, cx.plan)
        }
    }

    /// Traces one driven slide from `q0` down to `low` and up to `high`. Beyond `reach` cells grow; without
    /// groups, which need no knots, it ends there.
    pub(crate) fn over_range(
        cx: &Context<'_>,
        state: &mut State,
        q0: f64,
        [low, high]: [f64; 2],
        reach: f64,
        start: &InitialGuess<'_>,
    ) -> Self {
        let even = (reach * CELLS_PER_UNIT).ceil();
        let goes_on = cx.plan.groups().next().is_some();
        // What is so far away changes little over a length of a link.
        let end =
            |cell: f64| cell.min(even) / CELLS_PER_UNIT * libm::pow(GROWTH, (cell - even).max(0.0));
        let cells = [q0 - low, high - q0].map(|length| {
            let mut cells = (length.min(reach) * CELLS_PER_UNIT).ceil();
            while goes_on && end(cells) < length {
                cells += 1.0;
            }
            cells
        });
        Self::bidirectional(cx, state, q0, cells, end, start)
    }

    /// Traces from `q0` down and up by a number of cells, which end so far from `q0`, or to the end of the
    /// branch.
    fn bidirectional(
        cx: &Context<'_>,
        state: &mut State,
        q0: f64,
        cells: [f64; 2],
        end: impl Fn(f64) -> f64,
        start: &InitialGuess<'_>,
    ) -> Self {
        let point = |at: f64, q: &mut [f64]| q[0] = at;
        let mut all: Vec<Knot> = Vec::new();
        let mut branch = Self { gain: vec![0.0; start.angles.len()], ..Self::default() };
        let mut covered = [f64::NEG_INFINITY, f64::INFINITY];
        for (cells, direction) in cells.into_iter().zip([-1.0, 1.0]) {
            let mut tracer = BranchTracer::new(cx, state, &point, &[1.0], (q0, direction), start);
            if tracer.ended {
                return Self::empty(start.angles.len(), cx.signs);
            }
            let mut cell = 0.0;
            while cell < cells && !tracer.ended {
                cell += 1.0;
                tracer.advance(q0 + direction * end(cell));
            }
            let mut sign_intervals = tracer.sign_intervals();
            let BranchTracer { mut knots, mut changes, ended, .. } = tracer;
            if ended && let Some(last) = knots.last() {
                covered[usize::from(direction > 0.0)] = last.at;
            }
            if direction < 0.0 {
                knots.reverse();
                knots.pop();
                changes.reverse();
                // Downward, an interval begins at the next change.
                for i in 0..sign_intervals.len() {
                    sign_intervals[i].from =
                        sign_intervals.get(i + 1).map_or(f64::NEG_INFINITY, |s| s.from);
                }
                sign_intervals.reverse();
                // The last one, around q0, is also the first one upward.
                if let (Some(around), true) =
                    (sign_intervals.pop(), branch.sign_intervals.is_empty())
                {
                    branch.sign_intervals = sign_intervals;
                    branch.sign_intervals.push(around);
                }
            } else {
                branch.sign_intervals.extend(sign_intervals.into_iter().skip(1));
            }
            all.append(&mut knots);
            branch.changes.append(&mut changes);
        }
        Self {
            changes: branch.changes,
            sign_intervals: branch.sign_intervals,
            gain: branch.gain,
            covered: Some(covered),
            ..Self::from_knots(&all, cx.plan)
        }
    }

    /// Traces straight from the drawing to one point of several coordinates; also returns the
    /// parameter there.
    ///
    /// The cells have one width on every segment. So two points on one ray from the drawing share
    /// their first knots, and both see or miss the same islands.
    pub(crate) fn along_segment(
        cx: &Context<'_>,
        state: &mut State,
        q0: &[f64],
        q1: &[f64],
        start: &InitialGuess<'_>,
    ) -> (Self, f64) {
        let differences = || q0.iter().zip(q1).map(|(a, b)| b - a);
        let end = differences().fold(0.0_f64, |max, change| max.max(change.abs()));
        let rates: Vec<f64> =
            differences().map(|change| if end > 0.0 { change / end } else { 0.0 }).collect();
        let point = |at: f64, q: &mut [f64]| {
            for ((x, &a), &rate) in q.iter_mut().zip(q0).zip(&rates) {
                *x = a + at * rate;
            }
        };
        let width = (end / MAX_CELLS).max(1.0 / CELLS_PER_UNIT);
        let mut tracer = BranchTracer::new(cx, state, &point, &rates, (0.0, 1.0), start);
        if tracer.ended {
            return (Self::empty(start.angles.len(), cx.signs), end);
        }
        let (mut cell, mut at) = (0.0, 0.0);
        while at < end {
            cell += 1.0;
            at = f64::min(cell * width, end);
            tracer.advance(at);
            // Only the end is needed.
            tracer.knots.drain(..tracer.knots.len() - 1);
        }
        let sign_intervals = tracer.sign_intervals();
        let BranchTracer { knots, changes, ended, .. } = tracer;
        let gain = vec![0.0; start.angles.len()];
        let covered = ended.then_some([0.0, 0.0]);
        (Self { sign_intervals, changes, gain, covered, ..Self::from_knots(&knots, cx.plan) }, end)
    }

    /// A branch from the tracer's knots, without signs and change points.
    fn from_knots(knots: &[Knot], plan: &Plan) -> Self {
        let mut cells = Vec::new();
        for (i, a) in knots.iter().enumerate() {
            let b = knots.get(i + 1);
            let width = b.map_or(0.0, |b| b.at - a.at);
            let unknowns = plan.groups().flat_map(|group| &group.unknowns);
            for (index, (&unknown, start)) in unknowns.zip(&a.taylor).enumerate() {
                let end = b.and_then(|b| b.taylor.get(index));
                cells.push(HermiteCell::between(unknown, start, end, width));
            }
        }
        Self {
            at: knots.iter().map(|k| k.at).collect(),
            reached: knots.iter().map(|k| k.reached).collect(),
            angles: knots.iter().flat_map(|k| k.angles.iter().copied()).collect(),
            det_signs: knots.first().map(|knot| knot.det_signs.clone()).unwrap_or_default(),
            cells,
            ..Self::default()
        }
    }

    /// Whether the branch is known at a parameter.
    #[inline(always)]
    pub(crate) fn covers(&self, at: f64) -> bool {
        self.covered.is_none_or(|[low, high]| (low..=high).contains(&at))
    }

    /// Whether the signs are the same everywhere.
    #[inline(always)]
    pub(crate) fn has_constant_signs(&self) -> bool {
        self.sign_intervals.len() == 1
    }

    /// The change point (of the first period) within `reach` of a parameter, if any, and
    /// the distance from it.
    pub(crate) fn change_near(&self, at: f64, reach: f64) -> Option<(ChangePoint, f64)> {
        if self.changes.is_empty() {
            return None;
        }
        let (reduced, _) = self.reduce(at);
        let period = self.period.unwrap_or(0.0);
        let images = |c: &ChangePoint| [0.0, -period, period].map(|by| (*c, reduced - (c.at + by)));
        self.changes.iter().flat_map(images).find(|(_, distance)| distance.abs() <= reach)
    }

    /// Traces an island without a knot from its middle to the parameter: at its ends a joint may be at
    /// infinity, where angles are only rounding.
    pub(crate) fn trace_island(&self, cx: &Context<'_>, state: &mut State, at: f64) -> Self {
        let (reduced, periods) = self.reduce(at);
        let after = self.at.partition_point(|&k| k <= reduced);
        let Some(left) = after.checked_sub(1).filter(|_| after < self.at.len()) else {
            return Self::default();
        };
        let angles = &self.angles[left * self.gain.len()..][..self.gain.len()];
        let taylor = self.unknowns_at(left, reduced);
        let start = InitialGuess { angles, taylor: &taylor };
        let (left, right) = (self.at[left], self.at[after]);
        let cx = Context { signs: self.signs(at), ..*cx };
        let point = |at: f64, q: &mut [f64]| q[0] = at;
        let mut tracer = BranchTracer::new(&cx, state, &point, &[1.0], (reduced, 1.0), &start);
        let step = (right - left) / ISLAND_STEPS;
        let mut end = |direction: f64, limit: f64| {
            let (mut inside, mut outside) = (reduced, limit);
            while (limit - inside) * direction > step {
                if !tracer.visit(inside + direction * step) {
                    outside = inside + direction * step;
                    break;
                }
                inside += direction * step;
            }
            tracer.find_edge([inside, outside])
        };
        let middle = 0.5 * (end(-1.0, left) + end(1.0, right));
        let direction = if reduced < middle { -1.0 } else { 1.0 };
        let mut tracer = BranchTracer::new(&cx, state, &point, &[1.0], (middle, direction), &start);
        tracer.advance(reduced);
        let BranchTracer { mut knots, .. } = tracer;
        if direction < 0.0 {
            knots.reverse();
        }
        for knot in &mut knots {
            knot.at += at - reduced;
            for (angle, gain) in knot.angles.iter_mut().zip(&self.gain) {
                *angle += periods * gain;
            }
        }
        Self { gain: self.gain.clone(), ..Self::from_knots(&knots, cx.plan) }
    }
}
