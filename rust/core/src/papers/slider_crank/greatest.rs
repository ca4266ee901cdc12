//! Greatest speed and acceleration of the slider.

use std::convert::Infallible;
use std::f64::consts::PI;

use super::exact::stroke;
use super::jet::Jet;
use super::series::{Series, SeriesError};
use crate::math::root::bisection::{TO_ROUNDING, bisect};
use crate::math::root::golden_section::{Bracket, golden_section};
use crate::math::trig::atan2;

/// An extreme value and its crank angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Greatest {
    /// Crank angle from the outer dead point, rad.
    pub at: f64,
    /// The value there.
    pub value: f64,
}

/// Greatest speed per crank length and crank speed. x = sin²φ is the root in (0, 1) of
/// x³ − k²x² − k⁴x + k⁴ = 0, the squared condition that the second analogue is zero.
#[must_use]
pub fn greatest_speed(k: f64) -> Greatest {
    // Divided by k⁴: l²x³ − lx² − x + 1 with l = 1/k² falls from 1 to l² − l < 0.
    let l = 1.0 / (k * k);
    let cubic = |x: f64| ((l * x - 1.0) * l * x - 1.0) * x + 1.0;
    let Ok([_, x]) = bisect([0.0, 1.0], TO_ROUNDING, |x| Ok::<_, Infallible>(cubic(x) > 0.0));
    // φ = asin √x, in a form that is accurate near a right angle too.
    let at = atan2(x.sqrt(), (1.0 - x).sqrt());
    Greatest { at, value: stroke(at, 1.0 / k).0[1] }
}

/// The same from the series A0, A1, A2 with one term each: cos φ = (−k + √(k² + 8)) / 4, and the
/// speed from the same terms.
///
/// # Errors
///
/// [`SeriesError`] by its type; one term per coefficient never fails.
pub fn greatest_speed_by_series(k: f64) -> Result<Greatest, SeriesError> {
    // Written as 2 / (k + √(k² + 8)) to avoid cancellation.
    let at = libm::acos(2.0 / (k + (k * k + 8.0).sqrt()));
    Ok(Greatest { at, value: Series::new(k, 2, Some(1))?.stroke(at).0[1] })
}

/// Most negative acceleration per crank length and squared crank speed. For k ≥ (3 + √21)/2 it is
/// at the inner dead point; for shorter rods before and after it, and this returns the one before.
#[must_use]
pub fn greatest_acceleration(k: f64) -> Greatest {
    let lambda = 1.0 / k;
    if k >= 0.5 * (3.0 + 21.0_f64.sqrt()) {
        return Greatest { at: PI, value: stroke(PI, lambda).0[2] };
    }
    let (at, value) = maximum(0.5 * PI, PI, &|phi| -stroke(phi, lambda).0[2]);
    Greatest { at, value: -value }
}

/// Maximum of a function that rises and then falls: its location by golden section and a parabola
/// through three points, and its value.
pub(crate) fn maximum(low: f64, high: f64, f: &impl Fn(f64) -> f64) -> (f64, f64) {
    /// Below this width rounding hides the differences of the values.
    const WIDTH: f64 = 1.0e-5;
    let is_narrow = |bracket: &Bracket| bracket.width() <= WIDTH;
    let Ok(bracket) = golden_section([low, high], is_narrow, |x| Ok::<_, Infallible>(f(x)));
    let [a, b] = bracket.ends;
    let (middle, step) = (0.5 * (a + b), 1.0e-4_f64.min(0.25 * (high - low)));
    let [left, center, right] = [middle - step, middle, middle + step].map(f);
    let curvature = left - 2.0 * center + right;
    let vertex =
        if curvature < 0.0 { middle + 0.5 * step * (left - right) / curvature } else { middle };
    let at = if vertex > low && vertex < high { vertex } else { middle };
    (at, f(at).max(f(middle)))
}

impl Jet {
    /// The derivative of an order from 0 to 2.
    #[must_use]
    pub fn order(self, order: usize) -> f64 {
        self.0[order]
    }
}
