//! What may happen between two knots, from what the dyads show at them.
//!
//! Signs change at change points alone, and a generic design has none: between two knots the
//! discriminant of every dyad stays away from zero. Where it may not, and where a stretch may begin
//! or end that can be reached, the cell needs a closer look.

use super::knot::may_vanish;
use super::uniform::KNOTS;
use crate::math::lanes::{LANES, Mask, Real};
use crate::plan::dyad::Dyad;
use crate::state::dyad::sample::Sample;
use crate::state::state::{Context, State};

/// A discriminant that differs from the trapezoidal rule by this part of itself varies too fast to
/// be judged by its ends.
const MAX_CURVATURE: f64 = 0.5;
/// How many times its fall between two knots a margin must be away from zero.
const MAX_FALLS: f64 = 4.0;
/// How fast (of the size, per unit of the path) the margin of a dyad may vary that depends on more
/// than two points.
const MAX_GAP_RATE: f64 = 8.0;
/// How many times its change over the last cell before a dead point the discriminant of a later
/// dyad must be away from zero: it varies as the square root of the distance there.
const MAX_CHANGES: f64 = 8.0;

/// Margin below which a dyad counts as flat: it grows with the square of the distance from a change
/// point, so this is 1e-6 rad from one.
const FLAT_MARGIN: f64 = 1.0e-12;

/// Entries for every knot, those beside, and as many more as a register has.
const SAMPLES: usize = KNOTS + 2 + LANES;

/// What a dyad shows at the knots. The first entry belongs to the knot before the first, the last
/// to the one after the last; neither is known.
#[derive(Debug, Clone)]
pub(crate) struct DyadSamples {
    /// Discriminant and its derivative.
    value: [f64; SAMPLES],
    rate: [f64; SAMPLES],
    /// By how much it closes; −∞ where a dyad before it does not.
    margin: [f64; SAMPLES],
    /// The least margin of the dyads before it.
    upstream: [f64; SAMPLES],
    /// How fast the margin may vary, per unit of the path.
    speed: [f64; SAMPLES],
}

/// Cells before a register of knots.
pub(crate) struct Cells<M> {
    /// In which the discriminant may vanish, or an interval may hide that can be reached.
    pub uncertain: M,
    /// In which it varies too fast to be judged, as it does beside a dead point.
    pub curved: M,
    /// With a dead point.
    pub dead_point: M,
    /// Where neither end can be reached, but some position between them might.
    pub may_hide_island: M,
}

impl DyadSamples {
    pub(crate) const NONE: Self = Self {
        value: [0.0; SAMPLES],
        rate: [0.0; SAMPLES],
        margin: [f64::NEG_INFINITY; SAMPLES],
        upstream: [f64::NEG_INFINITY; SAMPLES],
        speed: [0.0; SAMPLES],
    };

    /// Takes what a dyad shows at a register of knots; `before`: the dyad solved before it. False if
    /// it is flat at one of them: whether its sign changes there cannot be seen.
    #[inline(always)]
    pub(crate) fn take<R: Real, const G: usize>(
        &mut self,
        state: &State<R, G>,
        group: usize,
        cx: &Context<'_>,
        dyad: &Dyad,
        before: Option<&Self>,
    ) -> bool {
        let Sample { value, rate, margin } =
            state.sample(group, cx, dyad, &cx.tape.ops[cx.tape.dyads[dyad.index]]);
        let first = 1 + group * R::LANES;
        let upstream = match before {
            Some(before) => lanes::<R>(&before.upstream, first).min(lanes(&before.margin, first)),
            None => R::splat(f64::INFINITY),
        };
        let known = R::ZERO.lt(upstream);
        let margin = R::select(known, margin, R::splat(f64::NEG_INFINITY));
        let definite = R::splat(FLAT_MARGIN).lt(margin.abs());
        let speed = if dyad.rrr_classes.is_some() {
            let [start, end] = [dyad.start * state.len + 1, dyad.end * state.len + 1];
            // Behind no other dyad, both points turn about fixed ones: their speed is constant.
            let factor = if before.is_none() { 1.0 } else { MAX_FALLS };
            R::splat(factor) * (state.points[end][group] - state.points[start][group]).norm()
        } else {
            R::splat(MAX_GAP_RATE)
        };
        for lane in 0..R::LANES {
            self.speed[first + lane] = speed.lane(lane);
            self.value[first + lane] = value.lane(lane);
            self.rate[first + lane] = rate.lane(lane);
            self.upstream[first + lane] = upstream.lane(lane);
            self.margin[first + lane] = margin.lane(lane);
        }
        !known.and(definite.not()).any()
    }

