//! Survey of a design with gaps: shows that it is plain without recording its angles knot by knot.

use super::lane_tracer::LaneTracer;
use super::surveyed_angle::SurveyedAngle;
use super::uniform::UniformTracer;
use crate::math::angle::Reference;
use crate::state::kernel::Level;
use crate::state::state::Context;

/// Levels of scans of a survey. What these do not show is left to [`LaneTracer::trace`].
const SURVEY_LEVELS: usize = 3;
/// Most closer scans of a survey.
const MAX_CLOSER: u32 = 6;

impl LaneTracer {
    /// Scans the solved knots. Whether a design with gaps is plain: no sign may change, the ends of all
    /// gaps are confirmed, and no requested angle turns fast or far. Sets the reference of each class.
    /// `None` if one of the knots is singular.
    #[inline(always)]
    pub(crate) fn survey<L: Level, const G: usize>(
        &mut self,
        cx: &Context<'_>,
        knots: &mut UniformTracer<L::Register, G>,
        (classes, start): (&[usize], &[f64]),
        settled: &[bool],
        references: &mut [Reference],
    ) -> Option<bool> {
        if !self.take_turn(cx, knots, classes, settled) {
            return None;
        }
        self.find_ends::<L, G>(cx, knots, classes, 0);
        let mut angles = std::mem::take(&mut self.surveyed);
        angles.clear();
        let scan = self.scans[0].view();
        angles.extend((0..classes.len()).map(|i| SurveyedAngle::new(&scan, i, start[classes[i]])));
        let is_plain = self.survey_cells::<L, G>(cx, knots, classes, settled, &mut angles)
            && angles.iter().zip(classes).all(|(angle, &class)| {
                let reference = angle.reference();
                references[class] = reference.unwrap_or(references[class]);
                reference.is_some()
            });
        self.surveyed = angles;
        self.scans[0].next = 1;
        Some(is_plain)
    }

    /// Surveys all cells, with closer scans of those whose knots leave a doubt.
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
            let doubtful =
                scan.doubtful_cells() | scan.fast_cells() | scan.dead_point & !ends.cells();
            let doubtful = if scan.next < scan.count { doubtful >> scan.next } else { 0 };
            let knot = (scan.next + doubtful.trailing_zeros() as usize).min(scan.count);
            let view = scan.view();
            let passes = |(class, angle): (usize, &mut SurveyedAngle)| {
                angle.pass_ends(ends, &view, class, scan.next..knot)
                    && (knot < scan.count || angle.pass_knots(&view, class))
            };
            if !angles.iter_mut().enumerate().all(passes) {
                return false;
            }
            if knot < scan.count {
                if level + 1 == SURVEY_LEVELS || doubtful.count_ones() > MAX_CLOSER - count {
                    return false;
                }
                self.scans[level].next = knot;
                if !self.scan_closer::<L, G>(cx, knots, classes, settled, level) {
                    return false;
                }
                level += 1;
                count += 1;
                self.find_ends::<L, G>(cx, knots, classes, level);
            } else if level == 0 {
                return true;
            } else {
                level -= 1;
                self.scans[level].next += 1;
            }
        }
    }
}
