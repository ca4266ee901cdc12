//! The ends of the gaps of a turn, found together: the roots of the dyads' discriminants are
//! predicted from the knots beside them, and positions on either side confirm them.
//!
//! Beside a dead point angles vary as the square root of the distance, so that even knots would have
//! to be very close to follow them. What is not confirmed here is left to closer looks.

use std::f64::consts::PI;

use super::cell_test::{Bits, DyadSamples, has};
use super::uniform::{KNOTS, UniformTracer};
use crate::math::angle::unwrap_to;
use crate::math::lanes::{LANES, Mask, Real};
use crate::math::tolerance::KNOT_MAX_TURN;
use crate::state::kernel::Level;
use crate::state::state::Context;

/// Ends looked for at once; a turn seldom has more.
const MAX_ENDS: usize = LANES / 2;
/// Half of the stretch that an end is confined to, as a part of a cell: the turn left there is a
/// sixteenth of that over the cell.
const STRETCH: f64 = 1.0 / 256.0;
/// How far (rad) an angle may step across a gap whose ends are not looked at closely: not nearly half
/// a turn.
pub(super) const MAX_STEP: f64 = PI - 0.5;
/// By which part of itself the slope at an end may differ from that of the polynomial between two
/// knots: farther, it does not show all that happens between these.
const MAX_APART: f64 = 0.25;
/// By which part of its change the square of a later dyad must stay away from zero.
const MARGIN: f64 = 0.25;
/// Steps of Newton's method on the polynomial between two knots.
const STEPS: usize = 4;

/// The end of a gap between two knots.
#[derive(Debug, Clone, Copy)]
struct End {
    /// The knot behind it.
    knot: usize,
    /// The dyad that is flat there.
    dyad: usize,
    /// Whether the dyad closes before it, not after it.
    is_start: bool,
    /// Where it is, as a part of the cell, and the derivative of the square by that part.
    root: f64,
    slope: f64,
    is_confirmed: bool,
}

/// The ends found, with what the positions beside them show.
#[derive(Debug, Default)]
pub(super) struct GapEnds {
    ends: Vec<End>,
    /// Of every dyad, the square and its rate before every end and after it.
    squares: Vec<[[f64; LANES]; 2]>,
    /// The same of the angles asked for.
    angles: Vec<[f64; LANES]>,
    /// Positions that do not close, by their bits.
    open: u32,
}

/// The knots of a look, and what they have shown.
#[derive(Clone, Copy)]
pub(super) struct Shown<'l> {
    /// The first knot, the width of a cell, and the number of knots.
    pub from: f64,
    pub cell: f64,
    pub count: usize,
    /// Cells with an end that nothing speaks against.
    pub cells: Bits,
    /// Knots that can be reached.
    pub reached: Bits,
    pub dyads: &'l [DyadSamples],
    /// Angles and rates of the classes asked for.
    pub angles: &'l [[f64; KNOTS]],
    pub rates: &'l [[f64; KNOTS]],
}

/// A position beside an end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Beside {
    pub at: f64,
    pub reached: bool,
    /// Its place in [`GapEnds::angle`].
    pub lane: usize,
}

impl GapEnds {
    /// Forgets all.
    pub(super) fn clear(&mut self) {
        self.ends.clear();
    }

    /// Whether none was found.
    pub(super) fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    fn index(&self, knot: usize) -> Option<usize> {
        self.ends.iter().position(|end| end.is_confirmed && end.knot == knot)
    }

    /// The positions beside the end in the cell before a knot, if it was found.
    pub(super) fn beside(&self, shown: (f64, f64), knot: usize) -> Option<[Beside; 2]> {
        let index = self.index(knot)?;
        let end = &self.ends[index];
        let [before, after] = end.beside(shown);
        Some([
            Beside { at: before, reached: end.is_start, lane: 2 * index },
            Beside { at: after, reached: !end.is_start, lane: 2 * index + 1 },
        ])
    }

    /// The angle of a class there.
    pub(super) fn angle(&self, class: usize, beside: &Beside) -> f64 {
        self.angles[class][beside.lane]
    }

    /// Finds the ends in some cells.
    #[inline(always)]
    pub(super) fn find<L: Level, const G: usize>(
        &mut self,
        cx: &Context<'_>,
        knots: &mut UniformTracer<L::Register, G>,
        classes: &[usize],
        shown: &Shown<'_>,
    ) {
        self.ends.clear();
        let mut left = shown.cells;
        while left != 0 && self.ends.len() < MAX_ENDS {
            let knot = left.trailing_zeros() as usize;
            left &= left - 1;
            self.ends.extend(End::predict(shown, knot));
        }
        if self.ends.is_empty() {
            return;
        }
        self.solve::<L, G>(cx, knots, shown);
        for (index, end) in self.ends.iter_mut().enumerate() {
            end.is_confirmed = end.is_as_predicted(&self.squares, self.open, shown, 2 * index);
        }
        self.angles.resize(classes.len(), [0.0; LANES]);
        for (angles, &class) in self.angles.iter_mut().zip(classes) {
            for group in 0..LANES / L::Register::LANES {
                let angle = knots.state.pose.class[class][group].angle();
                for lane in 0..L::Register::LANES {
                    angles[group * L::Register::LANES + lane] = angle.lane(lane);
                }
            }
        }
        for index in 0..self.ends.len() {
            self.ends[index].is_confirmed &= self.turns_little(shown, index);
        }
    }

