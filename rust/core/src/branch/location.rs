//! Locations on a branch: the knot, period and signs of each parameter.

use std::f64::consts::TAU;

use super::branch::Branch;
use crate::math::angle::{reduce_turns, whole_part};
use crate::math::lanes::{LANES, Real};

/// Locations on a branch, one per lane.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct BranchLocation<R = f64> {
    /// The parameter reduced to the first period.
    pub(crate) reduced: R,
    /// Whole periods taken off.
    periods: R,
    /// The knot whose angles and cells are used.
    pub(crate) knot: [usize; LANES],
    /// The knots of the first and last lane, if every lane has one or the other.
    pub(crate) pair: Option<[usize; 2]>,
    /// 1 in lanes with the second knot of `pair`, else 0.
    pub(crate) is_last: R,
}

impl Branch {
    /// Reduces a parameter to the first period; also returns the whole periods taken off.
    #[inline(always)]
    pub(crate) fn reduce<R: Real>(&self, at: R) -> (R, R) {
        let (Some(&first), Some(period)) = (self.at.first(), self.period) else {
            return (at, R::ZERO);
        };
        let periods = ((at - R::splat(first)) * R::splat(1.0 / period)).floor();
        if self.inverse_width.is_some() {
            // On the uniform branch only the number of turns must be exact.
            return (at - periods * R::splat(period), periods);
        }
        let turns = (period / TAU).round();
        (R::from_lanes(|lane| reduce_turns(at.lane(lane), periods.lane(lane) * turns)), periods)
    }

    /// Locates parameters among the knots; without knots, only reduces them.
    #[inline(always)]
    pub(crate) fn locate<R: Real>(&self, at: R) -> BranchLocation<R> {
        let (reduced, periods) = self.reduce(at);
        let mut knot = [0; LANES];
        let last = self.at.len().saturating_sub(1);
        if self.at.is_empty() {
            return BranchLocation { reduced, periods, knot, ..BranchLocation::default() };
        }
        if let Some(inverse_width) = self.inverse_width {
            let cells = (reduced - R::splat(self.at[0])) * R::splat(inverse_width);
            for lane in 0..R::LANES {
                // At the edge of a cell either knot will do.
                let cell = whole_part(cells.lane(lane));
                knot[lane] = cell.min(last);
            }
        } else {
            for lane in 0..R::LANES {
                knot[lane] = self.knot_before(reduced.lane(lane)).min(last);
            }
        }
        if self.cells.is_empty() {
            return BranchLocation { reduced, periods, knot, ..BranchLocation::default() };
        }
        let pair = [knot[0], knot[R::LANES - 1]];
        let is_pair = knot[..R::LANES].iter().all(|knot| pair.contains(knot));
        let is_last = R::from_lanes(|lane| if knot[lane] == pair[1] { 1.0 } else { 0.0 });
        BranchLocation { reduced, periods, knot, pair: is_pair.then_some(pair), is_last }
    }

    /// The last knot at or before a parameter; the next knot if only that one can be reached.
    fn knot_before(&self, reduced: f64) -> usize {
        let after = self.at.partition_point(|&k| k <= reduced);
        let left = after.saturating_sub(1);
        let ahead = self.reached.get(after).copied().unwrap_or(false);
        if ahead && !self.reached[left] { after } else { left }
    }

    /// The assembly signs at a location.
    #[inline(always)]
    pub(crate) fn signs_at<R: Real>(&self, location: &BranchLocation<R>, lane: usize) -> &[f64] {
        let after = match self.sign_intervals.len() {
            1 => 1,
            _ => self.sign_intervals.partition_point(|s| s.from <= location.reduced.lane(lane)),
        };
        self.sign_intervals.get(after.saturating_sub(1)).map_or(&[], |s| &s.signs)
    }

    /// The assembly signs at a parameter.
    pub(crate) fn signs(&self, at: f64) -> &[f64] {
        self.signs_at(&self.locate(at), 0)
    }

    /// Whether a location lies on an island without a knot.
    #[inline(always)]
    pub(crate) fn in_untraced_island<R: Real>(
        &self,
        location: &BranchLocation<R>,
        lane: usize,
    ) -> bool {
        // The knot can be reached if any knot before or after the location can.
        let at = location.reduced.lane(lane);
        let inside = self.at.first().is_some_and(|&first| first <= at)
            && self.at.last().is_some_and(|&last| at < last);
        self.inverse_width.is_none() && inside && !self.reached[location.knot[lane]]
    }

    /// The angle of a class at the knots of a location.
    #[inline(always)]
    pub(crate) fn reference_angle<R: Real>(&self, location: &BranchLocation<R>, class: usize) -> R {
        let classes = self.gain.len();
        if self.at.is_empty() {
            return R::ZERO;
        }
        let angle = R::from_lanes(|lane| self.angles[location.knot[lane] * classes + class]);
        angle + location.periods * R::splat(self.gain[class])
    }
}
