//! Homotopy in the dimensions: follows the groups above class II, at the drawing's coordinate, from
//! the drawing's dimensions straight to those of the design.
//!
//! This defines the assembly of a design.

use super::design::Design;
use super::knot::{MAX_FIRST_STEP, MAX_LATER_STEPS, Taylor2};
use crate::math::vector::Vector;
use crate::plan::constants::DesignConstants;
use crate::plan::dyad::Unknown;
use crate::plan::plan::Step;
use crate::state::status::{Fault, Status};

/// Least step, as a part of the path.
const MIN_PART: f64 = 1.0 / 1_099_511_627_776.0;
/// Steps tried, at most: along a fold the smallest steps would take hours.
const MAX_TRIALS: u32 = 10_000;

impl Design<'_> {
    /// Unknowns of the groups at the drawing's coordinate, for the dimensions `values`.
    ///
    /// # Errors
    ///
    /// A group folds on the path, or the path runs along a fold: the part of it that was done.
    pub(crate) fn homotopy(&self, values: &[f64]) -> Result<Vec<Taylor2>, f64> {
        let (mechanism, plan) = (self.mechanism, self.mechanism.plan());
        let unknowns: Vec<Unknown> = plan.groups().flat_map(|g| g.unknowns.clone()).collect();
        let last = plan.steps.iter().rposition(|step| matches!(step, Step::Group(_)));
        let Some(last) = last else { return Ok(Vec::new()) };
        // In rad and m, because the scale changes along the path.
        let mut values_here: Vec<f64> = unknowns
            .iter()
            .map(|&unknown| match unknown {
                Unknown::Class(class) => mechanism.class_angle[class],
                Unknown::Slide(slide) => mechanism.slide_value[slide],
            })
            .collect();
        let mut det_signs: Option<Vec<bool>> = None;
        let (mut done, mut part, mut trials) = (0.0, 1.0, 0);
        let drawing = mechanism.drawing();
        while done < 1.0 {
            let next = if det_signs.is_some() { f64::min(done + part, 1.0) } else { 0.0 };
            let between: Vec<f64> = if next < 1.0 {
                drawing.iter().zip(values).map(|(a, b)| a + next * (b - a)).collect()
            } else {
                values.to_vec()
            };
            let constants = DesignConstants::new(plan, &mechanism.slots, &between);
            let q: Vec<f64> = (0..plan.drivers.len())
                .map(|d| {
                    let unit = if plan.driven_slide(d).is_some() { constants.scale } else { 1.0 };
                    mechanism.q0()[d] / unit
                })
                .collect();
            let cx = crate::state::state::Context {
                constants: &constants,
                ..self.context(self.tracing_derivatives())
            };
            let mut state = self.state(self.tracing_derivatives());
            state.prepare(plan, &constants, cx.derivatives);
            for (&unknown, &value) in unknowns.iter().zip(&values_here) {
                match unknown {
                    Unknown::Class(c) => state.pose.class[c][0] = Vector::at_angle(value),
                    Unknown::Slide(s) => {
                        state.pose.slides[s * state.len][0] = value / constants.scale;
                    }
                }
            }
            state.solve(&cx, &q);
            let solved = match (state.status, state.fault) {
                (Status::BadInput, _) => false,
                (
                    Status::Unreachable | Status::NotConverged,
                    Some(Fault::NotClosed { step, .. } | Fault::NotConverged { step }),
                ) => step > last,
                _ => true,
            };
            let next_values: Vec<f64> = unknowns
                .iter()
                .zip(&values_here)
                .map(|(&unknown, &from)| match unknown {
                    Unknown::Class(c) => {
                        crate::math::angle::unwrap_to(state.pose.class[c][0].angle(), from)
                    }
                    Unknown::Slide(s) => state.pose.slides[s * state.len][0] * constants.scale,
                })
                .collect();
            let close = state.work.first_step[0] <= MAX_FIRST_STEP
                && state.work.later_steps[0] <= MAX_LATER_STEPS;
            let now: Vec<bool> = state.work.determinants.iter().map(|d| d[0] > 0.0).collect();
            if solved && close && det_signs.as_ref().is_none_or(|det_signs| *det_signs == now) {
                // The first step solves the drawing itself, which gives the signs.
                (done, part) = if det_signs.is_some() { (next, 2.0 * part) } else { (0.0, 1.0) };
                values_here = next_values;
                det_signs = Some(now);
            } else {
                part *= 0.5;
            }
            trials += 1;
            if part < MIN_PART || trials == MAX_TRIALS && done < 1.0 {
                return Err(done);
            }
        }
        let scale = self.constants.scale;
        let initial = |(&unknown, &value): (&Unknown, &f64)| match unknown {
            Unknown::Class(_) => [value, 0.0, 0.0],
            Unknown::Slide(_) => [value / scale, 0.0, 0.0],
        };
        Ok(unknowns.iter().zip(&values_here).map(initial).collect())
    }
}
