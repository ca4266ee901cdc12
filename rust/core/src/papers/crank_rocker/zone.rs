//! Rotatability of the crank, and positions that friction does not block.

use std::f64::consts::{FRAC_PI_2, PI};

use super::case::Side;
use super::motion::Lengths;
use crate::math::trig::{asin, atan2, sin_cos};

/// Grashof types of four-bars; l₁ is the input link and l₃ the output link.
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

/// Grashof type. `tolerance` is the difference between the two sums, relative to the longest link,
/// up to which the mechanism has a change point.
///
/// F. Grashof, *Theoretische Maschinenlehre* (1883): some link turns fully if and only if the
/// shortest and the longest link together are not longer than the other two.
#[must_use]
pub fn grashof(lengths: Lengths, tolerance: f64) -> Grashof {
    let sum: f64 = lengths.iter().sum();
    let longest = lengths.iter().copied().fold(0.0, f64::max);
    let shortest = lengths.iter().copied().fold(f64::INFINITY, f64::min);
    let margin = sum - 2.0 * (longest + shortest);
    if margin.abs() <= tolerance * longest {
        return Grashof::ChangePoint;
    }
    if margin < 0.0 {
        return Grashof::TripleRocker;
    }
    match lengths.iter().position(|&l| l <= shortest) {
        Some(0) => Grashof::CrankRocker,
        Some(1) => Grashof::DoubleRocker,
        Some(2) => Grashof::RockerCrank,
        _ => Grashof::DoubleCrank,
    }
}

/// Margins of the three inequalities for a crank that turns fully and is shorter than the ground:
/// l₂ + l₃ − l₁ − l₄, l₃ + l₄ − l₁ − l₂, l₂ + l₄ − l₁ − l₃. The paper prints the first two (1),
/// which suffice only for l₃ ≤ l₂.
#[must_use]
pub fn margins([l1, l2, l3, l4]: Lengths) -> [f64; 3] {
    [(l2 + l3) - (l1 + l4), (l3 + l4) - (l1 + l2), (l2 + l4) - (l1 + l3)]
}

/// Whether the crank turns fully: the triangle BCD closes from S = |l₄ − l₁| to l₄ + l₁.
#[must_use]
pub fn crank_turns([l1, l2, l3, l4]: Lengths) -> bool {
    l4 + l1 < l2 + l3 && (l4 - l1).abs() > (l2 - l3).abs()
}

/// Least and greatest ground for a coupler and rocker, all relative to l₁: with `margins` from both
/// ends (6), or such that the transmission angle stays above `gamma_min` (8), (9).
#[must_use]
pub fn ground_range(coupler: f64, rocker: f64, margins: [f64; 2], gamma_min: f64) -> [f64; 2] {
    let cosine = sin_cos(gamma_min).1;
    let jam_distance = |sign: f64| {
        (coupler * coupler + rocker * rocker + sign * 2.0 * coupler * rocker * cosine).sqrt()
    };
    // Without friction the roots are |l₂ − l₃| and l₂ + l₃.
    let [inner, outer] = if gamma_min > 0.0 {
        [jam_distance(-1.0), jam_distance(1.0)]
    } else {
        [(coupler - rocker).abs(), coupler + rocker]
    };
    [1.0 + inner + margins[0], outer - 1.0 - margins[1]]
}

/// Angle between coupler and rocker for S = BD; `None` where they do not reach.
fn gamma23(s: f64, l2: f64, l3: f64) -> Option<f64> {
    let squared = (l2 + l3 - s) * (l2 + l3 + s) * (s - (l2 - l3)) * (s + (l2 - l3));
    (squared >= 0.0).then(|| atan2(squared.sqrt(), l2 * l2 + l3 * l3 - s * s))
}

/// Least and greatest transmission angle over a turn of the crank; `None` where it does not turn.
///
/// γ₂₃ increases with S, from S = |l₄ − l₁| to l₄ + l₁. The least transmission angle is therefore
/// at one of the two collinear positions of crank and ground, and so is the greatest unless γ₂₃
/// passes π/2.
#[must_use]
pub fn transmission_extremes([l1, l2, l3, l4]: Lengths) -> Option<[f64; 2]> {
    let near = gamma23((l4 - l1).abs(), l2, l3)?;
    let far = gamma23(l4 + l1, l2, l3)?;
    let acute = |angle: f64| angle.min(PI - angle);
    let greatest =
        if near < 0.5 * PI && far > 0.5 * PI { 0.5 * PI } else { acute(near).max(acute(far)) };
    Some([acute(near).min(acute(far)), greatest])
}

/// Intervals of the crank angle in which the transmission angle is below `gamma_min`: around 0 (γ₂₃
/// near π; its start is negative) and around π (γ₂₃ near 0). Empty without such intervals.
///
/// From S² = l₁² + l₄² + 2 l₁ l₄ cos φ₁ at γ₂₃ = π − `gamma_min` and at γ₂₃ = `gamma_min`.
#[must_use]
pub fn blocked([l1, l2, l3, l4]: Lengths, gamma_min: f64) -> Vec<[f64; 2]> {
    let squares = l2 * l2 + l3 * l3;
    let product = 2.0 * l2 * l3 * sin_cos(gamma_min).1;
    let mut intervals = Vec::new();
    for (middle, s2, sign) in [(0.0, squares + product, 1.0), (PI, squares - product, -1.0)] {
        let cosine = sign * (s2 - l1 * l1 - l4 * l4) / (2.0 * l1 * l4);
        if cosine < 1.0 {
            let half = libm::acos(cosine.max(-1.0));
            intervals.push([middle - half, middle + half]);
        }
    }
    intervals
}

/// Least transmission angle that friction in the rocker's joints allows, equation 8: sin γ is the
/// sum of coefficient × radius over the joints C and D, divided by the rocker. `None` if friction
/// blocks every angle.
#[must_use]
pub fn least_gamma([f_c, r_c, f_d, r_d]: [f64; 4], rocker: f64) -> Option<f64> {
    let reduced = (f_c * r_c + f_d * r_d) / rocker;
    (reduced < 1.0).then(|| asin(reduced))
}

/// Least transmission angle that friction allows where no link has mass and the crank drives, exactly:
/// radii ρ of the friction circles at B, C and D.
///
/// The coupler's moments about B turn the force off the line BC by arcsin((s ρC − t ρB)/l₂), and those of
/// the rocker about D require l₃ sin γ′ ≥ ρD + s ρC. Here s and t are the senses in which rocker and coupler
/// turn in C, and coupler and crank in B, relative to the rocker's swing. At its extreme t is −1 on the outer
/// side, +1 on the inner one, and s changes: the crank passes if γ there exceeds the limit of both. `None` if
/// friction blocks every angle.
#[must_use]
pub fn exact_least_gamma(
    [at_b, at_c, at_d]: [f64; 3],
    [coupler, rocker]: [f64; 2],
    side: Side,
) -> Option<f64> {
    let limit = |s: f64| {
        let moment = (at_d + s * at_c) / rocker;
        let off = match side {
            Side::Outer => (s * at_c + at_b) / coupler,
            Side::Inner => (at_b - s * at_c) / coupler,
        };
        (moment.abs() < 1.0 && off.abs() < 1.0).then(|| asin(moment) + asin(off))
    };
    let [plus, minus] = [limit(1.0)?, limit(-1.0)?];
    let greater = plus.max(minus);
    (greater < FRAC_PI_2).then_some(greater.max(0.0))
}
