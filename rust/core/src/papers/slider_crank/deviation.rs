//! How far an approximation of the fraction is from the exact motion.

use std::f64::consts::PI;

use super::exact::stroke;
use super::fraction::lack;
use super::greatest::{Greatest, maximum};

/// Places looked at between the dead points, among which every summit is sought.
const PLACES: u32 = 720;

/// What deviates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// The stroke.
    Stroke = 0,
    /// The velocity analogue.
    First = 1,
    /// The acceleration analogue.
    Second = 2,
}

/// Largest deviations between the dead points, 0 < φ < π.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    /// Per crank length.
    pub absolute: Greatest,
    /// As a part of the exact value; none for the acceleration analogue, which passes 0.
    pub relative: Option<Greatest>,
}

/// Of approximation number `n` (at least 1), for λ < 1.
#[must_use]
pub fn deviation(lambda: f64, n: u32, quantity: Quantity) -> Deviation {
    let order = quantity as usize;
    let absolute = |phi: f64| lack(phi, lambda, n).order(order).abs();
    let relative = |phi: f64| absolute(phi) / stroke(phi, lambda).order(order).abs();
    Deviation {
        absolute: greatest(&absolute),
        relative: (quantity != Quantity::Second).then(|| greatest(&relative)),
    }
}

/// The greatest value between the dead points: every summit among the places is climbed.
fn greatest(of: &impl Fn(f64) -> f64) -> Greatest {
    let place = |i: u32| PI * f64::from(i) / f64::from(PLACES);
    let mut best = Greatest { at: f64::NAN, value: f64::NEG_INFINITY };
    let values: Vec<f64> = (1..PLACES).map(|i| of(place(i))).collect();
    for i in 1..PLACES {
        let at = i as usize - 1;
        let before = if at > 0 { values[at - 1] } else { f64::NEG_INFINITY };
        let after = values.get(at + 1).copied().unwrap_or(f64::NEG_INFINITY);
        if values[at] < before || values[at] < after {
            continue;
        }
        let (at, value) = maximum(place(i - 1), place(i + 1), of);
        if value > best.value {
            best = Greatest { at, value };
        }
    }
    best
}