    /// Judges the cells (of width `cell`) before the register of knots that begins with `first`.
    #[inline(always)]
    pub(crate) fn judge<R: Real>(&self, first: usize, cell: f64) -> Cells<R::Mask> {
        let cell = R::splat(cell);
        let (n, dn) = (lanes::<R>(&self.value, first + 1), lanes::<R>(&self.rate, first + 1));
        let (n0, dn0) = (lanes::<R>(&self.value, first), lanes::<R>(&self.rate, first));
        let (m, m0) = (lanes::<R>(&self.margin, first + 1), lanes::<R>(&self.margin, first));
        let upstream = lanes::<R>(&self.upstream, first + 1).min(lanes(&self.upstream, first));
        let known = R::ZERO.lt(upstream);
        let speed = lanes::<R>(&self.speed, first + 1).max(lanes(&self.speed, first));
        let (closes, closed) = (R::ZERO.lt(m), R::ZERO.lt(m0));
        // Both ends close.
        let curvature = (n - n0) - R::splat(0.5) * cell * (dn + dn0);
        let least = n.abs().min(n0.abs());
        let straight = curvature.abs().lt(R::splat(MAX_CURVATURE) * least);
        let same_side = R::ZERO.lt(n * n0);
        let vanishing = may_vanish((n0, dn0), (n, dn), cell).or(same_side.not());
        // Neither closes: the margin would have to rise from both sides.
        let mut before = [f64::NEG_INFINITY; LANES];
        for lane in usize::from(first == 0)..R::LANES {
            before[lane] = self.margin[first + lane - 1];
        }
        let before = R::from_lanes(|lane| before[lane]);
        let (rise, fall) = (m0 - before, m - lanes::<R>(&self.margin, first + 2));
        let falls = R::splat(MAX_FALLS);
        let both = R::ZERO.lt(rise).and(R::ZERO.lt(fall));
        let may_close = both.and((-m0).lt(falls * rise)).and((-m).lt(falls * fall));
        let inside = closes.and(closed).and(vanishing);
        let outside = closes.or(closed).not().and(may_close);
        Cells {
            uncertain: known.and(inside.or(outside)),
            curved: known.and(closes).and(closed).and(straight.not()),
            dead_point: known.and(closes.or(closed)).and(closes.and(closed).not()),
            may_hide_island: known.and(closes.or(closed).not()).and((-m0 - m).lt(speed * cell)),
        }
    }

    /// Whether the discriminant stays away from zero from the last knot before a dead point of an
    /// earlier dyad (in the cell before `knot`) up to that point.
    pub(crate) fn stays_away(&self, knot: usize) -> bool {
        // The knot before and the knot itself, counted from 1 as the samples are.
        let [near, far] = match [knot, knot + 1].map(|at| self.upstream[at] > 0.0) {
            [true, false] => [knot, knot - 1],
            [false, true] => [knot + 1, knot + 2],
            _ => return true,
        };
        let closes = |at: usize| self.upstream[at] > 0.0 && self.margin[at] > 0.0;
        let change = self.value[near] - self.value[far];
        // If it does not close there, a gap of its own ends before the dead point.
        !closes(near) || closes(far) && change.abs() * MAX_CHANGES < self.value[near].abs()
    }
}

/// As many numbers as a register holds.
#[inline(always)]
fn lanes<R: Real>(numbers: &[f64; SAMPLES], first: usize) -> R {
    let some = &numbers[first..first + R::LANES];
    R::from_lanes(|lane| some[lane])
}
