//! Deviation of an approximant of the continued fraction from the exact motion.

use std::f64::consts::PI;

use super::exact::stroke;
use super::fraction::approximation_error;
use super::greatest::{Greatest, maximum};

/// Samples between the dead points; each local maximum among them is refined.
const SAMPLES: u32 = 720;

/// A quantity of the motion.
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
    /// Relative to the exact value; `None` for the acceleration analogue, which passes zero.
    pub relative: Option<Greatest>,
}

/// Deviation of approximant `n` (at least 1), for λ < 1.
#[must_use]
pub fn deviation(lambda: f64, n: u32, quantity: Quantity) -> Deviation {
    let order = quantity as usize;
    let absolute = |phi: f64| approximation_error(phi, lambda, n).order(order).abs();
    let relative = |phi: f64| absolute(phi) / stroke(phi, lambda).order(order).abs();
    Deviation {
        absolute: greatest(&absolute),
        relative: (quantity != Quantity::Second).then(|| greatest(&relative)),
    }
}

/// Greatest value between the dead points, from every local maximum among the samples.
fn greatest(f: &impl Fn(f64) -> f64) -> Greatest {
    let sample = |i: u32| PI * f64::from(i) / f64::from(SAMPLES);
    let mut best = Greatest { at: f64::NAN, value: f64::NEG_INFINITY };
    let values: Vec<f64> = (1..SAMPLES).map(|i| f(sample(i))).collect();
    for i in 1..SAMPLES {
        let index = i as usize - 1;
        let before = if index > 0 { values[index - 1] } else { f64::NEG_INFINITY };
        let after = values.get(index + 1).copied().unwrap_or(f64::NEG_INFINITY);
        if values[index] < before || values[index] < after {
            continue;
        }
        let (at, value) = maximum(sample(i - 1), sample(i + 1), f);
        if value > best.value {
            best = Greatest { at, value };
        }
    }
    best
}
