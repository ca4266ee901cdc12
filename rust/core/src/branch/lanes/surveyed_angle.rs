//! The result of a survey for one angle: the references to which all its values are unwrapped.

use std::f64::consts::{PI, TAU};
use std::ops;

use super::cell_test::has;
use super::gap_end::{GapEnd, ScanView};
use super::gap_ends::{AngleAtEnd, GapEnds, TIE};
use super::grid::KNOTS;
use super::uniform::reference_of;
use crate::math::angle::{Reference, is_tie, is_tie_over_period, unwrap_to, whole_turns};
use crate::math::tolerance::KNOT_MAX_TURN;

/// Greatest range (rad) of an angle in a cell that a single reference serves: between two positions surveyed
/// it leaves the range by less than a step.
const MAX_OF_CELL: f64 = TAU - 2.0 * KNOT_MAX_TURN;

/// The survey of an angle over the cells so far.
#[derive(Debug, Clone, Copy)]
pub(in crate::branch) struct SurveyedAngle {
    /// The drawing's, to which the first is unwrapped.
    start: f64,
    /// Its value at the last position; just outside the last end of a gap if the last position cannot be
    /// reached.
    last: f64,
    /// Its whole turns there, rad.
    turns: f64,
    /// Whether the last position can be reached.
    is_reached: bool,
    /// Its turn beside the last end of a gap.
    slack: f64,
    /// Its value and slack at the first position that can be reached.
    first: Option<[f64; 2]>,
    /// Whether a gap is open at the first knot.
    begins_open: bool,
    range: Range,
    /// In the cell of the first scan that is being passed.
    cell: Range,
    /// Whether a reference for each cell of the first scan serves all values.
    serves_cells: bool,
    /// The references of these cells.
    of_cells: [f64; KNOTS],
}

/// A range of values.
#[derive(Debug, Clone, Copy)]
struct Range {
    low: f64,
    high: f64,
}

impl Range {
    const EMPTY: Self = Self { low: f64::INFINITY, high: f64::NEG_INFINITY };

    #[inline(always)]
    fn extend(&mut self, value: f64) {
        (self.low, self.high) = (self.low.min(value), self.high.max(value));
    }
}

impl SurveyedAngle {
    pub(in crate::branch) fn new(scan: &ScanView<'_>, class: usize, start: f64) -> Self {
        let is_reached = has(scan.reached, 0);
        let first = if is_reached { unwrap_to(scan.angles[class][0], start) } else { start };
        let mut range = Range::EMPTY;
        if is_reached {
            range.extend(first);
        }
        Self {
            start,
            last: first,
            turns: 0.0,
            is_reached,
            slack: 0.0,
            first: is_reached.then_some([first, 0.0]),
            begins_open: !is_reached,
            range,
            cell: range,
            serves_cells: true,
            of_cells: [0.0; KNOTS],
        }
    }

    /// Follows the angle through some cells of a scan, the `first` or a closer one, in which it turns slowly
    /// and all ends of gaps are confirmed; false if it is not clear which way it turns over a gap.
    #[inline(always)]
    pub(in crate::branch) fn pass(
        &mut self,
        (ends, first): (&GapEnds, bool),
        scan: &ScanView<'_>,
        class: usize,
        cells: ops::Range<usize>,
    ) -> bool {
        let mut next = cells.start;
        for (end, angle) in ends.with_angles(scan, class) {
            if cells.contains(&end.knot) {
                let passes = self.pass_knots(scan, class, (next..end.knot, first))
                    && self.pass_end(end, angle);
                if !passes {
                    return false;
                }
                next = end.knot;
            }
        }
        self.pass_knots(scan, class, (next..cells.end, first))
    }

    /// Follows the angle through knots on one side of the ends of gaps; false if it is not defined at one
    /// of them.
    #[inline(always)]
    fn pass_knots(
        &mut self,
        scan: &ScanView<'_>,
        class: usize,
        (knots, first): (ops::Range<usize>, bool),
    ) -> bool {
        for knot in knots {
            if has(scan.reached, knot) != self.is_reached {
                return false;
            }
            if self.is_reached {
                self.follow(scan.angles[class][knot]);
            }
            if first {
                self.end_cell(knot);
            }
        }
        self.last.is_finite()
    }

    /// Sets the reference of the cell of the first scan before a knot.
    #[inline(always)]
    pub(in crate::branch) fn end_cell(&mut self, knot: usize) {
        let Range { low, high } = self.cell;
        // An empty cell has no position that can be reached.
        let reference = if low <= high { 0.5 * (low + high) } else { self.last };
        // By rounding, a coordinate at the end of the turn may be beyond the last cell.
        self.of_cells[knot - 1..=knot].fill(reference);
        self.serves_cells &= high - low <= MAX_OF_CELL;
        self.cell = Range::EMPTY;
        if self.is_reached {
            self.cell.extend(self.last);
        }
    }

    /// Follows the angle over the end of a gap; false if it may turn either way over the gap.
    #[inline(always)]
    fn pass_end(&mut self, end: &GapEnd, AngleAtEnd { inside, beyond, slack }: AngleAtEnd) -> bool {
        if self.is_reached != end.is_start {
            return false;
        }
        self.is_reached = !end.is_start;
        if end.is_start {
            self.follow(inside);
            self.last = unwrap_to(beyond, self.last);
            self.slack = slack;
            return true;
        }
        let step = unwrap_to(beyond, self.last) - self.last;
        self.last += step;
        self.first.get_or_insert([self.last, slack]);
        self.follow(inside);
        !is_tie(step, self.slack + slack + TIE)
    }

    /// Unwraps the next angle to the last, and extends the range over it.
    #[inline(always)]
    fn follow(&mut self, angle: f64) {
        let mut next = angle + self.turns;
        // NaN fails this comparison.
        let is_near = (next - self.last).abs() < PI;
        if !is_near {
            next = unwrap_to(angle, self.last);
            self.turns = next - angle;
        }
        self.last = next;
        self.range.extend(next);
        self.cell.extend(next);
    }

    /// Its gain in a turn; `None` if it is not clear which way it turns over the gap that is open at the first
    /// knot.
    pub(in crate::branch) fn gain(&self) -> Option<f64> {
        let Some([first, slack]) = self.first else { return Some(0.0) };
        let (change, slack) = (self.last - first, self.slack + slack + TIE);
        let is_clear = !(self.begins_open && is_tie_over_period(change, slack));
        is_clear.then_some(TAU * whole_turns(change))
    }

    /// A reference for all values; `None` if their range is too wide, or if the angle gains a turn.
    pub(in crate::branch) fn reference(&self) -> Option<Reference> {
        if self.first.is_none() {
            return Some(Reference::Near(self.start));
        }
        let Range { low, high } = self.range;
        reference_of([low, high]).filter(|_| self.gain() == Some(0.0))
    }

    /// References for the values in each cell of the first scan, at the knots before these; `None` if the
    /// range in one of them is too wide.
    pub(in crate::branch) fn references(&self) -> Option<&[f64; KNOTS]> {
        self.serves_cells.then_some(&self.of_cells)
    }
}
