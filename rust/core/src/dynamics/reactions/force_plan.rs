//! The data of a mechanism that the reactions of a machine need, compiled once.

use super::load_actions::LoadAction;
use super::steps::{SelfStress, Transposed, self_stresses, transposed_steps};
use crate::batch::request::{Outputs, Quantity};
use crate::description::Driver;
use crate::description::frame::Axis;
use crate::dynamics::kinematics::Point;
use crate::dynamics::load::Load;
use crate::dynamics::machine::Machine;
use crate::dynamics::measure::Measure;
use crate::dynamics::pair_friction::Friction;
use crate::plan::mechanism::Mechanism;
use crate::structure::closure::{GROUND_POINT, point_of_joint};

/// An edge of the closure, with what forces need.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct ForceEdge {
    pub from: usize,
    pub to: usize,
    pub link: usize,
    /// Class of the link's rotation.
    pub class: usize,
    /// The slide along it.
    pub slide: Option<usize>,
}

/// The link of a class that passes the moment on it to another, by a slide or a driver.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct MomentStep {
    pub link: usize,
    pub to: usize,
    pub through: MomentPair,
}

/// A pair between two links that turn together, or with a driven angle between them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum MomentPair {
    Slide(usize),
    Driver(usize),
}

/// How the direction of a link's x axis is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Direction {
    Ground,
    /// From its first joint to its second.
    Joints([usize; 2]),
    /// Its angle.
    Angle,
    /// It is solved for itself.
    Solved,
}

/// The compiled reactions of a machine.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ForcePlan {
    pub drivers: usize,
    /// The quantities to solve at every position, and their orders.
    pub outputs: Outputs,
    pub order: usize,
    /// Points of the closure: the quantity that holds each.
    pub points: Vec<Option<Quantity>>,
    pub edges: Vec<ForceEdge>,
    /// Reference point of every link.
    pub reference: Vec<usize>,
    pub ground: usize,
    pub direction: Vec<Direction>,
    /// Whether a link's direction is needed.
    pub needs_direction: Vec<bool>,
    /// The two links of every slide: sliding, carrying.
    pub slide_links: Vec<[usize; 2]>,
    pub steps: Vec<Transposed>,
    /// States of stress without loads, of redundant links and slides.
    pub self_stresses: Vec<SelfStress>,
    pub moments: Vec<MomentStep>,
    /// Whether angles are solved only where a load reads them, and else their derivatives alone: angles of
    /// several drivers are followed from the drawing.
    spares_angles: bool,
    /// Points of the ground that are not solved at every position, but known for the design.
    pub is_known: Vec<bool>,
    /// For every link that the drivers alone turn, by how much each turns it, if that is not solved.
    pub turns: Vec<Option<Vec<f64>>>,
    /// Whether accelerations, and velocities, are needed.
    pub has_inertia: bool,
    pub has_speeds: bool,
    /// Number of loads, and their actions on links.
    pub loads: usize,
    pub load_actions: Vec<LoadAction>,
    pub joints: usize,
    /// The driven link of every driver that is an angle.
    pub driven_links: Vec<Option<usize>>,
    /// The driver that is a slide.
    pub slide_drivers: Vec<Option<usize>>,
    /// The edge along every slide.
    pub guide_edges: Vec<Option<usize>>,
}

impl ForcePlan {
    /// Compiles a machine.
    pub(crate) fn new(mechanism: &Mechanism, machine: &Machine) -> Self {
        let mut compiled = Self::without_needs(mechanism, machine);
        compiled.find_needs(mechanism, machine);
        compiled
    }

    /// Compiles a machine for its equations of motion: the derivatives of all links by the drivers, to an
    /// order, and of the angles no more than loads read.
    pub(crate) fn for_equations(mechanism: &Mechanism, machine: &Machine, order: usize) -> Self {
        let mut compiled = Self::by_drivers(mechanism, machine, order);
        compiled.find_needs(mechanism, machine);
        for link in 0..compiled.reference.len() {
            compiled.need_rate(link);
        }
        compiled.leave_out_unread(machine);
        compiled
    }

    /// The same of the bodies and the loaded links alone.
    pub(crate) fn for_accelerations(
        mechanism: &Mechanism,
        machine: &Machine,
        order: usize,
    ) -> Self {
        let mut compiled = Self::by_drivers(mechanism, machine, order);
        compiled.find_needs_of_parts(mechanism, machine);
        for link in machine.load_actions(mechanism).iter().map(|action| action.link) {
            if link != compiled.ground {
                compiled.need_point(compiled.reference[link]);
                compiled.need_rate(link);
            }
        }
        compiled.leave_out_unread(machine);
        compiled
    }

