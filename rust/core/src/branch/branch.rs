//! The way from the drawing: signs that change at change points, angles followed
//! continuously.
//!
//! At a change point a dyad with two solutions is flat and both solutions meet;
//! the smooth motion goes from one to the other, so its sign changes there. An
//! angle is known up to whole turns. Both are found along the straight path of q
//! from the drawing, on knots that depend on the design alone: equal cells, halved
//! where a link turns fast. So neither depends on which positions are asked for.

use std::f64::consts::TAU;

use super::hermite::HermiteCell;
use super::knot::{ChangePoint, InitialGuess, Knot, SignInterval};
use super::tracer::BranchTracer;
use crate::math::angle::{reduce_turns, whole_part};
use crate::math::lanes::{LANES, Real};
use crate::plan::plan::Plan;
use crate::state::state::{Context, State};

/// Cells in a turn of a driven angle: knots fill the lanes of four groups, and an odd
/// number keeps them off the places half a turn from the drawing.
pub(crate) const CELLS_A_TURN: u32 = 31;
/// Cells in a unit (of the scale, or rad) of a driven slide's way and of a straight one.
const CELLS_A_LENGTH: f64 = 16.0;
/// Steps of a cell in which an island that no knot has seen is measured.
const ISLAND_STEPS: f64 = 1024.0;
/// Cells of a straight way, at most; whoever asks for a place keeps within that.
const MOST_CELLS: f64 = 1.0e6;
/// Turns after which the signs have returned, at the latest; a kite needs two.
const MOST_TURNS: u32 = 64;

/// Angles and signs along one path.
#[derive(Debug, Clone, Default)]
pub(crate) struct Branch {
    /// Parameters of the knots.
    pub(crate) at: Vec<f64>,
    /// Whether they can be reached.
    pub(crate) reached: Vec<bool>,
    /// Lifted angle of every class at every knot (where not reached: at the last that was).
    pub(crate) angles: Vec<f64>,
    pub(crate) stretches: Vec<SignInterval>,
    pub(crate) changes: Vec<ChangePoint>,
    /// Gain of every class over a period.
    pub(crate) gain: Vec<f64>,
    pub(crate) period: Option<f64>,
    /// Where the way is known; none: everywhere.
    pub(crate) covered: Option<[f64; 2]>,
    /// Of every cell after a knot, the groups' unknowns.
    pub(crate) cells: Vec<HermiteCell>,
    /// Signs of the groups' determinants where the way begins.
    pub(crate) bends: Vec<bool>,
    /// Knots a unit of the parameter, if all are reached and equally spaced.
    pub(crate) even: Option<f64>,
}

/// Places on a track, one a lane.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct BranchLocation<R = f64> {
    /// The parameter within the first period.
    pub(crate) place: R,
    /// Whole periods before it.
    whole: R,
    /// The knot that tells the angles.
    pub(crate) knot: [usize; LANES],
    /// The first and the last of these, if there are no others; and 1 where it is the last.
    pub(crate) pair: Option<[usize; 2]>,
    pub(crate) is_last: R,
}

impl Branch {
    /// A path without a single position: the dimensions cannot be followed from the drawing's, or
    /// it ends where it begins.
    ///
    /// It has the signs of the drawing all the same: lanes are filled with them before a lane's
    /// coordinate is looked at.
    pub(crate) fn nowhere(classes: usize, signs: &[f64]) -> Self {
        let covered = Some([f64::INFINITY, f64::NEG_INFINITY]);
        let stretches = vec![SignInterval { from: f64::NEG_INFINITY, signs: signs.to_vec() }];
        Self { gain: vec![0.0; classes], stretches, covered, ..Self::default() }
    }

