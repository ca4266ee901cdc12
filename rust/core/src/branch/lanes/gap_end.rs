//! The end of a gap between two knots, predicted from samples at both.

use super::cell_test::{Bits, DyadSamples, has};
use super::grid::KNOTS;
use crate::math::angle::unwrap_to;
use crate::math::tolerance::KNOT_MAX_TURN;

/// Most ends searched for together; a turn rarely has more.
pub(super) const MAX_ENDS: usize = 8;
/// A position on either side of each.
pub(super) const POSITIONS: usize = 2 * MAX_ENDS;
/// Half-width of the interval that confines an end, in cells: the turn left in it is a sixteenth of
/// that over the cell.
const STRETCH: f64 = 1.0 / 256.0;
/// Greatest relative difference between the slope of a square at an end and that of the polynomial
/// between the knots. A greater one shows that the polynomial misses something.
const MAX_APART: f64 = 0.25;
/// The square of a later dyad must stay away from zero by this fraction of its change.
const MARGIN: f64 = 0.25;
/// Steps of Newton's method on the polynomial between two knots.
const STEPS: usize = 4;

/// The data of a scan on the ends of gaps.
#[derive(Clone, Copy)]
pub(in crate::branch) struct ScanView<'l> {
    /// The first knot, and the width of a cell.
    pub from: f64,
    pub cell: f64,
    /// Cells with a dead point and no other uncertainty.
    pub cells: Bits,
    /// Knots that can be reached.
    pub reached: Bits,
    pub dyads: &'l [DyadSamples],
    /// Angles and rates of the requested classes.
    pub angles: &'l [[f64; KNOTS]],
    pub rates: &'l [[f64; KNOTS]],
}

/// The end of a gap between two knots.
#[derive(Debug, Clone, Copy)]
pub(in crate::branch) struct GapEnd {
    /// The knot after it.
    pub knot: usize,
    /// The dyad that is flat there.
    dyad: usize,
    /// Whether the gap starts here: the dyad closes before the end, not after it.
    pub is_start: bool,
    /// Whether it lies in the gap of a later dyad, so that nothing can be reached on either side.
    pub is_shut: bool,
    /// Its position as a fraction of the cell, and the derivative of the square by that fraction.
    root: f64,
    slope: f64,
    pub is_confirmed: bool,
}

impl GapEnd {
    /// Predicts the end in the cell before a knot.
    #[inline(always)]
    pub(in crate::branch) fn predict(scan: &ScanView<'_>, knot: usize) -> Option<Self> {
        let dyad = scan.dyads.iter().position(|dyad| dyad.has_dead_point(knot))?;
        let is_start = has(scan.dyads[dyad].closes, knot - 1);
        let [[from, fall], [to, rise]] = [knot - 1, knot].map(|at| scan.dyads[dyad].at(at));
        let [fall, rise] = [fall * scan.cell, rise * scan.cell];
        // Hermite's polynomial: from + t (fall + t (b + t c)).
        let c = fall + rise - 2.0 * (to - from);
        let b = (to - from) - fall - c;
        let slope = |root: f64| fall + root * (2.0 * b + root * (3.0 * c));
        let mut root = from / (from - to);
        for _ in 0..STEPS {
            root -= (from + root * (fall + root * (b + root * c))) / slope(root);
        }
        let slope = slope(root);
        let mut end =
            Self { knot, dyad, is_start, is_shut: false, root, slope, is_confirmed: false };
        end.is_shut = !has(scan.reached, end.known());
        (0.0 < root && root < 1.0).then_some(end)
    }

    /// Whether it is confirmed, and positions on one side of it can be reached.
    pub(in crate::branch) fn is_open(&self) -> bool {
        self.is_confirmed && !self.is_shut
    }

    /// Positions before and after it, as fractions of the cell.
    fn parts(&self) -> [f64; 2] {
        let root = self.root;
        [(root - STRETCH).max(0.5 * root), (root + STRETCH).min(0.5 * (1.0 + root))]
    }

    /// The same as coordinates; the first cell begins at `from`.
    pub(in crate::branch) fn beside(&self, (from, cell): (f64, f64)) -> [f64; 2] {
        let start = from + cell * (self.knot - 1) as f64;
        self.parts().map(|part| start + cell * part)
    }

    /// The lanes of the position inside the reachable range and of the one beyond it, if these two
    /// positions begin at lane `first`.
    pub(in crate::branch) fn lanes(&self, first: usize) -> [usize; 2] {
        if self.is_start { [first, first + 1] } else { [first + 1, first] }
    }

    /// The neighbouring knot at which the dyad closes.
    pub(in crate::branch) fn known(&self) -> usize {
        if self.is_start { self.knot - 1 } else { self.knot }
    }

    /// The neighbouring knot that cannot.
    fn far(&self) -> usize {
        if self.is_start { self.knot } else { self.knot - 1 }
    }

    /// Distance from the knot at which the dyad closes, as a fraction of the cell.
    fn distance(&self) -> f64 {
        if self.is_start { self.root } else { 1.0 - self.root }
    }

    /// Square root of the inside position's distance from the end, relative to the knot's.
    fn part_of_root(&self) -> f64 {
        let [inside, _] = self.lanes(0).map(|side| self.parts()[side]);
        ((inside - self.root).abs() / self.distance()).sqrt()
    }

    /// Converts a rate at the knot at which the dyad closes into a derivative by that square root.
    fn per_part(&self, scan: &ScanView<'_>, rate: f64) -> f64 {
        let width = 2.0 * self.distance() * scan.cell;
        if self.is_start { -rate * width } else { rate * width }
    }

