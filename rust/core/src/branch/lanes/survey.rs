//! Survey of a design with gaps: shows that it is plain without unwrapping its angles knot by knot.

use super::cell_test::has;
use super::gap_end::ScanView;
use super::gap_ends::GapEnds;
use super::lane_tracer::LaneTracer;
use super::uniform::{UniformTracer, reference_of};
use crate::math::angle::{Reference, is_about_half, unwrap_to};
use crate::math::tolerance::KNOT_MAX_TURN;
use crate::state::kernel::Level;
use crate::state::state::Context;

/// The least and the greatest angle.
type AngleRange = [f64; 2];

impl LaneTracer {
    /// Whether a design with gaps is plain: no sign may change between the solved knots, the ends of all
    /// gaps are confirmed, and no requested angle turns fast or far. Sets the reference of each class.
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
        self.find_ends::<L, G>(cx, knots, classes, 0);
        if !self.has_found_all_ends() {
            return false;
        }
        let (ends, scan) = self.turn_ends();
        for (index, &class) in classes.iter().enumerate() {
            let range = ends.range(&scan, index, start[class]);
            let Some(reference) = range.and_then(reference_of) else { return false };
            references[class] = reference;
        }
        true
    }
}

impl GapEnds {
    /// The range of a class's angle over the reachable knots and the ends of gaps, if its link turns
    /// slowly and stays within half a turn of its first angle, which is unwrapped to `start`.
    fn range(&self, scan: &ScanView<'_>, class: usize, start: f64) -> Option<AngleRange> {
        let (near, range) = self.across(scan, class, start)?;
        over_knots(scan, class, near, range)
    }

    /// The first angle, and the range over the ends of gaps.
    #[inline(always)]
    fn across(&self, scan: &ScanView<'_>, class: usize, start: f64) -> Option<(f64, AngleRange)> {
        let (angles, rates) = (&scan.angles[class], &scan.rates[class]);
        // The angle just outside the last end passed. A gap may already be open at the first knot.
        let begins_open = !has(scan.reached, 0);
        let (mut outside, mut slack) = (start, 0.0);
        let mut near = if begins_open { None } else { Some(unwrap_to(angles[0], start)) };
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        let mut first_outside = None;
        for (end, beside) in self.with_angles(class) {
            let near = *near.get_or_insert_with(|| unwrap_to(beside[1], start));
            let [inside, beyond] = beside.map(|angle| unwrap_to(angle, near));
            let known = unwrap_to(angles[end.known()], near);
            let steps = [inside - known, beyond - known];
            let own = (beyond - inside).abs();
            let steps_far = !end.is_start && is_about_half(beyond - outside, slack + own);
            if steps_far || !end.is_followed(scan, steps, rates) {
                return None;
            }
            range = [range[0].min(inside), range[1].max(inside)];
            (outside, slack) = (beyond, own);
            first_outside.get_or_insert((beyond, own));
        }
        let wraps = |(first, own): (f64, f64)| is_about_half(outside - first, slack + own);
        let wraps_far = begins_open && first_outside.is_some_and(wraps);
        if wraps_far { None } else { near.map(|near| (near, range)) }
    }
}

/// Extends the range over the reachable knots.
#[inline(always)]
fn over_knots(
    scan: &ScanView<'_>,
    class: usize,
    near: f64,
    mut range: AngleRange,
) -> Option<AngleRange> {
    let (angles, rates) = (&scan.angles[class], &scan.rates[class]);
    let mut last = near;
    let mut is_slow = true;
    for knot in 0..scan.count {
        if has(scan.reached, knot) {
            let angle = unwrap_to(angles[knot], near);
            let followed = knot > 0 && has(scan.reached, knot - 1);
            is_slow &= !followed || (angle - last).abs() <= KNOT_MAX_TURN;
            let beside = followed || knot + 1 < scan.count && has(scan.reached, knot + 1);
            is_slow &= !beside || (rates[knot] * scan.cell).abs() <= KNOT_MAX_TURN;
            range = [range[0].min(angle), range[1].max(angle)];
            last = angle;
        }
    }
    is_slow.then_some(range)
}