    /// Along one driven angle, from `q0` on, for ever.
    pub(crate) fn turning(
        cx: &Context<'_>,
        state: &mut State,
        q0: f64,
        start: &InitialGuess<'_>,
    ) -> Self {
        let point = |at: f64, q: &mut [f64]| q[0] = at;
        let mut walker = BranchTracer::new(cx, state, &point, &[1.0], (q0, 1.0), start);
        if walker.ended {
            return Self::nowhere(start.angles.len(), cx.signs);
        }
        let mut turns = 0;
        let mut returned = false;
        while turns < MOST_TURNS && !returned {
            for cell in 1..=CELLS_A_TURN {
                let turned = f64::from(turns) + f64::from(cell) / f64::from(CELLS_A_TURN);
                walker.advance(q0 + TAU * turned);
            }
            if walker.ended {
                break;
            }
            turns += 1;
            returned = walker.has_returned();
        }
        let stretches = walker.stretches();
        let BranchTracer { knots, changes, ended, .. } = walker;
        if ended {
            // A group folds; the other way as well then.
            let most = f64::from(MOST_TURNS * CELLS_A_TURN);
            let cells = ([most; 2], TAU / f64::from(CELLS_A_TURN));
            let track = Self::both_ways(cx, state, q0, cells, start);
            let ends = [track.at.first(), track.at.last()].map(|end| end.copied().unwrap_or(q0));
            return Self { covered: Some(ends), ..track };
        }
        let gain = match (knots.iter().find(|k| k.reached), knots.last()) {
            (Some(first), Some(last)) => {
                let pairs = first.angles.iter().zip(&last.angles);
                pairs.map(|(&a, &b)| TAU * ((b - a) / TAU).round()).collect()
            }
            _ => vec![0.0; start.angles.len()],
        };
        let period = returned.then_some(TAU * f64::from(turns));
        let end = if returned { f64::INFINITY } else { q0 + TAU * f64::from(turns) };
        let covered = [if returned { f64::NEG_INFINITY } else { q0 }, end];
        Self {
            stretches,
            changes,
            gain,
            period,
            covered: Some(covered),
            ..Self::of(&knots, cx.plan)
        }
    }

    /// Along one driven slide, from `q0` both ways to `low` and `high`
    /// (not farther than `reach` from `q0`).
    pub(crate) fn sliding(
        cx: &Context<'_>,
        state: &mut State,
        q0: f64,
        [low, high]: [f64; 2],
        reach: f64,
        start: &InitialGuess<'_>,
    ) -> Self {
        let cells = [q0 - low, high - q0].map(|way| (way.min(reach) * CELLS_A_LENGTH).ceil());
        Self::both_ways(cx, state, q0, (cells, 1.0 / CELLS_A_LENGTH), start)
    }

    /// From `q0` down and up, so many cells of a width; not beyond where the way ends.
    fn both_ways(
        cx: &Context<'_>,
        state: &mut State,
        q0: f64,
        (cells, width): ([f64; 2], f64),
        start: &InitialGuess<'_>,
    ) -> Self {
        let point = |at: f64, q: &mut [f64]| q[0] = at;
        let mut all: Vec<Knot> = Vec::new();
        let mut track = Self { gain: vec![0.0; start.angles.len()], ..Self::default() };
        let mut covered = [f64::NEG_INFINITY, f64::INFINITY];
        for (cells, way) in cells.into_iter().zip([-1.0, 1.0]) {
            let mut walker = BranchTracer::new(cx, state, &point, &[1.0], (q0, way), start);
            if walker.ended {
                return Self::nowhere(start.angles.len(), cx.signs);
            }
            let mut cell = 0.0;
            while cell < cells && !walker.ended {
                cell += 1.0;
                walker.advance(q0 + way * cell * width);
            }
            let mut stretches = walker.stretches();
            let BranchTracer { mut knots, mut changes, ended, .. } = walker;
            if ended && let Some(last) = knots.last() {
                covered[usize::from(way > 0.0)] = last.at;
            }
            if way < 0.0 {
                knots.reverse();
                knots.pop();
                changes.reverse();
                // Downward a stretch begins where the next change is.
                for i in 0..stretches.len() {
                    stretches[i].from = stretches.get(i + 1).map_or(f64::NEG_INFINITY, |s| s.from);
                }
                stretches.reverse();
                // The last of them, around q0, is the first of the way up.
                if let (Some(around), true) = (stretches.pop(), track.stretches.is_empty()) {
                    track.stretches = stretches;
                    track.stretches.push(around);
                }
            } else {
                track.stretches.extend(stretches.into_iter().skip(1));
            }
            all.append(&mut knots);
            track.changes.append(&mut changes);
        }
        Self {
            changes: track.changes,
            stretches: track.stretches,
            gain: track.gain,
            covered: Some(covered),
            ..Self::of(&all, cx.plan)
        }
    }

