//! Where the way of a design begins: the groups above class II at the drawing's coordinate.
//!
//! Their assembly is the one that is reached from the drawing when its dimensions go straight to
//! the design's.

use super::design::Design;
use super::knot::{FIRST_STEP, LATER_STEPS, Taylor2};
use crate::description::Driver;
use crate::math::vector::Vector;
use crate::plan::constants::DesignConstants;
use crate::plan::dyad::Unknown;
use crate::plan::plan::Step;
use crate::state::status::{Fault, Status};

/// Parts of the way from the drawing's dimensions, at least.
const LEAST_PART: f64 = 1.0 / 1_099_511_627_776.0;
/// And how many are tried: along a fold the least parts would go on for hours.
const MOST_PARTS: u32 = 10_000;

impl Design<'_> {
    /// Unknowns of the groups at the drawing's coordinate, for dimensions `values` that are bound.
    ///
    /// # Errors
    ///
    /// The way to them folds, or goes along a fold: after that part of it.
    pub(crate) fn home(&self, values: &[f64]) -> Result<Vec<Taylor2>, f64> {
        let (mechanism, plan) = (self.mechanism, self.mechanism.plan());
        let unknowns: Vec<Unknown> = plan.groups().flat_map(|g| g.unknowns.clone()).collect();
        let last = plan.steps.iter().rposition(|step| matches!(step, Step::Group(_)));
        let Some(last) = last else { return Ok(Vec::new()) };
        // rad and m, until the end.
        let mut here: Vec<f64> = unknowns
            .iter()
            .map(|&unknown| match unknown {
                Unknown::Class(class) => mechanism.class_angle[class],
                Unknown::Slide(slide) => {
                    mechanism.linkage().drawing_coordinate(Driver::Slide(slide))
                }
            })
            .collect();
        let mut sides: Option<Vec<bool>> = None;
        let (mut done, mut part, mut tried) = (0.0, 1.0, 0);
        let drawing = mechanism.drawing();
        while done < 1.0 {
            let next = if sides.is_some() { f64::min(done + part, 1.0) } else { 0.0 };
            let between: Vec<f64> = if next < 1.0 {
                drawing.iter().zip(values).map(|(a, b)| a + next * (b - a)).collect()
            } else {
                values.to_vec()
            };
            let bound = DesignConstants::new(plan, &mechanism.slots, &between);
            let q: Vec<f64> = (0..plan.drivers.len())
                .map(|d| {
                    let unit = if plan.driven_slide(d).is_some() { bound.scale } else { 1.0 };
                    mechanism.q0()[d] / unit
                })
                .collect();
            let cx =
                crate::state::state::Context { bound: &bound, ..self.context(self.first_jets()) };
            let mut state = self.state(self.first_jets());
            state.prepare(plan, &bound, cx.jets);
            for (&unknown, &value) in unknowns.iter().zip(&here) {
                match unknown {
                    Unknown::Class(c) => state.class[c][0] = Vector::at_angle(value),
                    Unknown::Slide(s) => state.slides[s * state.len][0] = value / bound.scale,
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
            let there: Vec<f64> = unknowns
                .iter()
                .zip(&here)
                .map(|(&unknown, &from)| match unknown {
                    Unknown::Class(c) => {
                        crate::math::angle::unwrap_to(state.class[c][0].angle(), from)
                    }
                    Unknown::Slide(s) => state.slides[s * state.len][0] * bound.scale,
                })
                .collect();
            let near = state.first_step[0] <= FIRST_STEP && state.later_steps[0] <= LATER_STEPS;
            let now: Vec<bool> = state.determinants.iter().map(|d| d[0] > 0.0).collect();
            if solved && near && sides.as_ref().is_none_or(|sides| *sides == now) {
                // The drawing itself comes first: it tells the sides.
                (done, part) = if sides.is_some() { (next, 2.0 * part) } else { (0.0, 1.0) };
                here = there;
                sides = Some(now);
            } else {
                part *= 0.5;
            }
            tried += 1;
            if part < LEAST_PART || tried == MOST_PARTS && done < 1.0 {
                return Err(done);
            }
        }
        let scale = self.bound.scale;
        let seed = |(&unknown, &value): (&Unknown, &f64)| match unknown {
            Unknown::Class(_) => [value, 0.0, 0.0],
            Unknown::Slide(_) => [value / scale, 0.0, 0.0],
        };
        Ok(unknowns.iter().zip(&here).map(seed).collect())
    }
}
