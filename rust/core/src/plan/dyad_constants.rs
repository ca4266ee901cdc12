//! Constants of one design in the closed forms of its dyads.

use super::constants::DesignConstants;
use super::leg::Leg;
use super::plan::{Plan, Step};
use super::tape::{Op, PlaceKind, Tape};
use crate::math::lanes::Real;
use crate::math::tolerance::FLAT_CLOSURE;
use crate::math::vector::Vector;

/// The sides of a triangle of two legs and the chord between their ends.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Sides<R = f64> {
    /// (a + b)²
    pub sum2: R,
    /// (a − b)²
    pub difference2: R,
    /// a² − b²
    pub split: R,
    /// By how much the square of the chord may exceed the first and fall below the second, if the
    /// triangle is to count as flat.
    pub tolerances: [R; 2],
    /// 1 / (4 a² b²)
    pub per_sine2: R,
}

impl<R: Real> Sides<R> {
    #[inline(always)]
    pub(crate) fn of(a: &Leg<R>, b: &Leg<R>) -> Self {
        let (sum, difference) = (a.norm + b.norm, a.norm - b.norm);
        // The chord of a flat triangle is as long as the sum, or as the difference: there its
        // square differs by twice itself times the difference in length.
        let within = R::splat(2.0 * FLAT_CLOSURE);
        Self {
            sum2: sum * sum,
            difference2: difference * difference,
            // Keeps digits when a ≈ b.
            split: difference * sum,
            tolerances: [within * (sum * sum), within * (a.norm.max(b.norm) * difference.abs())],
            per_sine2: R::splat(0.25) * (a.inv_norm2 * b.inv_norm2),
        }
    }
}

impl Sides {
    /// The same sides on every lane.
    #[inline(always)]
    pub(crate) fn on_lanes<R: Real>(&self) -> Sides<R> {
        Sides {
            sum2: R::splat(self.sum2),
            difference2: R::splat(self.difference2),
            split: R::splat(self.split),
            tolerances: [R::splat(self.tolerances[0]), R::splat(self.tolerances[1])],
            per_sine2: R::splat(self.per_sine2),
        }
    }
}

/// Constants of one dyad.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct DyadConstants {
    /// Of two legs.
    pub sides: Sides,
    /// The parts of its loop that stand still.
    pub offset: Vector,
    /// Directions of its guides; of a guide that turns, in the frame of its class.
    pub guides: [Vector; 2],
    /// How far its chord and legs reach, or farther.
    pub reach: f64,
    /// How far from the origin its inner joint can be, at most.
    pub inner_reach: f64,
    /// Its arm² (see `DyadSolution::arm2`) is nowhere greater than the inverse of this.
    pub inverse_arm2: f64,
}

impl DesignConstants {
    /// How far the tip of a leg can be, as far as its dyad tells.
    fn inner_reach(&self, leg: usize) -> f64 {
        self.dyads.get(leg / 2).map_or(f64::INFINITY, |dyad| dyad.inner_reach)
    }

    /// Computes the constants of the dyads on the tape.
    pub(crate) fn measure_dyads(&mut self, plan: &Plan, tape: &Tape) {
        self.dyads.clear();
        self.reach.clear();
        self.reach.extend(self.fixed.iter().map(|at| at.x.abs() + at.y.abs()));
        for op in &tape.ops {
            let step = match op {
                Op::Place(place) => {
                    let arm = self.edge_vector[place.edge];
                    let reach = self.reach[place.from] + arm.x.abs() + arm.y.abs();
                    self.reach[place.to] = match place.kind {
                        PlaceKind::Leg { leg, .. } => reach.min(self.inner_reach(leg)),
                        _ => reach,
                    };
                    continue;
                }
                Op::TwoLegs(dyad)
                | Op::StandingGuide(dyad)
                | Op::TurningGuide(dyad)
                | Op::StandingGuides(dyad) => dyad.step,
                Op::Dyad { step } => *step,
                Op::Group { .. } | Op::Redundant { .. } => continue,
            };
            let Step::Dyad(dyad) = &plan.steps[step] else { continue };
            let legs = &self.legs[dyad.index];
            let mut own = DyadConstants { inner_reach: f64::INFINITY, ..DyadConstants::default() };
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
                Op::StandingGuide(_) => arm2(u.class()) * legs[0].inv_norm2,
                Op::TurningGuide(_) => arm2(u.class()),
                _ => 1.0,
            };
            own.inverse_arm2 = 1.0 / greatest.max(1.0);
            self.dyads.push(own);
        }
    }
}
