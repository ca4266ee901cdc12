//! The test whether a cell between two knots must be halved: to count turns, to find the edge of a gap, or
//! because an island may hide in it.

use super::knot::{Knot, may_vanish};
use crate::math::tolerance::KNOT_MAX_TURN;

/// Halvings at an end of an interval that can be reached: the turn left there varies as the square
/// root of the cell.
const EDGE_HALVINGS: u32 = 14;
/// Greatest rate (of the size, per unit of the path) at which the gap of a dyad that does not close may
/// shrink, unless other data show a faster motion.
const MAX_GAP_RATE: f64 = 8.0;
/// A negative square stays below zero in a cell if it is below zero by this many times its rise over it.
const MAX_FALLS: f64 = 4.0;
/// Halvings in search of an island: down to the 16 000th part of a cell.
const ISLAND_HALVINGS: u32 = 14;
/// Whether a cell must be halved, after `depth` halvings.
pub(super) fn must_refine(a: &Knot, b: &Knot, depth: u32) -> bool {
    if a.reached != b.reached {
        return depth < EDGE_HALVINGS;
    }
    let cell = (b.at - a.at).abs();
    if !a.reached {
        return may_hide_island(a, b, cell, depth);
    }
    let turned = a.angles.iter().zip(&b.angles).any(|(x, y)| (x - y).abs() > KNOT_MAX_TURN);
    // Near a dead point rates grow without bound, but the angle does not.
    let fast = depth < EDGE_HALVINGS
        && a.rates.iter().chain(&b.rates).any(|rate| rate * cell > KNOT_MAX_TURN);
    let through_infinity = depth < EDGE_HALVINGS && a.guide_sides != b.guide_sides;
    // Beside a near miss of a change point a link may turn round between the knots.
    let missed = || {
        a.discriminants.iter().zip(&b.discriminants).any(|(&x, &y)| may_vanish(x, y, b.at - a.at))
    };
    turned || fast || through_infinity || missed()
}

/// Whether an island may lie between two knots that cannot be reached.
fn may_hide_island(a: &Knot, b: &Knot, cell: f64, depth: u32) -> bool {
    // Where different dyads do not close, the later one may move fast: its chord is not bounded by the
    // driver's speed.
    let may_close = match (a.open_step, b.open_step) {
        (Some((i, g)), Some((j, h))) if i == j => {
            a.open_side != b.open_side
                || a.guide_sides != b.guide_sides
                || g + h < MAX_GAP_RATE * cell
                || may_peak(a, b)
        }
        _ => true,
    };
    may_close && depth < ISLAND_HALVINGS
}

/// Whether the square of a dyad that closes at neither knot rises so fast that it might become positive
/// between them.
fn may_peak(a: &Knot, b: &Knot) -> bool {
    let (Some((from, start)), Some((to, end))) = (a.open_square, b.open_square) else {
        return false;
    };
    let cell = b.at - a.at;
    let (rise, fall) = (start * cell, -end * cell);
    // One tangent alone counts if it crosses zero: the other end may be beside a point at infinity.
    -from < MAX_FALLS * rise && -to < MAX_FALLS * fall || -from < rise || -to < fall
}
