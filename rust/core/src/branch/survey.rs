//! Designs with gaps that are plain, seen without following their angles knot by knot.

use super::cell_test::has;
use super::gap_end::Shown;
use super::gap_ends::GapEnds;
use super::lane_tracer::LaneTracer;
use super::uniform::{UniformTracer, reference_of};
use crate::math::angle::{Reference, unwrap_to};
use crate::math::tolerance::{GAP_MAX_TURN, KNOT_MAX_TURN};
use crate::state::kernel::Level;
use crate::state::state::Context;

/// The least and the greatest angle.
type Range = [f64; 2];

impl LaneTracer {
    /// Whether a design with gaps is plain: no sign may change between two of the knots that have been
    /// solved, all gaps end where they should, and no angle asked for turns fast or far. Sets the
    /// reference of each class.
    #[inline(always)]
    pub(crate) fn survey<L: Level, const G: usize>(
        &mut self,
        cx: &Context<'_>,
        knots: &mut UniformTracer<L::Register, G>,
        (classes, start): (&[usize], &[f64]),
        settled: &[bool],
        references: &mut [Reference],
    ) -> bool {
        if !self.take_turn(cx, knots, classes, settled) || self.has_uncertain_cells() {
            return false;
        }
        self.find_ends::<L, G>(cx, knots, classes);
        if !self.has_found_all_ends() {
            return false;
        }
        for (index, &class) in classes.iter().enumerate() {
            let range = self.ends.range(&self.turn(), index, start[class]);
            let Some(reference) = range.and_then(reference_of) else { return false };
            references[class] = reference;
        }
        true
    }
}

impl GapEnds {
    /// The range of the angle of a class over the knots that can be reached and the ends of gaps, if
    /// its link turns slowly and stays within half a turn of where it is first; that is the nearest to
    /// `start`.
    fn range(&self, shown: &Shown<'_>, class: usize, start: f64) -> Option<Range> {
        let (near, range) = self.across(shown, class, start)?;
        over_knots(shown, class, near, range)
    }

    /// Where the angle is first, and its range over the ends of gaps.
    #[inline(always)]
    fn across(&self, shown: &Shown<'_>, class: usize, start: f64) -> Option<(f64, Range)> {
        let (angles, rates) = (&shown.angles[class], &shown.rates[class]);
        // Angles where the mechanism no longer closes, in order; the first gap may begin before the
        // first knot.
        let begins_open = !has(shown.reached, 0);
        let mut outside = start;
        let mut near = if begins_open { None } else { Some(unwrap_to(angles[0], start)) };
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        let mut first_outside = None;
        for (end, beside) in self.with_angles(class) {
            let near = *near.get_or_insert_with(|| unwrap_to(beside[1], start));
            let [inside, beyond] = beside.map(|angle| unwrap_to(angle, near));
            let known = unwrap_to(angles[end.known()], near);
            let steps = [inside - known, beyond - known];
            let steps_far = !end.is_start && (beyond - outside).abs() > GAP_MAX_TURN;
            if steps_far || !end.is_followed(shown, steps, rates) {
                return None;
            }
            range = [range[0].min(inside), range[1].max(inside)];
            outside = beyond;
            first_outside.get_or_insert(beyond);
        }
        let wraps_far = begins_open
            && first_outside.is_some_and(|first| (outside - first).abs() > GAP_MAX_TURN);
        if wraps_far { None } else { near.map(|near| (near, range)) }
    }
}

/// The same with the knots that can be reached.
#[inline(always)]
fn over_knots(shown: &Shown<'_>, class: usize, near: f64, mut range: Range) -> Option<Range> {
    let (angles, rates) = (&shown.angles[class], &shown.rates[class]);
    let mut last = near;
    let mut is_slow = true;
    for knot in 0..shown.count {
        if has(shown.reached, knot) {
            let angle = unwrap_to(angles[knot], near);
            let followed = knot > 0 && has(shown.reached, knot - 1);
            is_slow &= !followed || (angle - last).abs() <= KNOT_MAX_TURN;
            let beside = followed || knot + 1 < shown.count && has(shown.reached, knot + 1);
            is_slow &= !beside || (rates[knot] * shown.cell).abs() <= KNOT_MAX_TURN;
            range = [range[0].min(angle), range[1].max(angle)];
            last = angle;
        }
    }
    is_slow.then_some(range)
}