    /// The cells whose ends were found.
    pub(super) fn cells(&self) -> Bits {
        let found = self.ends.iter().filter(|end| end.is_confirmed);
        found.fold(0, |cells, end| cells | 1 << end.knot)
    }

    /// The least and greatest angle of a class at the knots that can be reached, and at the ends of
    /// gaps, if its link turns slowly and stays within half a turn of where it is first; that is the
    /// nearest to `start`.
    pub(super) fn range(&self, shown: &Shown<'_>, class: usize, start: f64) -> Option<[f64; 2]> {
        let (angles, rates) = (&shown.angles[class], &shown.rates[class]);
        // Angles where the mechanism no longer closes, in order; the first gap may begin before the
        // first knot.
        let begins_open = !has(shown.reached, 0);
        let mut outside = start;
        let mut near = if begins_open { None } else { Some(unwrap_to(angles[0], start)) };
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        let mut first_outside = None;
        for end in &self.ends {
            let index = self.index(end.knot)?;
            let lanes = end.lanes(2 * index).map(|lane| self.angles[class][lane]);
            let near = *near.get_or_insert_with(|| unwrap_to(lanes[1], start));
            let [inside, beyond] = lanes.map(|angle| unwrap_to(angle, near));
            let known = unwrap_to(angles[end.known()], near);
            let steps = [inside - known, beyond - known];
            let steps_far = !end.is_start && (beyond - outside).abs() > MAX_STEP;
            if steps_far || !end.is_followed(shown, steps, rates) {
                return None;
            }
            range = [range[0].min(inside), range[1].max(inside)];
            outside = beyond;
            first_outside.get_or_insert(beyond);
        }
        let near = near?;
        if let (true, Some(first)) = (begins_open, first_outside)
            && (outside - first).abs() > MAX_STEP
        {
            return None;
        }
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

    /// Solves the positions before and after all ends, whether or not they close.
    #[inline(always)]
    fn solve<L: Level, const G: usize>(
        &mut self,
        cx: &Context<'_>,
        knots: &mut UniformTracer<L::Register, G>,
        shown: &Shown<'_>,
    ) {
        let mut at = [shown.from; LANES];
        for (end, at) in self.ends.iter().zip(at.chunks_exact_mut(2)) {
            at.copy_from_slice(&end.beside((shown.from, shown.cell)));
        }
        knots.set_at(&at);
        knots.solve_carefully::<L>(cx);
        self.squares.resize(shown.dyads.len(), [[0.0; LANES]; 2]);
        let of_dyads = cx.plan.dyads().zip(&cx.tape.dyads).zip(&mut self.squares);
        for ((dyad, &op), [squares, rates]) in of_dyads {
            for group in 0..LANES / L::Register::LANES {
                let sample = knots.state.sample(group, cx, dyad, &cx.tape.ops[op]);
                for lane in 0..L::Register::LANES {
                    squares[group * L::Register::LANES + lane] = sample.square.lane(lane);
                    rates[group * L::Register::LANES + lane] = sample.rate.lane(lane);
                }
            }
        }
        self.open = 0;
        for group in 0..LANES / L::Register::LANES {
            self.open |= knots.not_closed(group).bits() << (group * L::Register::LANES);
        }
    }

    /// Whether no angle turns far from the knot that can be reached up to the end, nor at it.
    fn turns_little(&self, shown: &Shown<'_>, index: usize) -> bool {
        let end = &self.ends[index];
        let [inside, outside] = end.lanes(2 * index);
        self.angles.iter().zip(shown.angles.iter().zip(shown.rates)).all(|(beside, (at, rate))| {
            let near = at[end.known()];
            let [to_end, beyond] =
                [inside, outside].map(|lane| unwrap_to(beside[lane], near) - near);
            end.is_followed(shown, [to_end, beyond], rate)
        })
    }
}

impl End {
    /// Predicts the end in the cell before a knot.
    #[inline(always)]
    fn predict(shown: &Shown<'_>, knot: usize) -> Option<Self> {
        let dyad = shown.dyads.iter().position(|dyad| dyad.has_dead_point(knot))?;
        let is_start = has(shown.dyads[dyad].closes, knot - 1);
        let [[from, fall], [to, rise]] = [knot - 1, knot].map(|at| shown.dyads[dyad].at(at));
        let [fall, rise] = [fall * shown.cell, rise * shown.cell];
        // Hermite's polynomial: from + t (fall + t (b + t c)).
        let c = fall + rise - 2.0 * (to - from);
        let b = (to - from) - fall - c;
        let slope = |root: f64| fall + root * (2.0 * b + root * (3.0 * c));
        let mut root = from / (from - to);
        for _ in 0..STEPS {
            root -= (from + root * (fall + root * (b + root * c))) / slope(root);
        }
        let end = Self { knot, dyad, is_start, root, slope: slope(root), is_confirmed: false };
        (0.0 < root && root < 1.0).then_some(end)
    }

