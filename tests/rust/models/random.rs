//! Random mechanisms by construction: a driver, then dyads hung on links that
//! are already there. Every tape of numbers in 0..1 is a mechanism whose drawing
//! closes and in which no dyad is flat; nothing is rejected.

use assur::Description;
use proptest::collection::vec;
use proptest::prelude::*;

use crate::models::assembly::Driven;
use crate::models::builder::Builder;

pub const KINDS: [&str; 5] = ["RRR", "RRP", "RPR", "PRP", "RPP"];

/// A random mechanism and how far from the drawing it is to be looked at.
#[derive(Debug, Clone)]
pub struct Case {
    pub description: Description,
    /// Kinds of the dyads hung on, without that of the driver.
    pub kinds: Vec<&'static str>,
    /// |sine| between the legs of each of them in the drawing.
    pub sines: Vec<f64>,
    /// Steps of every driver, rad or m, either way.
    pub steps: [[f64; 2]; 2],
}

/// A driver and then dyads of these kinds.
pub fn mechanism(driven: Driven, kinds: Vec<&'static str>) -> impl Strategy<Value = Case> {
    vec(0.0..1.0, 60 + 60 * kinds.len()).prop_map(move |tape| build(&tape, driven, &kinds))
}

/// Up to `most` dyads of any kinds on any of the drivers.
pub fn sequence(
    drivers: &'static [Driven],
    least: usize,
    most: usize,
) -> impl Strategy<Value = Case> {
    (prop::sample::select(drivers), vec(prop::sample::select(&KINDS[..]), least..=most))
        .prop_flat_map(|(driven, kinds)| mechanism(driven, kinds))
}

fn build(tape: &[f64], driven: Driven, kinds: &[&'static str]) -> Case {
    let mut builder = Builder::new(tape);
    builder.drive(driven);
    builder.sines.clear();
    for &kind in kinds {
        builder.dyad(kind);
    }
    let steps = [0, 1].map(|_| {
        [0, 1].map(|_| {
            let size = 0.01 + 0.25 * builder.next();
            if builder.coin(0.5) { size } else { -size }
        })
    });
    let sines = builder.sines.clone();
    Case { description: builder.finish(), kinds: kinds.to_vec(), sines, steps }
}
