//! Tests of the cell between two knots, from samples of the dyads at both.
//!
//! Signs change only at change points, and a generic design has none: between two knots the
//! discriminant of every dyad stays away from zero. A cell needs a closer scan if a discriminant may
//! vanish in it, or if a gap may begin or end there.

use super::grid::KNOTS;
use super::grid::previous;
use crate::branch::knot::may_touch;
use crate::math::lanes::{LANES, Mask, Real};
use crate::plan::dyad::Dyad;
use crate::state::dyad::sample::DyadSample;
use crate::state::state::{Context, State};

/// A cell is too coarse if a square differs from the trapezoidal rule by this fraction of itself.
const MAX_CURVATURE: f64 = 0.5;
/// A square falls or rises throughout a cell if it does at both ends and differs from the trapezoidal rule by
/// less than this part of its least fall or rise: two thirds would allow a rate of zero between them.
const MAX_UNSTEADY: f64 = 0.25;
/// A negative square stays below zero in a cell if it is below zero by this many times its rise over
/// the neighbouring cell.
const MAX_FALLS: f64 = 4.0;
/// A peak is below zero if the tangents at both ends meet below zero by this many times their rise.
const MAX_PEAKS: f64 = 3.0;
/// Factor of safety on the expected change of a later dyad's square up to a dead point.
const CHANGE_MARGIN: f64 = 2.5;

/// Square below which a dyad counts as flat at a knot. The square grows with the square of the
/// distance from a change point, so this is 1e-6 rad from one.
const FLAT_SQUARE: f64 = 1.0e-12;

/// Padding before the entry of the first knot.
const BEFORE: usize = 2;
/// Entries for all knots, their neighbours, and the rest of a register.
const SAMPLES: usize = BEFORE + KNOTS + 1 + LANES;

/// One bit per knot. A cell has the bit of the knot at its end.
pub(in crate::branch) type Bits = u32;

const _: () = assert!(KNOTS <= Bits::BITS as usize, "a bit for every knot");

/// Whether the bit of a knot is set.
#[inline(always)]
pub(in crate::branch) fn has(bits: Bits, knot: usize) -> bool {
    bits >> knot & 1 != 0
}

/// The entries of one register.
#[inline(always)]
fn entries<R: Real>(all: &[f64; SAMPLES], from: usize) -> R {
    R::read(&all[from..])
}

/// Cells with the bits of both their knots set.
#[inline(always)]
fn at_both_ends(bits: Bits) -> Bits {
    bits & bits << 1
}

/// Samples of one dyad at the knots of a scan.
#[derive(Debug, Clone)]
pub(in crate::branch) struct DyadSamples {
    /// See [`DyadSample::square`]; −∞ where a dyad before it does not close. The first [`BEFORE`] entries
    /// and those after the last knot are padding that no knot sets.
    square: [f64; SAMPLES],
    /// See [`DyadSample::rate`].
    rate: [f64; SAMPLES],
    /// Knots at which all dyads before it close.
    known: Bits,
    /// Knots at which it closes too.
    pub closes: Bits,
    /// Knots at which [`DyadSample::flat`] is positive.
    pub folded: Bits,
}

/// Classification of the cells of a scan.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::branch) struct CellFlags {
    /// Where the discriminant may vanish, or an island may hide.
    pub uncertain: Bits,
    /// Where the discriminant varies too fast for two knots to show it, or a gap may be hidden.
    pub curved: Bits,
    /// With a dead point.
    pub dead_point: Bits,
    /// Where neither end can be reached, but some position between them might.
    pub may_hide_island: Bits,
}

/// The knots of a scan.
#[derive(Debug, Clone, Copy)]
pub(in crate::branch) struct ScanGrid {
    /// Number of registers.
    pub groups: usize,
    /// Width of a cell.
    pub cell: f64,
    /// Whether islands matter.
    pub islands: bool,
}

impl DyadSamples {
    pub(in crate::branch) const NONE: Self = Self {
        square: [f64::NEG_INFINITY; SAMPLES],
        rate: [0.0; SAMPLES],
        known: 0,
        closes: 0,
        folded: 0,
    };