    /// Positions before and after it, as parts of the cell.
    fn parts(&self) -> [f64; 2] {
        let root = self.root;
        [(root - STRETCH).max(0.5 * root), (root + STRETCH).min(0.5 * (1.0 + root))]
    }

    /// The same as coordinates, of cells from `from` on.
    fn beside(&self, (from, cell): (f64, f64)) -> [f64; 2] {
        let start = from + cell * (self.knot - 1) as f64;
        self.parts().map(|part| start + cell * part)
    }

    /// The lanes of the positions that can be reached and that cannot, from the first on.
    fn lanes(&self, first: usize) -> [usize; 2] {
        if self.is_start { [first, first + 1] } else { [first + 1, first] }
    }

    /// The knot beside it that can be reached.
    fn known(&self) -> usize {
        if self.is_start { self.knot - 1 } else { self.knot }
    }

    /// How far it is from there, as a part of the cell.
    fn distance(&self) -> f64 {
        if self.is_start { self.root } else { 1.0 - self.root }
    }

    /// The root of the distance of the position that can be reached, as a part of that of the knot.
    fn part_of_root(&self) -> f64 {
        let [inside, _] = self.lanes(0).map(|place| self.parts()[place]);
        ((inside - self.root).abs() / self.distance()).sqrt()
    }

    /// The derivative by this part, at the knot that can be reached, of what has rate `rate` there.
    fn per_part(&self, shown: &Shown<'_>, rate: f64) -> f64 {
        let width = 2.0 * self.distance() * shown.cell;
        if self.is_start { -rate * width } else { rate * width }
    }

    /// Whether an angle is followed to the end: from that knot to the position that can be reached it
    /// turns as the root of the distance, and hardly on to that beyond. `rates`: at the knots.
    fn is_followed(&self, shown: &Shown<'_>, steps: [f64; 2], rates: &[f64; KNOTS]) -> bool {
        let [to_end, beyond] = steps;
        let expected = self.per_part(shown, rates[self.known()]) * (self.part_of_root() - 1.0);
        // NaN is not followed.
        to_end.abs() <= 2.0 * KNOT_MAX_TURN
            && (to_end - expected).abs() <= KNOT_MAX_TURN
            && (beyond - to_end).abs() <= 0.5 * KNOT_MAX_TURN
    }

    /// Whether the positions beside it, the first of them at a lane, show it where it was predicted, and
    /// that no later dyad opens before it.
    fn is_as_predicted(
        &self,
        squares: &[[[f64; LANES]; 2]],
        open: u32,
        shown: &Shown<'_>,
        first: usize,
    ) -> bool {
        let [inside, outside] = self.lanes(first);
        let known = self.known();
        for (index, [squares, rates]) in squares.iter().enumerate().skip(self.dyad) {
            let [square, rate] = [squares[inside], rates[inside]];
            if index == self.dyad {
                let apart = (rate * shown.cell - self.slope).abs();
                let is_there = square > 0.0 && squares[outside] < 0.0;
                if !(is_there && apart <= MAX_APART * self.slope.abs()) {
                    return false;
                }
                continue;
            }
            let [at_knot, rate_at_knot] = shown.dyads[index].at(known);
            let y = self.part_of_root();
            let slopes = [rate_at_knot, y * rate].map(|rate| self.per_part(shown, rate));
            if !stays_away([at_knot, slopes[0]], y, [square, slopes[1]]) {
                return false;
            }
        }
        open >> inside & 1 == 0
    }
}

/// Whether the square of a later dyad keeps its sign between a knot and the end: it varies as the
/// root y of the distance from there, which is 1 at the knot. Given the square with its derivative by
/// y at the knot and at another `y`.
fn stays_away([at_knot, slope]: [f64; 2], y: f64, [at_y, slope_at_y]: [f64; 2]) -> bool {
    let back = y - 1.0;
    let curvature = (at_y - at_knot - slope * back) / (back * back);
    let at_end = at_knot - slope + curvature;
    let vertex = 1.0 - slope / (2.0 * curvature);
    let at_vertex = at_knot - slope * slope / (4.0 * curvature);
    let turns = 0.0 < vertex && vertex < 1.0;
    let squares = [at_knot, at_y, at_end, if turns { at_vertex } else { at_knot }];
    let sign = at_knot.signum();
    let least = squares.iter().fold(f64::INFINITY, |least, s| least.min(sign * s));
    let most = squares.iter().fold(0.0, |most: f64, s| most.max(sign * s));
    // The polynomial of third degree with both derivatives leaves the parabola by 4/27 of this.
    let apart = (slope_at_y - (slope + 2.0 * curvature * back)).abs();
    // NaN stays nowhere.
    squares.iter().all(|square| square.is_finite()) && least > MARGIN * (most - least) + apart
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is known of a parabola in y.
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
        // A peak between that a parabola does not show.
        assert!(!stays_away([-1.0, 0.0], 0.1, [-1.0, 9.0]));
        assert!(!stays_away([1.0, f64::NAN], 0.1, [1.0, 0.0]));
    }
}
