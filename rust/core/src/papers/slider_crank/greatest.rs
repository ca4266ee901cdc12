//! Where the slider is fastest, and where its acceleration is greatest.

use std::f64::consts::PI;

use super::exact::stroke;
use super::jet::Jet;
use super::series::{Series, SlowSeries};
use crate::math::trig::atan2;

/// An extreme value and where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Greatest {
    /// Crank angle from the outer dead point, rad.
    pub at: f64,
    /// The value there.
    pub value: f64,
}

/// Greatest speed per crank length and speed of the crank: x = sin²φ is the root in (0, 1) of
/// x³ − k²x² − k⁴x + k⁴ = 0 (the second analogue set to 0, and squared).
#[must_use]
pub fn greatest_speed(k: f64) -> Greatest {
    // Divided by k⁴: l²x³ − lx² − x + 1 with l = 1/k² falls from 1 to l² − l < 0.
    let l = 1.0 / (k * k);
    let cubic = |x: f64| ((l * x - 1.0) * l * x - 1.0) * x + 1.0;
    let (mut low, mut high) = (0.0, 1.0);
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if cubic(middle) > 0.0 { low = middle } else { high = middle }
    }
    // Of φ = asin √x, near a right angle by its complement.
    let at = atan2(high.sqrt(), (1.0 - high).sqrt());
    Greatest { at, value: stroke(at, 1.0 / k).0[1] }
}

/// The same of the series' first three terms, A0, A1, A2 with one term each:
/// cos φ = (−k + √(k² + 8)) / 4, with the speed by the same terms.
///
/// # Errors
///
/// None for one term of each coefficient.
pub fn greatest_speed_by_series(k: f64) -> Result<Greatest, SlowSeries> {
    // As 2 / (k + √(k² + 8)): nothing cancels.
    let at = libm::acos(2.0 / (k + (k * k + 8.0).sqrt()));
    Ok(Greatest { at, value: Series::new(k, 2, Some(1))?.stroke(at).0[1] })
}

/// The most negative acceleration per crank length and speed of the crank squared: at the inner
/// dead point from k = (3 + √21)/2 on, before and behind it for shorter rods (before it is given).
#[must_use]
pub fn greatest_acceleration(k: f64) -> Greatest {
    let lambda = 1.0 / k;
    if k >= 0.5 * (3.0 + 21.0_f64.sqrt()) {
        return Greatest { at: PI, value: stroke(PI, lambda).0[2] };
    }
    let (at, value) = maximum(0.5 * PI, PI, &|phi| -stroke(phi, lambda).0[2]);
    Greatest { at, value: -value }
}

/// The greatest value of a function that rises and then falls, by the golden section, then by a
/// parabola through three places around it.
pub(crate) fn maximum(low: f64, high: f64, of: &impl Fn(f64) -> f64) -> (f64, f64) {
    /// (√5 − 1)/2.
    const PART: f64 = 0.618_033_988_749_894_8;
    /// Below this width values no longer differ.
    const WIDTH: f64 = 1.0e-5;
    let (mut a, mut b) = (low, high);
    let (mut c, mut d) = (b - PART * (b - a), a + PART * (b - a));
    let (mut at_c, mut at_d) = (of(c), of(d));
    while b - a > WIDTH {
        if at_c > at_d {
            (b, d, at_d) = (d, c, at_c);
            c = b - PART * (b - a);
            at_c = of(c);
        } else {
            (a, c, at_c) = (c, d, at_d);
            d = a + PART * (b - a);
            at_d = of(d);
        }
    }
    let (middle, step) = (0.5 * (a + b), 1.0e-4_f64.min(0.25 * (high - low)));
    let [left, here, right] = [middle - step, middle, middle + step].map(of);
    let bend = left - 2.0 * here + right;
    let top = if bend < 0.0 { middle + 0.5 * step * (left - right) / bend } else { middle };
    let at = if top > low && top < high { top } else { middle };
    (at, of(at).max(of(middle)))
}

impl Jet {
    /// One of value, first and second derivative.
    #[must_use]
    pub fn order(self, order: usize) -> f64 {
        self.0[order]
    }
}
