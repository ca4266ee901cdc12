//! Knots of a way: what is known at them, and how one follows from another.

use std::f64::consts::TAU;

use crate::math::lanes::{Mask, Real};
use crate::plan::dyad::Unknown;

/// How far (rad, or of the size) an unknown of a group may be from where its Taylor polynomial
/// at the knot before tells it: other assemblies are farther, except beside a fold, beyond which
/// the determinant has the other sign.
pub(crate) const MAX_PREDICTION_ERROR: f64 = 1.0 / 32.0;

/// How far (rad, or of the size) the first step of the iteration may go, which follows what
/// changes to the first order: other assemblies are farther.
pub(crate) const MAX_FIRST_STEP: f64 = 0.25;
/// And all others together.
pub(crate) const MAX_LATER_STEPS: f64 = MAX_PREDICTION_ERROR;

/// How near (rad, or of the size) the unknowns of a group must be to where they began to have
/// returned: other assemblies are farther.
const MAX_RETURN_ERROR: f64 = 1.0e-6;

/// Where a way begins.
#[derive(Debug, Clone, Copy)]
pub(crate) struct InitialGuess<'a> {
    /// Angles of the classes.
    pub angles: &'a [f64],
    /// Unknowns of the groups.
    pub taylor: &'a [Taylor2],
}

/// One point of the path.
#[derive(Debug, Clone)]
pub(crate) struct Knot {
    pub at: f64,
    pub reached: bool,
    /// Lifted angle of every class; where not reached, that of the last knot that was.
    pub angles: Vec<f64>,
    /// Rate of every class along the path.
    pub rates: Vec<f64>,
    /// Spread of every dyad with a sign, and its rate along the path.
    pub spread: Vec<(f64, f64)>,
    /// On which side of parallel the guides of every dyad of two known directions are;
    /// between the guide_sides its point passes through infinity.
    pub guide_sides: Vec<bool>,
    /// Where not reached: the step that does not close, and by how much.
    pub open_step: Option<(usize, f64)>,
    /// Steps of the plan that could be solved.
    pub solved: usize,
    /// Unknowns of the groups above class II, from which those of the next are told.
    pub taylor: Vec<Taylor2>,
    /// Signs of the groups' determinants.
    pub det_signs: Vec<bool>,
}

/// An unknown of a group and its first two derivatives along the path (angles are lifted).
pub(crate) type Taylor2 = [f64; 3];

impl Knot {
    /// Whether a dyad is flat here, or its outer joints coincide.
    pub(crate) fn is_flat(&self) -> bool {
        let loose = self.open_step.is_some_and(|(_, gap)| gap == 0.0);
        loose || self.spread.iter().any(|(_, rate)| rate.is_nan())
    }
}

/// Signs on one stretch of the path, from its beginning on.
#[derive(Debug, Clone, Default)]
pub(crate) struct SignInterval {
    pub from: f64,
    pub signs: Vec<f64>,
}

/// A change point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ChangePoint {
    /// Parameter.
    pub at: f64,
    /// The sign that changes.
    pub sign: usize,
}

/// How many times the fall over a whole cell the spread at its ends may be, and the
/// cell still be searched: at a change point within the cell it is at most once, as
/// long as the spread is about straight.
const MAX_FALLS: f64 = 4.0;

/// Whether a spread may touch 0 between two knots, given it and its rate there (`cell`:
/// the step, negative down the parameter).
#[inline(always)]
pub(crate) fn may_vanish<R: Real>((from, fall): (R, R), (to, rise): (R, R), cell: R) -> R::Mask {
    // |N| falls at the one end and rises at the other, and fast enough.
    let fall = -(R::ONE.copysign(from) * fall * cell);
    let rise = R::ONE.copysign(to) * rise * cell;
    let same_side = R::ZERO.lt(from * to);
    let fast = |size: R, rate: R| size.abs().lt(R::splat(MAX_FALLS) * rate);
    R::ZERO.lt(fall).and(R::ZERO.lt(rise)).and(same_side).and(fast(from, fall)).and(fast(to, rise))
}

/// Taylor's polynomial.
pub(crate) fn predict([value, rate, second]: &Taylor2, step: f64) -> f64 {
    value + step * (rate + 0.5 * step * second)
}

/// How far an unknown, a cell further, is from where the way leads: each end from the other, so that
/// the polynomial between them holds.
pub(crate) fn prediction_error(a: &Taylor2, b: &Taylor2, cell: f64) -> f64 {
    let ahead = (predict(a, cell) - b[0]).abs();
    let back = (predict(b, -cell) - a[0]).abs();
    // No number is far.
    if ahead.is_nan() || back.is_nan() { f64::INFINITY } else { ahead.max(back) }
}

/// Whether an unknown, a cell further, is not surely where the way leads.
pub(crate) fn prediction_failed(a: &Taylor2, b: &Taylor2, cell: f64) -> bool {
    prediction_error(a, b, cell) > MAX_PREDICTION_ERROR
}

/// Whether an unknown is, some turns on, what it was.
pub(crate) fn closes(unknown: Unknown, a: &Taylor2, b: &Taylor2) -> bool {
    let difference = match unknown {
        Unknown::Class(_) => (b[0] - a[0]) - TAU * ((b[0] - a[0]) / TAU).round(),
        Unknown::Slide(_) => b[0] - a[0],
    };
    difference.abs() <= MAX_RETURN_ERROR
}
