//! What a survey shows about one angle: its range, and whether it can be unwrapped without recording it
//! knot by knot.

use std::ops::Range;

use super::cell_test::has;
use super::gap_end::ScanView;
use super::gap_ends::GapEnds;
use super::uniform::reference_of;
use crate::math::angle::{Reference, is_about_half, unwrap_to};

/// What the cells surveyed so far show about an angle.
#[derive(Debug, Clone, Copy)]
pub(in crate::branch) struct SurveyedAngle {
    /// Its first value, to which the others are unwrapped; known once a position can be reached.
    near: Option<f64>,
    /// Its value just outside the last end of a gap, or in the drawing before the first one.
    outside: f64,
    /// How far it turned beside that end.
    slack: f64,
    /// Both at the first end, if a gap is open at the first knot.
    first_outside: Option<[f64; 2]>,
    begins_open: bool,
    least: f64,
    most: f64,
}

impl SurveyedAngle {
    pub(in crate::branch) fn new(scan: &ScanView<'_>, class: usize, start: f64) -> Self {
        let begins_open = !has(scan.reached, 0);
        Self {
            near: (!begins_open).then(|| unwrap_to(scan.angles[class][0], start)),
            outside: start,
            slack: 0.0,
            first_outside: None,
            begins_open,
            least: f64::INFINITY,
            most: f64::NEG_INFINITY,
        }
    }

    /// Extends the range over the ends of gaps in some cells; false if the angle turns too fast or far
    /// beside or between them.
    #[inline(always)]
    pub(in crate::branch) fn pass_ends(
        &mut self,
        ends: &GapEnds,
        scan: &ScanView<'_>,
        class: usize,
        cells: Range<usize>,
    ) -> bool {
        for (end, beside) in ends.with_angles(class) {
            if !cells.contains(&end.knot) {
                continue;
            }
            let near = *self.near.get_or_insert_with(|| unwrap_to(beside[1], self.outside));
            let [inside, beyond] = beside.map(|angle| unwrap_to(angle, near));
            let known = unwrap_to(scan.angles[class][end.known()], near);
            let steps = [inside - known, beyond - known];
            let own = (beyond - inside).abs();
            let steps_far = !end.is_start && is_about_half(beyond - self.outside, self.slack + own);
            if steps_far || !end.is_followed(scan, steps, &scan.rates[class]) {
                return false;
            }
            (self.least, self.most) = (self.least.min(inside), self.most.max(inside));
            (self.outside, self.slack) = (beyond, own);
            self.first_outside.get_or_insert([beyond, own]);
        }
        true
    }

    /// Extends the range over the knots of a scan; false if it is not defined at one of them.
    #[inline(always)]
    pub(in crate::branch) fn pass_knots(&mut self, scan: &ScanView<'_>, class: usize) -> bool {
        let Some(near) = self.near else { return scan.reached == 0 };
        let mut is_defined = true;
        for knot in 0..scan.count {
            if has(scan.reached, knot) {
                let angle = unwrap_to(scan.angles[class][knot], near);
                is_defined &= angle.is_finite();
                (self.least, self.most) = (self.least.min(angle), self.most.max(angle));
            }
        }
        is_defined
    }

    /// A reference for all values; `None` if their range is too wide, if it is not clear which way the
    /// angle turns over the gap that is open at the first knot, or if no position can be reached.
    pub(in crate::branch) fn reference(&self) -> Option<Reference> {
        let wraps = |[first, own]: [f64; 2]| is_about_half(self.outside - first, self.slack + own);
        let wraps_far = self.begins_open && self.first_outside.is_some_and(wraps);
        if wraps_far || self.near.is_none() {
            return None;
        }
        reference_of([self.least, self.most])
    }
}
