//! The exact motion of the slider-crank.

use super::jet::Jet;
use crate::math::trig::asin;

/// cos δ, from sin δ = λ sin φ.
pub(crate) fn rod_cosine(sine: Jet, lambda: f64) -> Jet {
    let tilt = sine.scale(lambda);
    (Jet::constant(1.0) - tilt * tilt).sqrt()
}

/// Stroke per crank length and its analogues: 1 − cos φ + k (1 − cos δ) (2021, equations 4 and
/// 10), written as 1 − cos φ + λ sin²φ / (1 + cos δ), which does not cancel near the dead point.
#[must_use]
pub fn stroke(phi: f64, lambda: f64) -> Jet {
    let (sine, _) = Jet::sin_cos(phi);
    let two_u = Jet::constant(1.0) + rod_cosine(sine, lambda);
    Jet::versine(phi) + (sine * sine).scale(lambda) / two_u
}

/// Angle of the rod from the slider's axis, φ₂ = −δ, and its analogues (equations 33 and 39).
#[must_use]
pub fn rod_angle(phi: f64, lambda: f64) -> Jet {
    let (sine, cosine) = Jet::sin_cos(phi);
    let root = rod_cosine(sine, lambda);
    // δ′ = λ cos φ / cos δ.
    let rate = cosine.scale(-lambda) / root;
    Jet([-asin(lambda * sine.0[0]), rate.0[0], rate.0[1]])
}

/// Position of a point of the rod per crank length, and its analogues. The point is `along` the rod
/// from the crank pin and `across` to its left, both per crank length (equations 30, with x along
/// the slider's axis).
#[must_use]
pub fn rod_point(phi: f64, lambda: f64, along: f64, across: f64) -> [Jet; 2] {
    let (sine, cosine) = Jet::sin_cos(phi);
    let root = rod_cosine(sine, lambda);
    let down = sine.scale(-lambda);
    [cosine + root.scale(along) - down.scale(across), sine + down.scale(along) + root.scale(across)]
}