    /// An angle at the end: the cubic in the square root of the distance through the angle and its rate at
    /// the inside position, `known`, and at the reachable knot.
    pub(in crate::branch) fn extrapolated(
        &self,
        scan: &ScanView<'_>,
        (angle, rate): (f64, f64),
        (angles, rates): (&[f64; KNOTS], &[f64; KNOTS]),
    ) -> f64 {
        let y = self.part_of_root();
        let [from, to] = [y * rate, rates[self.known()]].map(|rate| self.per_part(scan, rate));
        let width = 1.0 - y;
        let change = unwrap_to(angles[self.known()], angle) - angle;
        let (from, to, t) = (from * width, to * width, -y / width);
        // Hermite's polynomial: angle + t (from + t (b + t c)).
        let c = from + to - 2.0 * change;
        let b = change - from - c;
        angle + t * (from + t * (b + t * c))
    }

    /// Whether an angle can be unwrapped to the end: from the reachable knot to the inside position it
    /// changes as the square root of the distance, and hardly at all to the position beyond. `steps`:
    /// its changes from the knot to both; `rates`: at the knots.
    pub(in crate::branch) fn is_followed(
        &self,
        scan: &ScanView<'_>,
        steps: [f64; 2],
        rates: &[f64; KNOTS],
    ) -> bool {
        let [to_end, beyond] = steps;
        let expected = self.per_part(scan, rates[self.known()]) * (self.part_of_root() - 1.0);
        // NaN fails these comparisons.
        to_end.abs() <= 2.0 * KNOT_MAX_TURN
            && (to_end - expected).abs() <= KNOT_MAX_TURN
            && (beyond - to_end).abs() <= 0.5 * KNOT_MAX_TURN
    }

    /// Whether the two positions beside it, from lane `first` on, confirm the end where it was predicted
    /// and show that no later dyad opens before it, or closes if it lies in that dyad's gap.
    pub(in crate::branch) fn is_as_predicted(
        &self,
        samples: &[[[f64; POSITIONS]; 3]],
        open: u32,
        scan: &ScanView<'_>,
        first: usize,
    ) -> bool {
        let [inside, outside] = self.lanes(first);
        let closing_knot = self.known();
        for (index, [squares, rates, flats]) in samples.iter().enumerate().skip(self.dyad) {
            let [square, rate] = [squares[inside], rates[inside]];
            if index == self.dyad {
                let is_there = square > 0.0 && squares[outside] < 0.0;
                // The same slope beyond: the gap is not about to end.
                let apart = [rate, rates[outside]].map(|r| (r * scan.cell - self.slope).abs());
                let is_steady = apart.iter().all(|apart| *apart <= MAX_APART * self.slope.abs());
                let other_way = (flats[outside] > 0.0) != has(scan.dyads[index].folded, self.far());
                if !(is_there && is_steady) || other_way {
                    return false;
                }
                continue;
            }
            let [at_knot, rate_at_knot] = scan.dyads[index].at(closing_knot);
            let y = self.part_of_root();
            let slopes = [rate_at_knot, y * rate].map(|rate| self.per_part(scan, rate));
            if !stays_away([at_knot, slopes[0]], y, [square, slopes[1]]) {
                return false;
            }
            if at_knot < 0.0 {
                return self.is_shut;
            }
        }
        !self.is_shut && open >> inside & 1 == 0
    }
}

/// Whether the square of a later dyad keeps its sign between a knot and the end. It varies smoothly
/// with y, the square root of the distance from the end (1 at the knot). The arguments are the square and
/// its derivative by y, at the knot and at another `y`.
fn stays_away([at_knot, slope]: [f64; 2], y: f64, [at_y, slope_at_y]: [f64; 2]) -> bool {
    let back = y - 1.0;
    let curvature = (at_y - at_knot - slope * back) / (back * back);
    let at_end = at_knot - slope + curvature;
    let vertex = 1.0 - slope / (2.0 * curvature);
    let at_vertex = at_knot - slope * slope / (4.0 * curvature);
    let turns = 0.0 < vertex && vertex < 1.0;
    let squares = [at_knot, at_y, at_end, if turns { at_vertex } else { at_knot }];
    let sign = at_knot.signum();
    let smallest = squares.iter().fold(f64::INFINITY, |smallest, s| smallest.min(sign * s));
    let greatest = squares.iter().fold(0.0, |greatest: f64, s| greatest.max(sign * s));
    // The cubic through both derivatives differs from the parabola by at most 4/27 of this.
    let apart = (slope_at_y - (slope + 2.0 * curvature * back)).abs();
    // NaN fails this.
    squares.iter().all(|square| square.is_finite())
        && smallest > MARGIN * (greatest - smallest) + apart
}

#[cfg(test)]
mod tests {
    use super::*;

    /// [`stays_away`] for a parabola in y.
    fn known([end, slope, curvature]: [f64; 3], y: f64) -> bool {
        let at = |y: f64| [end + y * (slope + y * curvature), slope + 2.0 * y * curvature];
        stays_away(at(1.0), y, at(y))
    }

    #[test]
    fn squares_keep_their_sign_up_to_the_end() {
        for y in [0.03, 0.1, 0.25] {
            assert!(known([1.0, 0.5, 0.2], y) && known([-1.0, -0.5, 0.2], y));
            // A root between, two roots between, and one just beyond the end.
            assert!(!known([-0.5, 1.0, 0.0], y));
            assert!(!known([1.0, -4.2, 4.0], y));
            assert!(!known([0.01, 1.0, 0.0], y));
        }
        // A peak in between that a parabola does not show.
        assert!(!stays_away([-1.0, 0.0], 0.1, [-1.0, 9.0]));
        assert!(!stays_away([1.0, f64::NAN], 0.1, [1.0, 0.0]));
    }
}
