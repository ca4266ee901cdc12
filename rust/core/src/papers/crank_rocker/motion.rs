//! Positions and velocities of the crank-rocker.

use std::f64::consts::PI;

use crate::math::trig::{atan2, sin_cos};

/// Crank, coupler, rocker, ground.
pub type Lengths = [f64; 4];

/// The two assemblies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Assembly {
    /// The one in the paper: φ₃″ and β positive.
    Printed,
    /// Its mirror image about the line BD.
    Other,
}

/// The quantities of the paper's section 1 at one position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Position {
    /// Distance BD of the crank pin from the rocker's support, m.
    pub s: f64,
    /// Angle of DB, rad.
    pub phi3_first: f64,
    /// Angle from DB to the rocker, rad.
    pub phi3_second: f64,
    /// Angle DBC, rad.
    pub beta: f64,
    /// Angle of the coupler, rad.
    pub phi2: f64,
    /// Angle of the rocker, rad.
    pub phi3: f64,
    /// Angle DCB between coupler and rocker, rad, in 0 … π.
    pub gamma23: f64,
    /// Transmission angle, rad: the smaller of γ₂₃ and π − γ₂₃.
    pub gamma: f64,
}

/// Time rates of a [`Position`], and the speed of C.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rates {
    /// Time rates of the quantities of [`Position`].
    pub of: Position,
    /// Speed of C, m/s: relative to D, and absolute.
    pub v_c: [f64; 2],
}

/// Position and rates for the crank's rate (rad/s) and the rate of the ground's length (m/s).
/// `None` where the coupler does not reach the rocker.
///
/// Section 1 of the paper with three corrections: l₄ in place of the misprinted l₂ in S; angles by
/// two-argument arc tangents (the printed arcsines are wrong above a right angle); β̇ from the
/// triangle (the printed one is singular where β is a right angle).
#[must_use]
pub fn position(
    phi1: f64,
    [l1, l2, l3, l4]: Lengths,
    assembly: Assembly,
    [crank_rate, ground_rate]: [f64; 2],
) -> Option<(Position, Rates)> {
    let (sine, cosine) = sin_cos(phi1);
    // B relative to D, along the line of centres toward A and across it.
    let (along, across) = (l4 + l1 * cosine, l1 * sine);
    let s2 = along * along + across * across;
    let s = s2.sqrt();
    // Heron's formula: four times the area of the triangle BCD.
    let squared = (l2 + l3 - s) * (l2 + l3 + s) * (s - (l2 - l3)) * (s + (l2 - l3));
    if !(squared >= 0.0 && s > 0.0) {
        return None;
    }
    let area = squared.sqrt();
    let side = if assembly == Assembly::Printed { 1.0 } else { -1.0 };
    let difference = (l2 - l3) * (l2 + l3);
    let phi3_first = atan2(across, along);
    let phi3_second = side * atan2(area, s2 - difference);
    let beta = side * atan2(area, s2 + difference);
    let gamma23 = atan2(area, l2 * l2 + l3 * l3 - s2);
    let position = Position {
        s,
        phi3_first,
        phi3_second,
        beta,
        phi2: PI + phi3_first - beta,
        phi3: phi3_first + phi3_second,
        gamma23,
        gamma: gamma23.min(PI - gamma23),
    };
    // Twice the triangle's area is S l₃ sin φ₃″ = S l₂ sin β = l₂ l₃ sin γ₂₃.
    let twice = 0.5 * area;
    let s_rate = (along * ground_rate - l1 * l4 * sine * crank_rate) / s;
    let first_rate = (l1 * crank_rate * (l4 * cosine + l1) - l1 * sine * ground_rate) / s2;
    let second_rate = side * s_rate * ((s2 - difference) / (2.0 * s) - s) / twice;
    let beta_rate = side * s_rate * ((s2 + difference) / (2.0 * s) - s) / twice;
    let gamma_rate = s * s_rate / twice;
    let phi3_rate = first_rate + second_rate;
    let of = Position {
        s: s_rate,
        phi3_first: first_rate,
        phi3_second: second_rate,
        beta: beta_rate,
        phi2: first_rate - beta_rate,
        phi3: phi3_rate,
        gamma23: gamma_rate,
        gamma: if position.gamma23 <= 0.5 * PI { gamma_rate } else { -gamma_rate },
    };
    let relative = l3 * phi3_rate;
    let (rocker, _) = sin_cos(position.phi3);
    let square =
        relative * relative + ground_rate * ground_rate + 2.0 * relative * ground_rate * rocker;
    Some((position, Rates { of, v_c: [relative, square.max(0.0).sqrt()] }))
}
