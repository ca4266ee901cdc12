//! Angles and whole turns.

use std::f64::consts::TAU;

use super::lanes::Real;

/// Half a turn, less what keeps the choice of [`turns_between`] off exact half turns.
const ABOUT_HALF: f64 = 0.5 - 1.0 / 1024.0;

/// Whole turns from `angle` to what is nearest to `near`; about half a turn off (a link that
/// points to where a joint went through infinity) to the one ahead, whatever the rounding.
#[inline(always)]
pub(crate) fn turns_between<R: Real>(angle: R, near: R) -> R {
    ((near - angle) * R::splat(1.0 / TAU) + R::splat(ABOUT_HALF)).floor()
}

/// The angle that differs from `angle` by whole turns and is nearest to `near`.
#[inline(always)]
pub(crate) fn nearest<R: Real>(angle: R, near: R) -> R {
    angle + R::splat(TAU) * turns_between(angle, near)
}

/// An angle less whole turns, to the last bit as long as the turns are below 2^48: 2π in
/// parts whose products with the two halves of `turns` are exact (Cody & Waite 1980).
pub(crate) fn less_turns(angle: f64, turns: f64) -> f64 {
    /// Where the turns are cut in two, 2^22.
    const CUT: f64 = 4194304.0;
    /// The first 26 bits of 2π, the next 27, and the rest.
    const PARTS: [f64; 3] = [6.283185243606567, 6.357301884918343e-8, 2.4492935982947064e-16];
    let high = (turns / CUT).trunc() * CUT;
    let low = turns - high;
    let rest = angle - high * PARTS[0] - high * PARTS[1] - low * PARTS[0] - low * PARTS[1];
    rest - turns * PARTS[2]
}

/// The whole part of a number of cells; what is no cell becomes a great number or 0.
#[inline(always)]
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "that is meant")]
pub(crate) fn whole_part(cells: f64) -> usize {
    cells as i32 as usize
}