    /// Straight from the drawing to one point of several coordinates; the parameter there.
    ///
    /// Cells are as wide on every such way, so that two places on one ray from the drawing have the
    /// same knots before them, and see or miss the same islands.
    pub(crate) fn straight(
        cx: &Context<'_>,
        state: &mut State,
        q0: &[f64],
        q1: &[f64],
        start: &InitialGuess<'_>,
    ) -> (Self, f64) {
        let way = || q0.iter().zip(q1).map(|(a, b)| b - a);
        let end = way().fold(0.0_f64, |most, change| most.max(change.abs()));
        let rates: Vec<f64> =
            way().map(|change| if end > 0.0 { change / end } else { 0.0 }).collect();
        let point = |at: f64, q: &mut [f64]| {
            for ((x, &a), &rate) in q.iter_mut().zip(q0).zip(&rates) {
                *x = a + at * rate;
            }
        };
        let width = (end / MOST_CELLS).max(1.0 / CELLS_A_LENGTH);
        let mut walker = BranchTracer::new(cx, state, &point, &rates, (0.0, 1.0), start);
        if walker.ended {
            return (Self::nowhere(start.angles.len(), cx.signs), end);
        }
        let (mut cell, mut at) = (0.0, 0.0);
        while at < end {
            cell += 1.0;
            at = f64::min(cell * width, end);
            walker.advance(at);
            // Only the end is asked for.
            walker.knots.drain(..walker.knots.len() - 1);
        }
        let stretches = walker.stretches();
        let BranchTracer { knots, changes, ended, .. } = walker;
        let gain = vec![0.0; start.angles.len()];
        let covered = ended.then_some([0.0, 0.0]);
        (Self { stretches, changes, gain, covered, ..Self::of(&knots, cx.plan) }, end)
    }

    /// Keeps what is asked of knots later.
    fn of(knots: &[Knot], plan: &Plan) -> Self {
        let mut cells = Vec::new();
        for (i, a) in knots.iter().enumerate() {
            let b = knots.get(i + 1);
            let width = b.map_or(0.0, |b| b.at - a.at);
            let unknowns = plan.groups().flat_map(|group| &group.unknowns);
            for (place, (&unknown, seed)) in unknowns.zip(&a.seeds).enumerate() {
                let end = b.and_then(|b| b.seeds.get(place));
                cells.push(HermiteCell::of(unknown, seed, end, width));
            }
        }
        Self {
            at: knots.iter().map(|k| k.at).collect(),
            reached: knots.iter().map(|k| k.reached).collect(),
            angles: knots.iter().flat_map(|k| k.angles.iter().copied()).collect(),
            bends: knots.first().map(|knot| knot.bends.clone()).unwrap_or_default(),
            cells,
            ..Self::default()
        }
    }

    /// The parameter within the first period, and whole periods before it.
    #[inline(always)]
    pub(crate) fn reduced<R: Real>(&self, at: R) -> (R, R) {
        let (Some(&first), Some(period)) = (self.at.first(), self.period) else {
            return (at, R::ZERO);
        };
        let whole = ((at - R::splat(first)) * R::splat(1.0 / period)).floor();
        if self.even.is_some() {
            // Only the whole turns matter.
            return (at - whole * R::splat(period), whole);
        }
        let turns = (period / TAU).round();
        (R::from_lanes(|lane| reduce_turns(at.lane(lane), whole.lane(lane) * turns)), whole)
    }

