//! Computes the constants of a design's dyads, and how far from the origin their points can be.

use super::constants::DesignConstants;
use super::dyad_constants::{DyadConstants, Sides};
use super::plan::{Plan, Step};
use super::tape::{Op, PlaceKind, Tape};
use crate::math::vector::Vector;

impl DesignConstants {
    /// How far from the origin the tip of a leg can be, given the lengths of its dyad.
    fn inner_reach(&self, leg: usize) -> f64 {
        self.dyads.get(leg / 2).map_or(f64::INFINITY, |dyad| dyad.inner_reach)
    }

    /// Computes the constants of the dyads on the tape. `driven_reach`: the greatest value of a
    /// driven slide.
    pub(crate) fn measure_dyads(&mut self, plan: &Plan, tape: &Tape, driven_reach: f64) {
        self.dyads.resize(self.legs.len(), DyadConstants::default());
        self.reach.clear();
        self.reach.extend(self.fixed.iter().map(|at| at.x.abs() + at.y.abs()));
        for op in &tape.ops {
            let step = match op {
                Op::Place(place) => {
                    let arm = self.edge_vector[place.edge];
                    let reach = self.reach[place.from] + arm.x.abs() + arm.y.abs();
                    self.reach[place.to] = match place.kind {
                        PlaceKind::Leg { leg, .. } => reach.min(self.inner_reach(leg)),
                        PlaceKind::Along => reach + driven_reach,
                        _ => reach,
                    };
                    continue;
                }
                Op::TwoLegs(dyad)
                | Op::StandingGuide(dyad)
                | Op::MovingGuide(dyad)
                | Op::TurningGuide(dyad)
                | Op::StandingGuides(dyad) => dyad.step,
                Op::Dyad { step } => *step,
                Op::Group { .. } | Op::Redundant { .. } | Op::Length { .. } => continue,
            };
            let Step::Dyad(dyad) = &plan.steps[step] else { continue };
            let legs = &self.legs[dyad.index];
            let own = &mut self.dyads[dyad.index];
            (own.inner_reach, own.offset) = (f64::INFINITY, Vector::ZERO);
            let [start, end] = [self.reach[dyad.start], self.reach[dyad.end]];
            let rounding = 0.5 * start.max(end);
            let arm2 = |class: usize| self.max_arm2[class].max(rounding * rounding);
            let [u, v] = dyad.unknowns;
            own.reach = start + end + legs[0].norm;
            for term in &dyad.others {
                let sign = if term.backward { -1.0 } else { 1.0 };
                if let Some(i) = term.slides {
                    own.guides[i] = self.guide[term.edge].scale(sign);
                }
                if !term.in_leg {
                    let offset = self.edge_vector[term.edge];
                    own.offset += offset.scale(sign);
                    own.reach += offset.x.abs() + offset.y.abs();
                }
            }
            let greatest = match op {
                Op::TwoLegs(_) => {
                    own.sides = Sides::of(&legs[0], &legs[1]);
                    own.inner_reach = (start + legs[0].norm).min(end + legs[1].norm);
                    (arm2(u.class()) * legs[0].inv_norm2).max(arm2(v.class()) * legs[1].inv_norm2)
                }
                Op::StandingGuide(_) | Op::MovingGuide(_) => arm2(u.class()) * legs[0].inv_norm2,
                Op::TurningGuide(_) => arm2(u.class()),
                _ => 1.0,
            };
            own.inverse_arm2 = 1.0 / greatest.max(1.0);
            own.bounding_per_sine2 = own.sides.per_sine2 * own.inverse_arm2;
        }
    }
}
