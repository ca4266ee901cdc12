//! Whether the signs of a design are the same at all coordinates of a driven angle, whether or not
//! it turns fully.
//!
//! Signs change at change points alone, and a generic design has none. This is shown from knots
//! solved side by side: between two of them the discriminant of every dyad stays away from zero.
//! Only cells where it may not are looked at again, with knots of their own. A design that still
//! may have a change point is left to the tracer.

use super::knot::may_vanish;
use super::uniform::{CELL, KNOTS, UniformTracer};
use crate::math::lanes::{Mask, Real};
use crate::math::vector::Vector;
use crate::plan::dyad::{Dyad, Form};
use crate::state::kernel::Level;
use crate::state::state::Context;

/// Cells between the knots of one look.
const CELLS: f64 = (KNOTS - 1) as f64;
/// Looks at one cell, each [`CELLS`] times as close: down to the 30 000th part of it.
const MAX_DEPTH: u32 = 3;
/// Looks at one design.
const MAX_LOOKS: usize = 32;
/// A discriminant that differs from the trapezoidal rule by this part of itself varies too fast to
/// be judged by its ends.
const MAX_CURVATURE: f64 = 0.5;
/// How many times its fall between two knots a margin must be away from zero.
const MAX_FALLS: f64 = 4.0;
/// How many times its change over the last cell before a dead point the discriminant of a later
/// dyad must be away from zero: it varies as the square root of the distance there.
const MAX_CHANGES: f64 = 8.0;

/// What a dyad shows at the knots. The first entry belongs to the knot before the first, the last
/// to the one after the last; neither is known.
#[derive(Debug, Clone)]
pub(crate) struct DyadSamples {
    /// Discriminant and its derivative.
    value: [f64; KNOTS + 2],
    rate: [f64; KNOTS + 2],
    /// By how much it closes; −∞ where a dyad before it does not.
    margin: [f64; KNOTS + 2],
    /// The least margin of the dyads before it.
    upstream: [f64; KNOTS + 2],
}

impl DyadSamples {
    const NONE: Self = Self {
        value: [0.0; KNOTS + 2],
        rate: [0.0; KNOTS + 2],
        margin: [f64::NEG_INFINITY; KNOTS + 2],
        upstream: [f64::NEG_INFINITY; KNOTS + 2],
    };

    /// Whether the dyad and all before it close at a knot (counted from 1).
    fn closes_at(&self, knot: usize) -> bool {
        self.upstream[knot] > 0.0 && self.margin[knot] > 0.0
    }
}

/// A cell to be looked at.
type Look = (f64, f64, u32);

/// Work space, kept from one design to the next.
#[derive(Debug, Default)]
pub(crate) struct SignCheck {
    samples: Vec<DyadSamples>,
    looks: Vec<Look>,
}

impl<R: Real, const G: usize> UniformTracer<R, G> {
    /// Whether the signs at the drawing hold at all coordinates. The knots of a whole turn must have
    /// been solved.
    #[inline(always)]
    pub(crate) fn keeps_signs<L: Level<Register = R>>(
        &mut self,
        cx: &Context<'_>,
        check: &mut SignCheck,
    ) -> bool {
        check.looks.clear();
        if !self.look(cx, check, (self.knots[0].0.lane(0), CELL, 0)) {
            return false;
        }
        for _ in 0..MAX_LOOKS {
            let Some((from, width, depth)) = check.looks.pop() else { return true };
            for group in 0..G {
                let at =
                    R::from_lanes(|lane| from + width * ((group * R::LANES + lane) as f64 / CELLS));
                self.state.q[0][group] = at;
                self.state.unit[0][group] = Vector::at_angle(at);
            }
            L::solve(&mut self.state, cx);
            if !self.look(cx, check, (from, width / CELLS, depth)) {
                return false;
            }
        }
        false
    }

    /// Judges the cells between the knots just solved and notes those that need a closer look; false
    /// if a sign may change.
    #[inline(always)]
    fn look(&self, cx: &Context<'_>, check: &mut SignCheck, (from, cell, depth): Look) -> bool {
        for group in 0..G {
            let unclear = self.state.needs_scalar[group].and(self.state.open[group].not());
            if unclear.any() {
                return false;
            }
        }
        let mut count = 0;
        let mut last_signed = 0;
        for (index, dyad) in cx.plan.dyads().enumerate() {
            if check.samples.len() == index {
                check.samples.push(DyadSamples::NONE);
            }
            let (before, own) = check.samples.split_at_mut(index);
            self.sample(cx, dyad, before.last(), &mut own[0]);
            if dyad.sign.is_some() {
                last_signed = index;
            }
            count += 1;
        }
        for index in 0..count {
            for group in 0..G {
                let [vanishing, dead_point] =
                    cells_to_look_at::<R>(&check.samples[index], group * R::LANES, cell);
                let flagged =
                    if index < last_signed { vanishing.or(dead_point) } else { vanishing };
                if !flagged.any() {
                    continue;
                }
                for lane in 0..R::LANES {
                    let knot = group * R::LANES + lane;
                    let end = vanishing.lane(lane);
                    let beyond = index < last_signed && dead_point.lane(lane);
                    let mut later = check.samples[..=last_signed].iter().skip(index + 1);
                    let close_enough = depth > 0 && later.all(|dyad| stays_away(dyad, knot));
                    if end && depth == MAX_DEPTH {
                        return false;
                    }
                    if end || beyond && depth < MAX_DEPTH && !close_enough {
                        let start = from + cell * (knot - 1) as f64;
                        check.looks.push((start, cell, depth + 1));
                    }
                }
            }
        }
        true
    }

