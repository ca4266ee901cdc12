//! Redundant links: how they are held, and which of their reactions are undetermined.
//!
//! A redundant link is held as its position is found: at one joint, and against turning. Every
//! closure that is checked beyond that leaves a state of stress that needs no load, one vector of
//! the null space of the transposed matrix. A reaction is determined if it vanishes in all of them
//! (M. Wojtyra, "Joint reaction forces in multibody systems with redundant constraints", Multibody
//! System Dynamics 14 (2005) 23-46).

use super::force_plan::ForcePlan;
use super::scene::Scene;
use super::steps::SelfStress;
use crate::math::lanes::Real;
use crate::math::vector::Vector;

/// A part of a self-stress below this is rounding: unit stresses in linkages whose condition is below a
/// million.
const VANISHES: f64 = 1e-9;

impl<R: Real> Scene<R> {
    /// Passes the moment on a link on as a couple of forces at two joints.
    #[inline(always)]
    pub(crate) fn turn_by_joints(
        &mut self,
        link: usize,
        edges: [Option<usize>; 2],
        points: [usize; 2],
    ) {
        let span = self.points[points[1]].at - self.points[points[0]].at;
        let moment = std::mem::replace(&mut self.moment[link], R::ZERO);
        let force = span.left().scale(moment / span.norm2());
        self.point_load[points[1]] += force;
        self.point_load[points[0]] += -force;
        for (edge, force) in edges.into_iter().zip([force, -force]) {
            if let Some(edge) = edge {
                self.edge_force[edge] += force;
            }
        }
    }

    /// Passes the moment on a link on to the other link of a slide.
    #[inline(always)]
    pub(crate) fn turn_by_slide(&mut self, plan: &ForcePlan, link: usize, slide: usize) {
        let moment = std::mem::replace(&mut self.moment[link], R::ZERO);
        let [sliding, carrying] = plan.slide_links[slide];
        let (receiver, on_sliding) =
            if link == sliding { (carrying, -moment) } else { (sliding, moment) };
        self.moment[receiver] += moment;
        self.slide_moment[slide] += on_sliding;
    }

    /// Replaces all loads by a self-stress of unit size.
    #[inline(always)]
    pub(crate) fn stress(&mut self, plan: &ForcePlan, stress: SelfStress) {
        self.link_force.fill(Vector::ZERO);
        self.link_moment.fill(R::ZERO);
        self.start(plan);
        let (edge, force) = match stress {
            SelfStress::Component { edge, axis: 0 } => (edge, Vector::ONE),
            SelfStress::Component { edge, .. } => (edge, Vector::ONE.left()),
            SelfStress::Along { edge, points } => {
                let span = self.points[points[1]].at - self.points[points[0]].at;
                (edge, span.scale(R::ONE / span.norm()))
            }
            SelfStress::Across { edge } => {
                let slide = plan.edges[edge].slide.unwrap_or_default();
                (edge, self.guides[slide].left())
            }
            SelfStress::Moment { slide } => {
                let [sliding, carrying] = plan.slide_links[slide];
                self.moment[sliding] += R::ONE;
                self.moment[carrying] += -R::ONE;
                self.slide_moment[slide] += R::ONE;
                return;
            }
        };
        // The edge's link takes the force at its end, and the part there takes the opposite.
        self.point_load[plan.edges[edge].to] += -force;
        self.point_load[plan.edges[edge].from] += force;
        self.load_edge(plan, edge, force);
    }

    /// Lanes in which a part of a unit self-stress is more than rounding; `size` is its unit.
    #[inline(always)]
    pub(crate) fn is_stressed(value: R, size: R) -> R::Mask {
        (R::splat(VANISHES) * size).lt(value.abs())
    }
}