    /// Samples a dyad at the knots and classifies the cells. `known`: knots at which all dyads before
    /// it close; `settled`: its sign is known to be constant. `None` if it is flat at a knot, where
    /// samples do not show whether its sign changes.
    #[inline(always)]
    pub(in crate::branch) fn classify<R: Real, const G: usize>(
        &mut self,
        state: &State<R, G>,
        cx: &Context<'_>,
        dyad: &Dyad,
        grid: ScanGrid,
        (known, settled): (Bits, bool),
    ) -> Option<CellFlags> {
        let op = &cx.tape.ops[cx.tape.dyads[dyad.index]];
        let cell = R::splat(grid.cell);
        let half = R::splat(0.5 * grid.cell);
        let (mut closes, mut flat, mut vanishing, mut curved) = (0, 0, 0, 0);
        self.folded = 0;
        let nothing = DyadSample { square: R::ZERO, rate: R::ZERO, side: R::ZERO, flat: R::ONE };
        let mut last = nothing;
        for group in 0..grid.groups.min(G) {
            let first = group * R::LANES;
            let sample = state.sample(group, cx, dyad, op);
            let DyadSample { square, rate, side, flat: folded } = sample;
            for lane in 0..R::LANES {
                let at = BEFORE + first + lane;
                let is_known = has(known, first + lane);
                self.square[at] = if is_known { square.lane(lane) } else { f64::NEG_INFINITY };
                self.rate[at] = rate.lane(lane);
            }
            closes |= R::ZERO.lt(square).bits() << first;
            self.folded |= R::ZERO.lt(folded).bits() << first;
            flat |= R::splat(FLAT_SQUARE).lt(square.abs()).not().bits() << first;
            if settled && !grid.islands {
                continue;
            }
            let before = previous(last.square.lane(R::LANES - 1), square);
            let rate_before = previous(last.rate.lane(R::LANES - 1), rate);
            let touches = may_touch((before, rate_before), (square, rate), cell);
            if settled {
                // Its sign is constant, but a gap within a cell may cut an island off.
                curved |= touches.bits() << first;
                last = sample;
                continue;
            }
            let side_before = previous(last.side.lane(R::LANES - 1), side);
            let curvature = (square - before) - half * (rate + rate_before);
            let smaller = square.min(before);
            let straight = curvature.abs().lt(R::splat(MAX_CURVATURE) * smaller);
            let slowest = rate.abs().min(rate_before.abs()) * cell;
            let falls_or_rises = R::ZERO.lt(rate * rate_before);
            let is_steady = curvature.abs().lt(R::splat(MAX_UNSTEADY) * slowest);
            let straight = straight.or(falls_or_rises.and(is_steady));
            let same_side = R::ZERO.lt(side * side_before);
            vanishing |= touches.or(same_side.not()).bits() << first;
            curved |= straight.not().bits() << first;
            last = sample;
        }
        let count = grid.groups * R::LANES;
        let in_scan = Bits::MAX >> (Bits::BITS as usize - count);
        if known & flat & in_scan != 0 {
            return None;
        }
        (self.known, self.closes) = (known, known & closes);
        // The cell before the first knot is not part of the scan.
        let (cells, closes) = (at_both_ends(known) & in_scan & !1, self.closes);
        let inside = cells & at_both_ends(closes);
        let outside = cells & at_both_ends(!closes);
        let mut flags =
            CellFlags { dead_point: cells & !inside & !outside, ..CellFlags::default() };
        flags.curved = curved & inside;
        if !settled {
            flags.uncertain = vanishing & inside;
        }
        if outside != 0 && (grid.islands || !settled) {
            // Between stretched and folded it closes.
            let other_way = self.folded ^ self.folded << 1;
            let may_close = self.may_close::<R>(count, grid.cell, settled);
            let may_close = (may_close | other_way) & outside;
            if !settled {
                flags.uncertain |= may_close;
            }
            flags.may_hide_island = may_close;
        }
        Some(flags)
    }

