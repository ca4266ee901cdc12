//! Redundant links: how they are held, and what cannot be known of their reactions.
//!
//! A redundant link is held as its position is found: at one joint, and against turning. Every
//! closure that is checked beyond that leaves a state of stress that needs no load, one vector of
//! the null space of the transposed matrix. A reaction is determined if it vanishes in all of them
//! (M. Wojtyra, "Joint reaction forces in multibody systems with redundant constraints", Multibody
//! System Dynamics 14 (2005) 23-46).

use super::force_plan::{ForcePlan, Transposed};
use super::scene::Scene;
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::mechanism::Mechanism;
use crate::plan::plan::{AngleFrom, EdgeSlide, Plan, RedundantLink};

/// A state of stress without loads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SelfStress {
    /// A force at the end of an edge along an axis.
    Component { edge: usize, axis: usize },
    /// A force at the end of an edge along the line between two points.
    Along { edge: usize, points: [usize; 2] },
    /// A force at the end of a guide's edge, across the guide.
    Across { edge: usize },
    /// A moment between the links of a slide.
    Moment { slide: usize },
}

/// A part of a self-stress that is smaller than this is rounding: unit stresses in linkages whose
/// condition is below a million.
const VANISHES: f64 = 1e-9;

/// The transposed steps of a redundant link or slide: it turns with what holds its angle, and hangs
/// on what places it.
pub(super) fn transposed(redundant: &RedundantLink) -> Vec<Transposed> {
    let carried = redundant.places.iter().rev();
    let mut steps: Vec<_> =
        carried.map(|&(edge, backward)| Transposed::Carry { edge, backward }).collect();
    match redundant.angle_from {
        Some(AngleFrom::Joints { link, first, second, points }) => {
            steps.push(Transposed::TurnByJoints { link, edges: [first, second], points });
        }
        Some(AngleFrom::Slide { link, slide }) => {
            steps.push(Transposed::TurnBySlide { link, slide });
        }
        None => {}
    }
    steps
}

/// The self-stresses of a mechanism: one for each closure equation that is only checked.
pub(super) fn self_stresses(mechanism: &Mechanism) -> Vec<SelfStress> {
    let plan = mechanism.plan();
    plan.redundant_links().flat_map(|redundant| of_part(plan, redundant)).collect()
}

fn of_part(plan: &Plan, redundant: &RedundantLink) -> Vec<SelfStress> {
    let mut found = Vec::new();
    let (mut turned_by, mut held_by) = (None, None);
    match redundant.angle_from {
        Some(AngleFrom::Joints { second, points, .. }) => turned_by = second.map(|e| (e, points)),
        Some(AngleFrom::Slide { slide, .. }) => held_by = Some(slide),
        None => {}
    }
    for &edge in &redundant.checks {
        match (plan.edges[edge].along, turned_by) {
            (EdgeSlide::Nothing, Some((turning, points))) if turning == edge => {
                found.push(SelfStress::Along { edge, points });
            }
            (EdgeSlide::Nothing, _) => {
                found.extend([0, 1].map(|axis| SelfStress::Component { edge, axis }));
            }
            _ => found.push(SelfStress::Across { edge }),
        }
    }
    let checked = redundant.parallel.iter().map(|&(slide, _)| slide);
    found.extend(
        checked.filter(|&slide| held_by != Some(slide)).map(|slide| SelfStress::Moment { slide }),
    );
    found
}

impl<R: Real> Scene<R> {
    /// Passes the moment on a link on as a couple of forces at two joints.
    #[inline(always)]
    pub(super) fn turn_by_joints(
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
    pub(super) fn turn_by_slide(&mut self, plan: &ForcePlan, link: usize, slide: usize) {
        let moment = std::mem::replace(&mut self.moment[link], R::ZERO);
        let [sliding, carrying] = plan.slide_links[slide];
        let (other, on_sliding) =
            if link == sliding { (carrying, -moment) } else { (sliding, moment) };
        self.moment[other] += moment;
        self.slide_moment[slide] += on_sliding;
    }

    /// Replaces all loads by a self-stress of unit size.
    #[inline(always)]
    pub(super) fn stress(&mut self, plan: &ForcePlan, stress: SelfStress) {
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
        // The edge's link takes the force at its end, and what is there the opposite.
        self.point_load[plan.edges[edge].to] += -force;
        self.point_load[plan.edges[edge].from] += force;
        self.load_edge(plan, edge, force);
    }

    /// Lanes in which a part of a unit self-stress is no rounding; `size` is its unit.
    #[inline(always)]
    pub(super) fn is_stressed(value: R, size: R) -> R::Mask {
        (R::splat(VANISHES) * size).lt(value.abs())
    }
}
