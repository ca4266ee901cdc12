//! Knots of a branch: the stored data, and the prediction of each from the one before.

use std::f64::consts::TAU;

use crate::math::lanes::{Mask, Real};
use crate::plan::dyad::Unknown;

/// Greatest distance (rad, or of the size) of an unknown of a group from its Taylor prediction at the
/// knot before: other assemblies are farther, except beside a fold, beyond which the determinant has the
/// other sign.
pub(crate) const MAX_PREDICTION_ERROR: f64 = 1.0 / 32.0;

/// Greatest length (rad, or of the size) of the first Newton step, which corrects the first-order change:
/// other assemblies are farther.
pub(crate) const MAX_FIRST_STEP: f64 = 0.25;
/// The same for all later steps together.
pub(crate) const MAX_LATER_STEPS: f64 = MAX_PREDICTION_ERROR;

/// Greatest distance (rad, or of the size) of the unknowns of a group from their first values where the
/// branch closes: other assemblies are farther.
const MAX_RETURN_ERROR: f64 = 1.0e-6;

/// Where a branch begins.
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
    /// Unwrapped angle of every class; if not reached, that of the last reached knot.
    pub angles: Vec<f64>,
    /// Rate of every class along the path, without sign.
    pub rates: Vec<f64>,
    /// Discriminant of every dyad with a sign, and its rate along the path.
    pub discriminants: Vec<(f64, f64)>,
    /// For every dyad of two guides that was solved, the sign of the angle between these. Where it changes the guides
    /// are parallel, and the dyad's point passes through infinity.
    pub guide_sides: Vec<bool>,
    /// If not reached: the step that does not close, and its gap.
    pub open_step: Option<(usize, f64)>,
    /// With one driver, the square of that dyad's discriminant (negative) and its rate along the path.
    pub open_square: Option<(f64, f64)>,
    /// The side on which that dyad is flat ([`State::flat_side`](crate::state::state::State::flat_side)).
    pub open_side: bool,
    /// Number of the plan's steps that were solved.
    pub solved: usize,
    /// Unknowns of the groups above class II, with which the next knot is predicted.
    pub taylor: Vec<Taylor2>,
    /// Whether each group's determinant is positive.
    pub det_signs: Vec<bool>,
}

/// An unknown of a group and its first two derivatives along the path (angles are unwrapped).
pub(crate) type Taylor2 = [f64; 3];

impl Knot {
    /// Whether a dyad is flat here, or its outer joints coincide.
    pub(crate) fn is_flat(&self) -> bool {
        let loose = self.open_step.is_some_and(|(_, gap)| gap == 0.0);
        loose || self.discriminants.iter().any(|(_, rate)| rate.is_nan())
    }
}

/// Signs on an interval of the path that begins at `from`.
#[derive(Debug, Clone, Default)]
pub(crate) struct SignInterval {
    pub from: f64,
    pub signs: Vec<f64>,
}

/// A change point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ChangePoint {
    /// The parameter.
    pub at: f64,
    /// Index of the sign that changes.
    pub sign: usize,
}

/// A cell is searched if the discriminant at both ends is less than this many times its fall over the
/// cell. With a change point in the cell the ratio is at most 1, as long as the discriminant is about
/// straight.
const MAX_FALLS: f64 = 4.0;

/// Whether a discriminant may vanish between two knots, given its value and rate at both (`cell`: the
/// step, negative if backward).
#[inline(always)]
pub(crate) fn may_vanish<R: Real>((from, fall): (R, R), (to, rise): (R, R), cell: R) -> R::Mask {
    // |N| falls at one end and rises at the other, both fast enough.
    let fall = -(R::ONE.copysign(from) * fall * cell);
    let rise = R::ONE.copysign(to) * rise * cell;
    let same_side = R::ZERO.lt(from * to);
    let fast = |size: R, rate: R| size.abs().lt(R::splat(MAX_FALLS) * rate);
    R::ZERO.lt(fall).and(R::ZERO.lt(rise)).and(same_side).and(fast(from, fall)).and(fast(to, rise))
}

/// A square stays positive in a cell if at an end it exceeds this many times its fall at that rate. A
/// square that touches zero in the cell is at most half its fall.
const MAX_SQUARE_FALLS: f64 = 2.0;

/// Whether a square that is positive at two knots may touch zero between them: it falls at one and
/// rises at the other, both fast enough.
#[inline(always)]
pub(crate) fn may_touch<R: Real>((from, fall): (R, R), (to, rise): (R, R), cell: R) -> R::Mask {
    let falls = R::splat(MAX_SQUARE_FALLS) * cell;
    from.lt(-(falls * fall)).and(to.lt(falls * rise))
}

/// Taylor polynomial of second degree.
#[inline(always)]
pub(crate) fn predict<R: Real>([value, rate, second]: &[R; 3], step: f64) -> R {
    *value + R::splat(step) * (*rate + R::splat(0.5 * step) * *second)
}

/// Distance of an unknown, one cell on, from its prediction; also backward, so that the polynomial
/// between both is valid.
#[inline(always)]
pub(crate) fn prediction_error<R: Real>(a: &[R; 3], b: &[R; 3], cell: f64) -> R {
    let ahead = (predict(a, cell) - b[0]).abs();
    let back = (predict(b, -cell) - a[0]).abs();
    // NaN must count as far.
    let is_finite = ahead.finite().and(back.finite());
    R::select(is_finite, ahead.max(back), R::splat(f64::INFINITY))
}

/// Whether an unknown, one cell on, may have left its branch.
#[inline(always)]
pub(crate) fn prediction_failed<R: Real>(a: &[R; 3], b: &[R; 3], cell: f64) -> R::Mask {
    R::splat(MAX_PREDICTION_ERROR).lt(prediction_error(a, b, cell))
}

/// Whether an unknown with these values is the same again after some turns.
pub(crate) fn closes(unknown: Unknown, a: f64, b: f64) -> bool {
    let difference = match unknown {
        Unknown::Class(_) => (b - a) - TAU * ((b - a) / TAU).round(),
        Unknown::Slide(_) => b - a,
    };
    difference.abs() <= MAX_RETURN_ERROR
}