    /// Whether the way to a parameter is known.
    #[inline(always)]
    pub(crate) fn covers(&self, at: f64) -> bool {
        self.covered.is_none_or(|[low, high]| (low..=high).contains(&at))
    }

    /// Finds a place; with no knots nothing is to be found.
    #[inline(always)]
    pub(crate) fn spot<R: Real>(&self, at: R) -> BranchLocation<R> {
        let (place, whole) = self.reduced(at);
        let mut knot = [0; LANES];
        let last = self.at.len().saturating_sub(1);
        if self.at.is_empty() {
            return BranchLocation { place, whole, knot, ..BranchLocation::default() };
        }
        if let Some(per) = self.even {
            let cells = (place - R::splat(self.at[0])) * R::splat(per);
            for lane in 0..R::LANES {
                // At the edge of a cell either knot will do.
                let cell = whole_part(cells.lane(lane));
                knot[lane] = cell.min(last);
            }
        } else {
            for lane in 0..R::LANES {
                knot[lane] = self.knot_before(place.lane(lane)).min(last);
            }
        }
        let pair = [knot[0], knot[R::LANES - 1]];
        let is_pair = knot[..R::LANES].iter().all(|knot| pair.contains(knot));
        let is_last = R::from_lanes(|lane| if knot[lane] == pair[1] { 1.0 } else { 0.0 });
        BranchLocation { place, whole, knot, pair: is_pair.then_some(pair), is_last }
    }

    /// The nearest knot before a place that can be reached, or the next one if only
    /// that can.
    fn knot_before(&self, place: f64) -> usize {
        let after = self.at.partition_point(|&k| k <= place);
        let left = after.saturating_sub(1);
        let ahead = self.reached.get(after).copied().unwrap_or(false);
        if ahead && !self.reached[left] { after } else { left }
    }

    /// The assembly signs at a place.
    #[inline(always)]
    pub(crate) fn signs_at<R: Real>(&self, spot: &BranchLocation<R>, lane: usize) -> &[f64] {
        let after = match self.stretches.len() {
            1 => 1,
            _ => self.stretches.partition_point(|s| s.from <= spot.place.lane(lane)),
        };
        self.stretches.get(after.saturating_sub(1)).map_or(&[], |s| &s.signs)
    }

    /// The assembly signs at a parameter.
    pub(crate) fn signs(&self, at: f64) -> &[f64] {
        self.signs_at(&self.spot(at), 0)
    }

    /// Whether the signs are the same everywhere.
    #[inline(always)]
    pub(crate) fn is_one_stretch(&self) -> bool {
        self.stretches.len() == 1
    }

    /// The change point (of the first period) that a parameter is beside, if there is one, and how
    /// far from it.
    pub(crate) fn change_near(&self, at: f64, reach: f64) -> Option<(ChangePoint, f64)> {
        if self.changes.is_empty() {
            return None;
        }
        let (place, _) = self.reduced(at);
        let period = self.period.unwrap_or(0.0);
        let images = |c: &ChangePoint| [0.0, -period, period].map(|by| (*c, place - (c.at + by)));
        self.changes.iter().flat_map(images).find(|(_, distance)| distance.abs() <= reach)
    }

    /// Whether a place lies on an island that no knot has seen.
    #[inline(always)]
    pub(crate) fn hides<R: Real>(&self, spot: &BranchLocation<R>, lane: usize) -> bool {
        let around = || self.around(spot.place.lane(lane));
        self.even.is_none() && around().is_some_and(|[a, b]| !a && !b)
    }