    /// A plan without needs, whose links turn as the drivers tell, and whose directions are solved.
    fn by_drivers(mechanism: &Mechanism, machine: &Machine, order: usize) -> Self {
        let mut compiled = Self::without_needs(mechanism, machine);
        compiled.spares_angles = true;
        compiled.order = order;
        compiled.is_known.clone_from(&mechanism.plan().fixed);
        compiled.is_known[GROUND_POINT] = false;
        for (turns, rotation) in compiled.turns.iter_mut().zip(&mechanism.plan().rotation) {
            if rotation.class == 0 {
                *turns = Some(rotation.turns.iter().map(|&turns| f64::from(turns)).collect());
            }
        }
        for direction in &mut compiled.direction {
            // A root and a division less than from its joints.
            if *direction != Direction::Ground {
                *direction = Direction::Solved;
            }
        }
        compiled
    }

    /// Leaves out rates that come with angles, and slides that nothing follows.
    fn leave_out_unread(&mut self, machine: &Machine) {
        let outputs = &mut self.outputs;
        outputs.rates.retain(|link| !outputs.links.contains(link));
        let follows_slides = |measure: &Measure| matches!(measure, Measure::Slide(_));
        let mut measures = machine.over.iter().map(|over| &over.measure).chain(&machine.ways);
        if !measures.any(follows_slides) {
            outputs.slides.clear();
        }
    }

    fn without_needs(mechanism: &Mechanism, machine: &Machine) -> Self {
        let (plan, linkage) = (mechanism.plan(), mechanism.linkage());
        let has_inertia = machine.bodies.iter().any(|b| b.mass != 0.0 || b.inertia != 0.0);
        let has_speeds = machine.loads.iter().any(Load::reads_velocities)
            || !machine.friction.is_empty()
            || !machine.ways.is_empty();
        let edges: Vec<ForceEdge> = plan
            .edges
            .iter()
            .map(|edge| ForceEdge {
                from: edge.edge.from,
                to: edge.edge.to,
                link: edge.edge.link,
                class: edge.class,
                slide: edge.edge.slide(),
            })
            .collect();
        let direction = (0..linkage.links.len())
            .map(|link| match linkage.axis(link) {
                Axis::Ground => Direction::Ground,
                Axis::Joints => {
                    let joints = &linkage.links[link].joints;
                    Direction::Joints([point_of_joint(joints[0]), point_of_joint(joints[1])])
                }
                Axis::Slide(_) | Axis::Free => Direction::Angle,
            })
            .collect();
        let guide_edges = (0..linkage.slides.len())
            .map(|slide| edges.iter().position(|edge: &ForceEdge| edge.slide == Some(slide)))
            .collect();
        Self {
            guide_edges,
            drivers: plan.drivers.len(),
            outputs: Outputs::default(),
            order: match (has_inertia, has_speeds) {
                (true, _) => 2,
                (false, true) => 1,
                (false, false) => 0,
            },
            points: vec![None; plan.points],
            edges,
            reference: plan.reference.clone(),
            ground: plan.ground,
            direction,
            needs_direction: vec![false; linkage.links.len()],
            spares_angles: false,
            is_known: vec![false; plan.points],
            turns: vec![None; linkage.links.len()],
            slide_links: plan.slide_links.clone(),
            steps: transposed_steps(plan),
            self_stresses: self_stresses(mechanism),
            moments: moment_steps(mechanism),
            has_inertia,
            has_speeds,
            loads: machine.loads.len(),
            load_actions: machine.load_actions(mechanism),
            joints: linkage.joints.len(),
            driven_links: linkage.drivers.iter().map(driven_link).collect(),
            slide_drivers: (0..linkage.slides.len())
                .map(|s| linkage.drivers.iter().position(|&d| d == Driver::Slide(s)))
                .collect(),
        }
    }

    /// Finds the quantities that reactions and loads read.
    fn find_needs(&mut self, mechanism: &Mechanism, machine: &Machine) {
        let linkage = mechanism.linkage();
        for (joint, _) in linkage.joints.iter().enumerate() {
            if linkage.links_at(joint).nth(1).is_some() {
                self.need_point(point_of_joint(joint));
            }
        }
        let ground = self.ground;
        for link in (0..linkage.links.len()).filter(|&link| link != ground) {
            self.need_point(self.reference[link]);
        }
        for edge in 0..self.edges.len() {
            let ForceEdge { from, to, link, slide, .. } = self.edges[edge];
            if let Some(slide) = slide {
                self.need_point(to);
                if link != self.ground {
                    self.need_point(from);
                    self.need_direction(self.slide_links[slide][1]);
                }
            }
        }
        self.find_needs_of_parts(mechanism, machine);
    }

