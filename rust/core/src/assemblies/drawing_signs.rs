//! The signs at the drawing that lead to an assembly.

use std::f64::consts::TAU;

use super::assembly::Assembly;
use crate::batch::request::{Coordinates, Motion, Outputs, Request, Series};
use crate::branch::constant_signs::SignConstancy;
use crate::branch::design::Design;
use crate::description::error::SolveError;
use crate::plan::mechanism::Mechanism;

/// Results nearer than this (rad, or relative to the size) are the same assembly, found in two ways.
const SAME: f64 = 1.0e-6;
/// Most assemblies of which it is remembered.
const MOST_KNOWN: usize = 16;
/// Most signs whose combinations are tried.
const MOST_TRIED: usize = 8;

/// Traces signs of a bound design without groups above class II back to the drawing.
#[derive(Default)]
pub(crate) struct DrawingSigns {
    /// Signs, and whether they are the same everywhere.
    known: Vec<(Vec<i8>, bool)>,
}

impl DrawingSigns {
    /// Replaces an assembly's signs at `q` by those at the drawing.
    pub(crate) fn trace(
        &mut self,
        (design, dimensions): (&mut Design<'_>, &[f64]),
        assembly: &mut Assembly,
        q: &[f64],
    ) -> Result<(), SolveError> {
        if !self.are_constant(design, &assembly.signs) {
            let signs: Vec<f64> = assembly.signs.iter().map(|&sign| f64::from(sign)).collect();
            let back = design.signs_at_drawing(&signs, &design.scaled(q));
            assembly.signs = leading_to(design.mechanism, assembly, back, (dimensions, q))?;
        }
        Ok(())
    }

    fn are_constant(&mut self, design: &mut Design<'_>, signs: &[i8]) -> bool {
        if let Some((_, constant)) = self.known.iter().find(|(known, _)| known == signs) {
            return *constant;
        }
        let as_solved: Vec<f64> = signs.iter().map(|&sign| f64::from(sign)).collect();
        let constant = SignConstancy::new(design).holds(&as_solved);
        if self.known.len() < MOST_KNOWN {
            self.known.push((signs.to_vec(), constant));
        }
        constant
    }
}

/// The signs at the drawing that lead to an assembly: those traced back, unless rounding beside a
/// change point on the way decides otherwise on the way forward.
fn leading_to(
    mechanism: &Mechanism,
    assembly: &Assembly,
    back: Vec<i8>,
    (dimensions, q): (&[f64], &[f64]),
) -> Result<Vec<i8>, SolveError> {
    let outputs = Outputs::all(mechanism);
    let lead = |signs: &[i8]| {
        let coordinates = Coordinates::Shared(q);
        let request = Request { dimensions, coordinates, signs, order: 0, outputs: &outputs };
        Ok(is_there(&mechanism.solve(&request)?, assembly))
    };
    if lead(&back)? || back.len() > MOST_TRIED {
        return Ok(back);
    }
    for choice in 1..1_u32 << back.len() {
        let flipped = |(i, &sign): (usize, &i8)| {
            if choice >> i & 1 == 1 && !mechanism.plan().is_length(i) { -sign } else { sign }
        };
        let signs: Vec<i8> = back.iter().enumerate().map(flipped).collect();
        if lead(&signs)? {
            return Ok(signs);
        }
    }
    Ok(back)
}

/// Whether a motion of one position is in an assembly.
fn is_there(motion: &Motion, assembly: &Assembly) -> bool {
    // The spread of the joints: their place in the drawing's coordinates does not show the size.
    let spread = |axis: usize| {
        let values = assembly.joints.iter().map(|joint| joint[axis]);
        let [low, high] = values
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
        high - low
    };
    let slides = assembly.slides.iter().fold(0.0, |high: f64, value| high.max(value.abs()));
    let size = spread(0).max(spread(1)).max(slides);
    let near = |value: f64, expected: f64| (value - expected).abs() <= SAME * size;
    let joint = |series: &Series| {
        let [x, y] = assembly.joints[series.index];
        near(series.derivatives[0][0], x) && near(series.derivatives[0][1], y)
    };
    let slide = |series: &Series| near(series.derivatives[0][0], assembly.slides[series.index]);
    let link = |series: &Series| {
        let gap = (series.derivatives[0][0] - assembly.angles[series.index]) / TAU;
        (gap - gap.round()).abs() * TAU <= SAME
    };
    motion.joints.iter().all(joint)
        && motion.slides.iter().all(slide)
        && motion.links.iter().all(link)
}
