//! Angles and whole turns.

use std::f64::consts::{PI, TAU};

use super::lanes::Real;

/// Slightly less than half a turn, so that [`turns_between`] does not switch at exact half turns.
const ABOUT_HALF: f64 = 0.5 - 1.0 / 1024.0;

/// Number of whole turns to add to `angle` to come nearest to `near`. About half a turn away (a
/// link that points to where a joint went through infinity) the sum is clockwise of `near` for any
/// rounding errors.
#[inline(always)]
pub(crate) fn turns_between<R: Real>(angle: R, near: R) -> R {
    ((near - angle) * R::splat(1.0 / TAU) + R::splat(ABOUT_HALF)).floor()
}

/// The angle that differs from `angle` by whole turns and is nearest to `near`.
#[inline(always)]
pub(crate) fn unwrap_to<R: Real>(angle: R, near: R) -> R {
    angle + R::splat(TAU) * turns_between(angle, near)
}

/// Whether an error of `slack` (rad) decides which way is the shorter, if [`unwrap_to`] takes the step.
#[inline(always)]
pub(crate) fn is_tie(step: f64, slack: f64) -> bool {
    let most = TAU * ABOUT_HALF;
    step + slack > most || step - slack < most - TAU
}

/// The same for the step that remains of a change after [`whole_turns`].
#[inline(always)]
pub(crate) fn is_tie_over_period(change: f64, slack: f64) -> bool {
    is_tie((TAU * whole_turns(change) - change) * change.signum(), slack)
}

/// How to unwrap all angles of a link without tracing them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Reference {
    /// All are principal values.
    Principal,
    /// All are less than half a turn from this angle.
    Near(f64),
    /// All are less than half a turn from an angle that turns with the driver.
    Turning(TurningAngle),
}

/// Greatest driver coordinate (rad) at which [`TurningAngle`] is safe: its rounding is below 1e-3 rad.
/// Beyond it, whole turns must be subtracted exactly.
pub(crate) const MAX_TURNED: f64 = (1_u64 << 40) as f64;

/// An angle that turns with the driver and jumps twice a turn, at gaps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TurningAngle {
    /// 1, or −1 if it turns against the driver.
    pub(crate) rate: f64,
    /// The angle where the driver is at 0, without jumps.
    pub(crate) at_zero: f64,
    /// The driver coordinate at which its turns begin.
    pub(crate) from: f64,
    /// The jump in the middle of a turn, and the sum of both jumps.
    pub(crate) jumps: [f64; 2],
}

impl TurningAngle {
    #[inline(always)]
    pub(crate) fn at<R: Real>(&self, q: R) -> R {
        let on = q - R::splat(self.from);
        let turns = (on * R::splat(1.0 / TAU)).floor();
        let is_second = R::splat(PI).lt(on - turns * R::splat(TAU));
        let jump = R::select(is_second, R::splat(self.jumps[0]), R::ZERO);
        (R::splat(self.rate) * q + R::splat(self.at_zero))
            + (jump + turns * R::splat(self.jumps[1]))
    }
}

impl Reference {
    /// Unwraps a principal value at driver coordinate `q`.
    #[inline(always)]
    pub(crate) fn lift<R: Real>(self, angle: R, q: R) -> R {
        match self {
            // As if zero turns were added: −0 becomes 0.
            Self::Principal => angle + R::ZERO,
            Self::Near(near) => {
                // A principal value gets one of two numbers of turns.
                let [at_low, at_high] = [-PI, PI].map(|angle| turns_between(angle, near));
                let last = near + TAU * (ABOUT_HALF - at_low);
                let is_low = angle.le(R::splat(last));
                angle + R::select(is_low, R::splat(TAU * at_low), R::splat(TAU * at_high))
            }
            Self::Turning(turning) => unwrap_to(angle, turning.at(q)),
        }
    }
}

/// Whole turns in the change of an angle over a period, to the nearest. An angle may change by exactly half
/// a turn, from one dead point to another: that counts as 0 for any rounding errors.
pub(crate) fn whole_turns(change: f64) -> f64 {
    (change.abs() * (1.0 / TAU) + ABOUT_HALF).floor().copysign(change)
}

/// Subtracts whole turns from an angle, accurate to the last bit for fewer than 2^48 turns: 2π is
/// in parts whose products with the two halves of `turns` are exact (Cody & Waite 1980).
pub(crate) fn reduce_turns(angle: f64, turns: f64) -> f64 {
    /// Splits the turns in two, at 2^22.
    const SPLIT: f64 = 4194304.0;
    /// The first 26 bits of 2π, the next 27, and the rest.
    const PARTS: [f64; 3] = [6.283185243606567, 6.357301884918343e-8, 2.4492935982947064e-16];
    let high = (turns / SPLIT).trunc() * SPLIT;
    let low = turns - high;
    let rest = angle - high * PARTS[0] - high * PARTS[1] - low * PARTS[0] - low * PARTS[1];
    rest - turns * PARTS[2]
}

/// Integer part of a cell number. Numbers up to −1 give a very large index, NaN gives 0.
#[inline(always)]
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "that is meant")]
pub(crate) fn whole_part(cells: f64) -> usize {
    cells as i32 as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_turn_counts_as_none() {
        for (turns, whole) in [(0.5, 0.0), (0.500_001, 0.0), (0.51, 1.0), (1.2, 1.0), (2.0, 2.0)] {
            assert_eq!([turns * TAU, -turns * TAU].map(whole_turns), [whole, -whole], "{turns}");
        }
    }

    /// For any rounding errors, whichever of both is the greater.
    #[test]
    fn half_a_turn_is_clockwise() {
        for near in [0.0, 1.0, -40.0] {
            for (turn, nearest) in [(0.5, -0.5), (0.500_1, -0.499_9), (0.49, 0.49), (1.2, 0.2)] {
                for (turn, nearest) in [(turn, nearest), (turn - 3.0, nearest)] {
                    let actual = unwrap_to(near + TAU * turn, near);
                    assert!((actual - (near + TAU * nearest)).abs() < 1e-12, "{near} {turn}");
                }
            }
            assert!((unwrap_to(near - TAU * 0.499_9, near) - (near - TAU * 0.499_9)).abs() < 1e-12);
        }
    }

    /// Removing whole turns leaves the angle, to the rounding of the sum itself.
    #[test]
    fn reducing_turns_restores_the_angle() {
        for turns in [1.0, 2.0, 64.0, 1000.0, 4_194_303.0, 4_194_304.0, 1e9] {
            for part in [0.001, 0.735_422_665_253_286_5, 3.0, 6.2] {
                for turns in [turns, -turns] {
                    let angle = part + TAU * turns;
                    // 2π as a double, and its error.
                    let lost = (angle - TAU * turns) - part;
                    let expected = part + lost - turns * 2.449_293_598_294_706_4e-16;
                    let rounding = 2.0 * f64::EPSILON * angle.abs().max(TAU);
                    let actual = reduce_turns(angle, turns);
                    assert!(
                        (actual - expected).abs() <= rounding,
                        "{turns} {part}: {actual} {expected}"
                    );
                }
            }
        }
    }

    /// Also backward: a small angle less −1 turn is the sum, rounded once or twice.
    #[test]
    fn small_angles_keep_their_digits() {
        for angle in [-0.735_422_665_253_286_5, -1e-9, 0.1, 3.0] {
            let actual = reduce_turns(angle, -1.0);
            assert!(
                (actual - (angle + TAU)).abs() <= 2.0 * f64::EPSILON * TAU,
                "{angle}: {actual}"
            );
        }
    }
}