    /// Finds the quantities that bodies, loads and friction read.
    fn find_needs_of_parts(&mut self, mechanism: &Mechanism, machine: &Machine) {
        let linkage = mechanism.linkage();
        for friction in &machine.friction {
            if let &Friction::Joint { joint, .. } = friction {
                linkage.links_at(joint).for_each(|link| self.need_rate(link));
            }
        }
        for body in &machine.bodies {
            self.need_mechanical_point(body.at);
            if body.inertia != 0.0 {
                self.need_rate(body.link);
            }
        }
        let acts_at: Vec<Point> = self.load_actions.iter().filter_map(|action| action.at).collect();
        for point in acts_at {
            self.need_mechanical_point(point);
        }
        for load in &machine.loads {
            match load {
                Load::Force { axes: Some(link), .. } => self.need_direction(*link),
                Load::TorsionSpring { link, on, .. } => {
                    self.need_angle(*link);
                    self.need_angle(*on);
                }
                Load::TorsionDamper { link, on, .. } => {
                    self.need_rate(*link);
                    self.need_rate(*on);
                }
                Load::Pressure { slide, .. } => self.need_direction(self.slide_links[*slide][1]),
                // They read only the points where they act.
                Load::Force { axes: None, .. }
                | Load::Spring { .. }
                | Load::Damper { .. }
                | Load::Torque { .. } => {}
            }
        }
        let curves = machine.over.iter().map(|over| over.measure);
        for measure in curves.chain(machine.ways.iter().copied()) {
            if let Measure::Angle(link) = measure {
                self.need_angle(link);
            }
        }
        // The value of a slide gives the place on its guide where the resultant acts.
        self.outputs.slides = (0..linkage.slides.len()).collect();
    }

    fn need_mechanical_point(&mut self, point: Point) {
        match point {
            Point::Joint(joint) => self.need_point(point_of_joint(joint)),
            Point::Link { link, .. } if link == self.ground => {}
            Point::Link { link, at } => {
                self.need_point(self.reference[link]);
                if at != [0.0; 2] {
                    self.need_direction(link);
                    if self.order > 0 {
                        self.need_rate(link);
                    }
                }
            }
        }
    }

    /// Needs a joint, whatever the machine reads.
    pub(crate) fn need_joint(&mut self, joint: usize) {
        self.need_point(point_of_joint(joint));
    }

    fn need_point(&mut self, point: usize) {
        if point == GROUND_POINT || self.is_known[point] || self.points[point].is_some() {
            return;
        }
        let quantity = if point <= self.joints {
            self.outputs.joints.push(point - 1);
            Quantity::Joint(point - 1)
        } else {
            let link = self.reference.iter().position(|&r| r == point).unwrap_or(self.ground);
            self.outputs.origins.push(link);
            Quantity::Origin(link)
        };
        self.points[point] = Some(quantity);
    }

    fn need_direction(&mut self, link: usize) {
        self.needs_direction[link] = true;
        match self.direction[link] {
            Direction::Ground => {}
            Direction::Joints(points) => {
                for point in points {
                    self.need_point(point);
                }
            }
            Direction::Angle => self.need_angle(link),
            Direction::Solved if self.outputs.directions.contains(&link) => {}
            Direction::Solved => self.outputs.directions.push(link),
        }
    }

    /// Needs the derivatives of a link's angle.
    fn need_rate(&mut self, link: usize) {
        if !self.spares_angles {
            self.need_angle(link);
        } else if self.turns[link].is_none() && !self.outputs.rates.contains(&link) {
            self.outputs.rates.push(link);
        }
    }

    fn need_angle(&mut self, link: usize) {
        if link != self.ground && !self.outputs.links.contains(&link) {
            self.outputs.links.push(link);
        }
    }
}

/// The order in which the links of every class pass on their moments: first those farthest from the first
/// link of the class (from the ground).
fn moment_steps(mechanism: &Mechanism) -> Vec<MomentStep> {
    let (plan, linkage) = (mechanism.plan(), mechanism.linkage());
    let mut pairs: Vec<([usize; 2], MomentPair)> = Vec::new();
    let left_out = &mechanism.structure().redundant;
    for (slide, &links) in plan.slide_links.iter().enumerate() {
        if !left_out.has_slide(linkage, slide) {
            pairs.push((links, MomentPair::Slide(slide)));
        }
    }
    for (index, driver) in linkage.drivers.iter().enumerate() {
        if let &Driver::Angle { link, relative_to } = driver {
            pairs.push(([link, relative_to], MomentPair::Driver(index)));
        }
    }
    let mut reached = vec![false; linkage.links.len()];
    let mut steps = Vec::new();
    for root in std::iter::once(linkage.ground).chain(0..linkage.links.len()) {
        if std::mem::replace(&mut reached[root], true) {
            continue;
        }
        let mut queue = std::collections::VecDeque::from([root]);
        while let Some(here) = queue.pop_front() {
            for &([a, b], through) in &pairs {
                let next = match here {
                    h if h == a => b,
                    h if h == b => a,
                    _ => continue,
                };
                if !std::mem::replace(&mut reached[next], true) {
                    steps.push(MomentStep { link: next, to: here, through });
                    queue.push_back(next);
                }
            }
        }
    }
    steps.reverse();
    steps
}

fn driven_link(driver: &Driver) -> Option<usize> {
    match *driver {
        Driver::Angle { link, .. } => Some(link),
        Driver::Slide(_) => None,
    }
}
