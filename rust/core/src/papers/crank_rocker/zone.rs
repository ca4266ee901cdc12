//! Where the crank turns, and where motion is passed on in spite of friction.

use std::f64::consts::PI;

use super::motion::Lengths;
use crate::math::trig::{asin, atan2, sin_cos};

/// Types of four-bars by Grashof; crank and rocker are l₁ and l₃.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names are the field's")]
pub enum Grashof {
    CrankRocker,
    RockerCrank,
    DoubleCrank,
    DoubleRocker,
    TripleRocker,
    ChangePoint,
}

/// The type, with as much of the greatest length allowed between the sums at a change point.
///
/// F. Grashof, *Theoretische Maschinenlehre* (1883): some link turns fully if and only if the
/// shortest and the longest together are not longer than the other two.
#[must_use]
pub fn grashof(lengths: Lengths, tolerance: f64) -> Grashof {
    let sum: f64 = lengths.iter().sum();
    let longest = lengths.iter().copied().fold(0.0, f64::max);
    let shortest = lengths.iter().copied().fold(f64::INFINITY, f64::min);
    let spare = sum - 2.0 * (longest + shortest);
    if spare.abs() <= tolerance * longest {
        return Grashof::ChangePoint;
    }
    if spare < 0.0 {
        return Grashof::TripleRocker;
    }
    match lengths.iter().position(|&l| l <= shortest) {
        Some(0) => Grashof::CrankRocker,
        Some(1) => Grashof::DoubleRocker,
        Some(2) => Grashof::RockerCrank,
        _ => Grashof::DoubleCrank,
    }
}

/// By how much the three inequalities hold for a crank that turns, with a ground longer than it:
/// l₂ + l₃ − l₁ − l₄, l₃ + l₄ − l₁ − l₂, l₂ + l₄ − l₁ − l₃. The paper prints the first two (1),
/// enough only for its own l₃ ≤ l₂.
#[must_use]
pub fn margins([l1, l2, l3, l4]: Lengths) -> [f64; 3] {
    [(l2 + l3) - (l1 + l4), (l3 + l4) - (l1 + l2), (l2 + l4) - (l1 + l3)]
}

/// Whether the crank turns fully: the triangle BCD closes from S = |l₄ − l₁| to l₄ + l₁.
#[must_use]
pub fn crank_turns([l1, l2, l3, l4]: Lengths) -> bool {
    l4 + l1 < l2 + l3 && (l4 - l1).abs() > (l2 - l3).abs()
}

/// Least and greatest relative ground for relative coupler and rocker (l₁ = 1): with a distance
/// from both ends (6), or such that the transmission angle stays above `gamma_min` (8), (9).
#[must_use]
pub fn ground_range(coupler: f64, rocker: f64, margins: [f64; 2], gamma_min: f64) -> [f64; 2] {
    let cosine = sin_cos(gamma_min).1;
    let far = |sign: f64| {
        (coupler * coupler + rocker * rocker + sign * 2.0 * coupler * rocker * cosine).sqrt()
    };
    // Without friction the roots are |l₂ − l₃| and l₂ + l₃.
    let [inner, outer] = if gamma_min > 0.0 {
        [far(-1.0), far(1.0)]
    } else {
        [(coupler - rocker).abs(), coupler + rocker]
    };
    [1.0 + inner + margins[0], outer - 1.0 - margins[1]]
}

/// Angle between coupler and rocker for a distance S of B and D; none where they do not reach.
fn gamma23(s: f64, l2: f64, l3: f64) -> Option<f64> {
    let squared = (l2 + l3 - s) * (l2 + l3 + s) * (s - (l2 - l3)) * (s + (l2 - l3));
    (squared >= 0.0).then(|| atan2(squared.sqrt(), l2 * l2 + l3 * l3 - s * s))
}

/// Least and greatest transmission angle over a turn of the crank; none where it does not turn.
///
/// γ₂₃ grows with S, which lies between |l₄ − l₁| and l₄ + l₁: so the least is at one of the two
/// collinear positions of crank and ground, and the greatest there too unless γ₂₃ passes π/2.
#[must_use]
pub fn transmission_extremes([l1, l2, l3, l4]: Lengths) -> Option<[f64; 2]> {
    let near = gamma23((l4 - l1).abs(), l2, l3)?;
    let far = gamma23(l4 + l1, l2, l3)?;
    let acute = |angle: f64| angle.min(PI - angle);
    let greatest =
        if near < 0.5 * PI && far > 0.5 * PI { 0.5 * PI } else { acute(near).max(acute(far)) };
    Some([acute(near).min(acute(far)), greatest])
}

/// Crank angles at which the transmission angle is below `gamma_min`, from and to: around 0, from
/// below it (γ₂₃ near π), and around π (γ₂₃ near 0); nowhere if there is none.
///
/// S² = l₁² + l₄² + 2 l₁ l₄ cos φ₁ at γ₂₃ = π − γ and at γ, the least one.
#[must_use]
pub fn blocked([l1, l2, l3, l4]: Lengths, gamma_min: f64) -> Vec<[f64; 2]> {
    let squares = l2 * l2 + l3 * l3;
    let product = 2.0 * l2 * l3 * sin_cos(gamma_min).1;
    let mut found = Vec::new();
    for (middle, s2, sign) in [(0.0, squares + product, 1.0), (PI, squares - product, -1.0)] {
        let cosine = sign * (s2 - l1 * l1 - l4 * l4) / (2.0 * l1 * l4);
        if cosine < 1.0 {
            let half = libm::acos(cosine.max(-1.0));
            found.push([middle - half, middle + half]);
        }
    }
    found
}

/// Least transmission angle that friction in the rocker's joints allows: sin γ = (friction over rocker), equation 8; none if
/// nothing is passed on at any angle.
#[must_use]
pub fn least_gamma([f_c, r_c, f_d, r_d]: [f64; 4], rocker: f64) -> Option<f64> {
    let reduced = (f_c * r_c + f_d * r_d) / rocker;
    (reduced < 1.0).then(|| asin(reduced))
}