    /// Cells in which a dyad that closes at neither end might close: its square would have to rise from
    /// both sides. The square of a dyad on a crank (`settled`) varies slowly, so the tangents at both
    /// ends would also have to meet near zero. That of any other dyad may have a narrow peak beside a
    /// dead point of an earlier dyad.
    #[inline(always)]
    fn may_close<R: Real>(&self, count: usize, cell: f64, settled: bool) -> Bits {
        let mut cells = 0;
        let (falls, cell) = (R::splat(MAX_FALLS), R::splat(cell));
        for first in (0..count).step_by(R::LANES) {
            let before = entries::<R>(&self.square, first);
            let from = entries::<R>(&self.square, first + 1);
            let to = entries::<R>(&self.square, first + 2);
            let after = entries::<R>(&self.square, first + 3);
            let start = entries::<R>(&self.rate, first + 1) * cell;
            let end = entries::<R>(&self.rate, first + 2) * cell;
            // Where the neighbour is unknown, the rate at the knot stands in.
            let with_before = before.finite().or(start.finite().not());
            let with_after = after.finite().or(end.finite().not());
            let mut rise = R::select(with_before, from - before, start);
            let mut fall = R::select(with_after, to - after, -end);
            if !settled {
                // Beyond the peak there may be another gap, less deep: its own rate shows that too.
                rise = R::select(rise.lt(start), start, rise);
                fall = R::select(fall.lt(-end), -end, fall);
            }
            // An unknown square may have any value.
            let unknown = start.finite().and(end.finite()).not();
            let both = R::ZERO.lt(rise).and(R::ZERO.lt(fall));
            let mut may_close = both.and((-from).lt(falls * rise)).and((-to).lt(falls * fall));
            let at = (to - from - end) / (start - end);
            let peak = from + start * at;
            let is_peak = R::ZERO.lt(start).and(end.lt(R::ZERO));
            let between = R::ZERO.le(at).and(at.le(R::ONE));
            let top = from.max(to);
            let below = (peak + R::splat(MAX_PEAKS) * (peak - top)).lt(R::ZERO);
            if settled {
                may_close = may_close.and(is_peak.and(between).and(below).not());
            } else {
                may_close = may_close.or(unknown);
            }
            cells |= may_close.bits() << first;
        }
        cells
    }

    /// Whether the dyad has a dead point in the cell before a knot.
    pub(in crate::branch) fn has_dead_point(&self, knot: usize) -> bool {
        let [before, after] = [knot - 1, knot].map(|at| has(self.closes, at));
        has(self.known, knot - 1) && has(self.known, knot) && before != after
    }

    /// The square at a knot, and its rate.
    pub(in crate::branch) fn at(&self, knot: usize) -> [f64; 2] {
        [self.square[BEFORE + knot], self.rate[BEFORE + knot]]
    }

    /// The expected change of a later dyad's square from the last closed knot to this dyad's dead point
    /// in the cell before `knot`, relative to its change over the cell before that. The square varies
    /// as the square root of the distance from the dead point. `None` without a dead point.
    pub(in crate::branch) fn change_to_dead_point(&self, knot: usize) -> Option<f64> {
        if !self.has_dead_point(knot) {
            return None;
        }
        let before = has(self.closes, knot - 1);
        let [from, to] = [knot - 1, knot].map(|at| self.square[BEFORE + at]);
        let near = if before { from } else { to };
        // Distance of the root of a straight line, in cells, with a margin.
        let part = (1.5 * near / (from - to).abs() + 0.05).min(1.0);
        Some(part.sqrt() / ((part + 1.0).sqrt() - part.sqrt()))
    }

    /// Whether the discriminant stays away from zero from the last knot before a dead point of an
    /// earlier dyad (in the cell before `knot`) up to that point; `change`: see
    /// [`Self::change_to_dead_point`].
    pub(in crate::branch) fn stays_away(&self, knot: usize, change: f64) -> bool {
        let known = |at: usize| has(self.known, at);
        // The two knots before the dead point; the farther one may be outside this scan.
        let (near, far) = match (known(knot - 1), known(knot)) {
            (true, false) => (knot - 1, knot.checked_sub(2)),
            (false, true) => (knot, Some(knot + 1)),
            _ => return true,
        };
        // A dyad that does not close here is in its own gap.
        !has(self.closes, near)
            || far.is_some_and(|far| {
                let is_closed = far < Bits::BITS as usize && has(self.closes, far);
                let [near, far] = [near, far].map(|at| self.square[BEFORE + at]);
                is_closed && (near - far).abs() * (CHANGE_MARGIN * change) < near
            })
    }
}
