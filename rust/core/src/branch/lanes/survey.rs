//! Survey of a design with gaps: shows that the design does not need checks, without recording its angles
//! beside the gaps.

use std::f64::consts::TAU;

use super::grid::{CELL, KNOTS};
use super::lane_tracer::LaneTracer;
use super::surveyed_angle::SurveyedAngle;
use super::uniform::{Traced, UniformTracer};
use crate::branch::branch::Branch;
use crate::math::angle::Reference;
use crate::state::kernel::Level;
use crate::state::state::Context;

/// Levels of scans of a survey. Cells that these do not decide are left to [`LaneTracer::trace`].
const SURVEY_LEVELS: usize = 3;
/// Most closer scans of a survey.
const MAX_CLOSER: u32 = 6;

impl LaneTracer {
    /// Scans the solved knots. Returns whether a design with gaps needs no checks: signs cannot change,
    /// the ends of all gaps are confirmed, and requested angles turn slowly. Sets the reference of each
    /// class, or if one is not enough for an angle, those at the knots of `branch`. `None` if one of the
    /// knots is singular.
    #[inline(always)]
    pub(crate) fn survey<L: Level, const G: usize>(
        &mut self,
        cx: &Context<'_>,
        knots: &mut UniformTracer<L::Register, G>,
        (classes, start): (&[usize], &[f64]),
        settled: &[bool],
        references: &mut [Reference],
        branch: &mut Branch,
    ) -> Option<Traced> {
        if !self.take_turn(cx, knots, classes, settled) {
            return None;
        }
        self.find_ends::<L, G>(cx, knots, classes, 0);
        let mut angles = std::mem::take(&mut self.surveyed);
        angles.clear();
        let scan = self.scans[0].view();
        angles.extend((0..classes.len()).map(|i| SurveyedAngle::new(&scan, i, start[classes[i]])));
        let mut traced = Traced::No;
        if self.survey_cells::<L, G>(cx, knots, classes, settled, &mut angles) {
            branch.set_constant_signs(start.len(), cx.signs);
            let with_one = angles.iter().zip(classes).all(|(angle, &class)| {
                let reference = angle.reference();
                references[class] = reference.unwrap_or(references[class]);
                reference.is_some()
            });
            if with_one {
                traced = Traced::Surveyed;
            } else if self.set_references(&angles, classes, branch) {
                traced = Traced::AtKnots;
            }
        }
        self.surveyed = angles;
        Some(traced)
    }

    /// Sets the references at the knots of the first scan; false if they do not serve all values.
    #[inline(always)]
    fn set_references(
        &self,
        angles: &[SurveyedAngle],
        classes: &[usize],
        branch: &mut Branch,
    ) -> bool {
        let width = branch.gain.len();
        branch.angles.resize(KNOTS * width, 0.0);
        for (angle, &class) in angles.iter().zip(classes) {
            let (Some(references), Some(gain)) = (angle.references(), angle.gain()) else {
                return false;
            };
            for (row, &reference) in branch.angles.chunks_exact_mut(width).zip(references) {
                row[class] = reference;
            }
            branch.gain[class] = gain;
        }
        let scan = &self.scans[0];
        branch.at.extend((0..KNOTS).map(|knot| scan.from + scan.cell * knot as f64));
        branch.reached.resize(KNOTS, true);
        branch.period = Some(TAU);
        branch.inverse_width = Some(1.0 / CELL);
        true
    }

    /// Surveys all cells, with closer scans of those whose knots leave it uncertain.
    #[inline(always)]
    fn survey_cells<L: Level, const G: usize>(
        &mut self,
        cx: &Context<'_>,
        knots: &mut UniformTracer<L::Register, G>,
        classes: &[usize],
        settled: &[bool],
        angles: &mut [SurveyedAngle],
    ) -> bool {
        let (mut level, mut count) = (0, 0);
        loop {
            let (scan, ends) = (&self.scans[level], &self.ends[level]);
            let uncertain =
                scan.uncertain_cells() | scan.fast_cells() | scan.dead_point & !ends.cells();
            let uncertain = if scan.next < scan.count { uncertain >> scan.next } else { 0 };
            let knot = (scan.next + uncertain.trailing_zeros() as usize).min(scan.count);
            let view = scan.view();
            let passes = |(class, angle): (usize, &mut SurveyedAngle)| {
                angle.pass((ends, level == 0), &view, class, scan.next..knot)
            };
            if !angles.iter_mut().enumerate().all(passes) {
                return false;
            }
            if knot < scan.count {
                if level + 1 == SURVEY_LEVELS || uncertain.count_ones() > MAX_CLOSER - count {
                    return false;
                }
                self.scans[level].next = knot;
                if !self.scan_closer::<L, G>(cx, knots, classes, settled, (level, false)) {
                    return false;
                }
                level += 1;
                count += 1;
                self.find_ends::<L, G>(cx, knots, classes, level);
            } else if level == 0 {
                return true;
            } else {
                level -= 1;
                if level == 0 {
                    let knot = self.scans[0].next;
                    for angle in &mut *angles {
                        angle.end_cell(knot);
                    }
                }
                self.scans[level].next += 1;
            }
        }
    }
}