    /// Stores what a dyad shows at the knots.
    #[inline(always)]
    fn sample(
        &self,
        cx: &Context<'_>,
        dyad: &Dyad,
        before: Option<&DyadSamples>,
        samples: &mut DyadSamples,
    ) {
        for group in 0..G {
            let (value, rate) = match (dyad.sign, dyad.form) {
                (Some(_), _) => self.state.discriminant(group, cx, dyad, 1),
                (None, Form::TwoLines) => (self.state.determinant(group, cx, dyad), R::ZERO),
                (None, _) => (R::ONE, R::ZERO),
            };
            let margin = self.state.margin[dyad.index][group];
            for lane in 0..R::LANES {
                let knot = 1 + group * R::LANES + lane;
                let upstream = match before {
                    Some(before) => before.upstream[knot].min(before.margin[knot]),
                    None => f64::INFINITY,
                };
                samples.value[knot] = value.lane(lane);
                samples.rate[knot] = rate.lane(lane);
                samples.upstream[knot] = upstream;
                samples.margin[knot] =
                    if upstream > 0.0 { margin.lane(lane) } else { f64::NEG_INFINITY };
            }
        }
    }
}

/// Cells before a register of knots in which the discriminant may vanish or a stretch may hide that
/// closes; and those with a dead point.
#[inline(always)]
fn cells_to_look_at<R: Real>(samples: &DyadSamples, first: usize, cell: f64) -> [R::Mask; 2] {
    let cell = R::splat(cell);
    let here = &|numbers: &[f64; KNOTS + 2], shift: usize| -> R {
        let mut lanes = [0.0; 8];
        for lane in 0..R::LANES {
            lanes[lane] = numbers[(first + lane + shift).min(KNOTS + 1)];
        }
        R::from_lanes(|lane| lanes[lane])
    };
    let (n, dn) = (here(&samples.value, 1), here(&samples.rate, 1));
    let (n0, dn0) = (here(&samples.value, 0), here(&samples.rate, 0));
    let (m, m0) = (here(&samples.margin, 1), here(&samples.margin, 0));
    let after = here(&samples.margin, 2);
    let upstream = here(&samples.upstream, 1).min(here(&samples.upstream, 0));
    let alive = R::ZERO.lt(upstream);
    let (closes, closed) = (R::ZERO.lt(m), R::ZERO.lt(m0));
    // Both ends close.
    let curvature = (n - n0) - R::splat(0.5) * cell * (dn + dn0);
    let least = n.abs().min(n0.abs());
    let straight = curvature.abs().lt(R::splat(MAX_CURVATURE) * least);
    let same_side = R::ZERO.lt(n * n0);
    let vanishing = may_vanish((n0, dn0), (n, dn), cell).or(straight.not()).or(same_side.not());
    let inside = closes.and(closed).and(vanishing);
    // Neither closes: the margin would have to rise from both sides.
    let before = R::from_lanes(|lane| match (first + lane).checked_sub(1) {
        Some(knot) => samples.margin[knot],
        None => f64::NEG_INFINITY,
    });
    let rise = m0 - before;
    let fall = m - after;
    let falls = R::splat(MAX_FALLS);
    let may_close = R::ZERO
        .lt(rise)
        .and(R::ZERO.lt(fall))
        .and((-m0).lt(falls * rise))
        .and((-m).lt(falls * fall));
    let outside = closes.or(closed).not().and(may_close);
    let dead_point = closes.and(closed.not()).or(closed.and(closes.not()));
    [alive.and(inside.or(outside)), alive.and(dead_point)]
}

/// Whether the discriminant of a dyad stays away from zero from the last knot before a dead point of
/// an earlier one (in the cell before `knot`) up to that point.
fn stays_away(later: &DyadSamples, knot: usize) -> bool {
    // Knots are counted from 1 in the samples: the cell is between `knot` and `knot + 1`.
    let [near, far] =
        if later.upstream[knot] > 0.0 { [knot, knot - 1] } else { [knot + 1, knot + 2] };
    let change = later.value[near] - later.value[far];
    // If it does not close there, a gap of its own ends before the dead point.
    !later.closes_at(near)
        || later.closes_at(far) && change.abs() * MAX_CHANGES < later.value[near].abs()
}