    /// Whether the knots on both sides of a place can be reached.
    fn around(&self, place: f64) -> Option<[bool; 2]> {
        let after = self.at.partition_point(|&k| k <= place);
        Some([*self.reached.get(after.checked_sub(1)?)?, *self.reached.get(after)?])
    }

    /// The way along such an island, from its middle to the parameter: at an end a joint may be at
    /// infinity, where angles are rounding.
    pub(crate) fn island(&self, cx: &Context<'_>, state: &mut State, at: f64) -> Self {
        let (place, whole) = self.reduced(at);
        let after = self.at.partition_point(|&k| k <= place);
        let Some(left) = after.checked_sub(1).filter(|_| after < self.at.len()) else {
            return Self::default();
        };
        let angles = &self.angles[left * self.gain.len()..][..self.gain.len()];
        let seeds = self.seeds(left, place);
        let start = InitialGuess { angles, seeds: &seeds };
        let (left, right) = (self.at[left], self.at[after]);
        let cx = Context { signs: self.signs(at), ..*cx };
        let point = |at: f64, q: &mut [f64]| q[0] = at;
        let mut walker = BranchTracer::new(&cx, state, &point, &[1.0], (place, 1.0), &start);
        let step = (right - left) / ISLAND_STEPS;
        let mut end = |way: f64, limit: f64| {
            let (mut inside, mut outside) = (place, limit);
            while (limit - inside) * way > step {
                if !walker.visit(inside + way * step) {
                    outside = inside + way * step;
                    break;
                }
                inside += way * step;
            }
            walker.edge([inside, outside])
        };
        let middle = 0.5 * (end(-1.0, left) + end(1.0, right));
        let way = if place < middle { -1.0 } else { 1.0 };
        let mut walker = BranchTracer::new(&cx, state, &point, &[1.0], (middle, way), &start);
        walker.advance(place);
        let BranchTracer { mut knots, .. } = walker;
        if way < 0.0 {
            knots.reverse();
        }
        for knot in &mut knots {
            knot.at += at - place;
            for (angle, gain) in knot.angles.iter_mut().zip(&self.gain) {
                *angle += whole * gain;
            }
        }
        Self { gain: self.gain.clone(), ..Self::of(&knots, cx.plan) }
    }

    /// The angle of a class at the knots of places.
    #[inline(always)]
    pub(crate) fn near<R: Real>(&self, spot: &BranchLocation<R>, class: usize) -> R {
        let classes = self.gain.len();
        if self.at.is_empty() {
            return R::ZERO;
        }
        let near = R::from_lanes(|lane| self.angles[spot.knot[lane] * classes + class]);
        near + spot.whole * R::splat(self.gain[class])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Turns either way leave the angle that was there, to the rounding of the sum itself.
    #[test]
    fn turns_taken_off_are_turns_put_on() {
        for turns in [1.0, 2.0, 64.0, 1000.0, 4_194_303.0, 4_194_304.0, 1e9] {
            for part in [0.001, 0.735_422_665_253_286_5, 3.0, 6.2] {
                for turns in [turns, -turns] {
                    let angle = part + TAU * turns;
                    // 2π as a double, and what it lacks.
                    let lost = (angle - TAU * turns) - part;
                    let wanted = part + lost - turns * 2.449_293_598_294_706_4e-16;
                    let rounding = 2.0 * f64::EPSILON * angle.abs().max(TAU);
                    let found = reduce_turns(angle, turns);
                    assert!((found - wanted).abs() <= rounding, "{turns} {part}: {found} {wanted}");
                }
            }
        }
    }

    /// Backward as well: a small angle less −1 turn is the sum, rounded once or twice.
    #[test]
    fn small_angles_keep_their_digits() {
        for angle in [-0.735_422_665_253_286_5, -1e-9, 0.1, 3.0] {
            let found = reduce_turns(angle, -1.0);
            assert!((found - (angle + TAU)).abs() <= 2.0 * f64::EPSILON * TAU, "{angle}: {found}");
        }
    }
}
