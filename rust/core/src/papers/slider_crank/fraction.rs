//! The stroke without a square root, by a continued fraction.

use super::jet::Jet;

/// Stroke per crank length by approximant `n` (at least 1) of the fraction, with its own exact
/// derivatives: 1 − cos φ + λ sin²φ / (2 u), u = 1 − λ² sin²φ / (4 u) from u = 1 (2017,
/// equations 5, 7, 8 and on).
#[must_use]
pub fn stroke_by_fraction(phi: f64, lambda: f64, n: u32) -> Jet {
    let (sine, _) = Jet::sin_cos(phi);
    let square = sine * sine;
    let quarter = square.scale(0.25 * lambda * lambda);
    let mut u = Jet::constant(1.0);
    for _ in 1..n {
        let next = Jet::constant(1.0) - quarter / u;
        if next == u {
            break;
        }
        u = next;
    }
    Jet::versine(phi) + square.scale(0.5 * lambda) / u
}

/// Exact stroke minus the approximant, with derivatives and without cancellation: with
/// c = cos²(δ/2) and t = tan²(δ/2), the fraction's u is c (1 − tⁿ⁺¹)/(1 − tⁿ), so the difference is
/// λ sin²φ tⁿ (1 − t) / (2 c (1 − tⁿ⁺¹)).
pub(crate) fn approximation_error(phi: f64, lambda: f64, n: u32) -> Jet {
    let (sine, _) = Jet::sin_cos(phi);
    let one = Jet::constant(1.0);
    let root = super::exact::rod_cosine(sine, lambda);
    let two_c = one + root;
    // tan²(δ/2) = sin²δ / (1 + cos δ)².
    let half = sine.scale(lambda) / two_c;
    let t = half * half;
    let power = t.power(n);
    (sine * sine).scale(lambda) * power * (one - t) / (two_c * (one - power * t))
}
