//! The kinematics of a few positions, and the forces on them: one per lane.

use super::force_plan::ForcePlan;
use super::lane_numbers::LaneNumbers;
use crate::dynamics::machine::Machine;
use crate::math::lanes::Real;
use crate::math::vector::Vector;

/// Position, velocity and acceleration.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Moving<T> {
    pub at: T,
    pub velocity: T,
    pub acceleration: T,
}

/// Work space: kinematics, loads, and the forces in pairs.
#[derive(Debug, Clone)]
pub(crate) struct Scene<R: Real> {
    /// Numbers of bodies, loads and motors.
    pub numbers: LaneNumbers<R>,
    /// Speeds and accelerations of the drivers.
    pub drive: Vec<[R; 2]>,
    pub points: Vec<Moving<Vector<R>>>,
    /// Angles of links.
    pub angles: Vec<Moving<R>>,
    /// Directions of the links' x axes.
    pub directions: Vec<Vector<R>>,
    /// Directions of the guides of slides.
    pub guides: Vec<Vector<R>>,
    /// Values of slides, m.
    pub slides: Vec<R>,
    /// Loads and inertia forces on every link, and their moments about its reference point.
    pub link_force: Vec<Vector<R>>,
    pub link_moment: Vec<R>,
    /// Force of every load on the first link on which it acts; for a couple, its moment as x.
    pub loads: Vec<Vector<R>>,
    /// Inertia forces of all bodies, and their moment about the origin.
    pub shaking_force: Vector<R>,
    pub shaking_moment: R,
    /// Load on every point that its links have not taken yet.
    pub point_load: Vec<Vector<R>>,
    /// Moment on every link about its reference point, from loads and from what the link carries.
    pub moment: Vec<R>,
    /// Force along the guide of every slide.
    pub sliding: Vec<R>,
    /// Force on the link of every edge at the edge's end.
    pub edge_force: Vec<Vector<R>>,
    /// Moment on the sliding link of every slide.
    pub slide_moment: Vec<R>,
    /// Torque or force of every driver.
    pub driver: Vec<R>,
    /// Units of length per metre: groups are solved in that unit, so that pivots do not depend on metres.
    pub(crate) per_metre: R,
    pub(crate) matrix: Vec<[R; 1]>,
    pub(crate) right: Vec<R>,
}

impl<R: Real> Scene<R> {
    pub(crate) fn new(plan: &ForcePlan, machine: &Machine) -> Self {
        let (points, links) = (plan.points.len(), plan.reference.len());
        let slides = plan.slide_links.len();
        let still = Moving { at: R::ZERO, velocity: R::ZERO, acceleration: R::ZERO };
        let zero = Vector::ZERO;
        let resting = Moving { at: zero, velocity: zero, acceleration: zero };
        Self {
            numbers: LaneNumbers::new(machine),
            drive: vec![[R::ZERO; 2]; plan.drivers],
            points: vec![resting; points],
            angles: vec![still; links],
            directions: vec![Vector::ONE; links],
            guides: vec![Vector::ONE; slides],
            slides: vec![R::ZERO; slides],
            link_force: vec![zero; links],
            link_moment: vec![R::ZERO; links],
            loads: vec![zero; plan.loads],
            shaking_force: zero,
            shaking_moment: R::ZERO,
            point_load: vec![zero; points],
            moment: vec![R::ZERO; links],
            sliding: vec![R::ZERO; slides],
            edge_force: vec![zero; plan.edges.len()],
            slide_moment: vec![R::ZERO; slides],
            driver: vec![R::ZERO; plan.drivers],
            per_metre: R::ONE,
            matrix: Vec::new(),
            right: Vec::new(),
        }
    }

    /// Force of a guide on the sliding link.
    #[inline(always)]
    pub(crate) fn normal(&self, plan: &ForcePlan, slide: usize) -> R {
        let Some(edge) = plan.guide_edges[slide] else { return R::ZERO };
        -self.guides[slide].cross(self.edge_force[edge])
    }
}
