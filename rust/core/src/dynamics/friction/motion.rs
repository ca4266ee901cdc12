//! The acceleration of a machine with friction: the drive is given, and both the acceleration and the
//! friction follow.
//!
//! Reactions are linear in the acceleration α too. The effort of the drive, D₀ + D₁ α + D₂ τ, equals the
//! motor's, so α and each pair's reaction are linear in the friction τ. Then the law of friction applies
//! as for a given motion.
//!
//! D₁ is the effort of the inertia forces at α = 1 alone, without loads and speeds: a difference of two
//! efforts would lose its digits beside large loads.

use super::pairs::FrictionPair;
use super::workspace::FrictionWorkspace;
use crate::batch::request::{Column, Quantity, columns};
use crate::dynamics::kinematics::{Point, SolvedPose};
use crate::dynamics::machine::Machine;
use crate::dynamics::reactions::applied::Values;
use crate::dynamics::reactions::columns::{Solved, Sources, guide_directions};
use crate::dynamics::reactions::force_plan::ForcePlan;
use crate::dynamics::reactions::lane_rows::Rows;
use crate::dynamics::reactions::scene::Scene;
use crate::dynamics::value::Numbers;
use crate::dynamics::variation::Varied;
use crate::math::lanes::LANES;
use crate::math::vector::Vector;
use crate::plan::mechanism::Mechanism;

/// The drive of a machine at one state.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Drive {
    /// Effort of the motors, N·m or N.
    pub effort: f64,
    /// Inertia of their rotors and of a flywheel.
    pub inertia: f64,
}

/// A state of a machine with one driver.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SlidingState {
    pub speed: f64,
    /// +1 or −1: the way in which everything slides, or is about to slide.
    pub sense: f64,
    /// Whether it is at rest, so that static friction holds it.
    pub is_static: bool,
}

/// Work space of a machine's accelerations under friction.
pub(crate) struct FrictionMotion<'m> {
    machine: &'m Machine,
    /// Its bodies alone, without loads and weight.
    bodies: Machine,
    plan: ForcePlan,
    pairs: Vec<FrictionPair>,
    columns: Vec<Column>,
    sources: Sources,
    guides: Vec<Vector>,
    /// The unit of length, m, and the size of the design: a power of 2 beside its greatest length.
    unit: f64,
    values: Vec<Vec<f64>>,
    scene: Scene<f64>,
    friction: FrictionWorkspace<f64>,
    /// The sense in which every pair slides while the driver moves forward, +1 or −1, or 0 where it rests;
    /// empty before a motion begins.
    held: Option<Vec<f64>>,
}

/// The only position.
const ROW: Rows = Rows { first: 0, last: 0 };

impl<'m> FrictionMotion<'m> {
    /// For a design with one driver and friction; `unit`: its unit of length.
    pub(crate) fn new(
        machine: &'m Machine,
        mechanism: &Mechanism,
        dimensions: &[f64],
        unit: f64,
    ) -> Self {
        let plan = ForcePlan::new(mechanism, machine);
        let columns = columns(&plan.outputs, 1, plan.order);
        let mut scene = Scene::new(&plan, machine);
        scene.per_metre = 1.0 / unit;
        scene.numbers.fill(machine);
        let linkage = mechanism.linkage();
        let links_at: Vec<Vec<usize>> =
            (0..linkage.joints.len()).map(|joint| linkage.links_at(joint).collect()).collect();
        Self {
            sources: Sources::new(&plan, &columns),
            guides: guide_directions(mechanism, dimensions),
            unit,
            values: columns.iter().map(|column| vec![0.0; column.width * LANES]).collect(),
            scene,
            friction: FrictionWorkspace::default(),
            pairs: FrictionPair::of(&plan, &links_at, &machine.friction),
            bodies: Machine { bodies: machine.bodies.clone(), ..Machine::default() },
            machine,
            columns,
            plan,
            held: None,
        }
    }

    /// Forgets the senses that [`Self::hold`] fixed.
    pub(crate) fn release(&mut self) {
        self.held = None;
    }

    /// Fixes the senses in which pairs slide at a position until one reverses: between reversals the
    /// acceleration is a smooth function, ends included.
    pub(crate) fn hold(&mut self, pose: &SolvedPose<'_>) {
        self.read_values(pose);
        let Self { plan, pairs, sources, guides, values, scene, friction, .. } = self;
        let columns: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
        let forward =
            Solved { columns: &columns, speed: &[1.0], acceleration: &[0.0], positions: 1 };
        scene.read(plan, sources, guides, &forward, ROW);
        let planned = (&*plan, &pairs[..]);
        friction.read(scene, planned, sources, (&forward, ROW), &[1.0], self.unit);
        friction.respond(scene, plan, pairs, |_| ());
        let way = |(&[_, way], &still): (&[f64; 2], &f64)| {
            if way.abs() > still { way.signum() } else { 0.0 }
        };
        self.held = Some(friction.speeds.iter().zip(&friction.still).map(way).collect());
    }

    /// The acceleration; `None` where the law of friction has no solution. `numbers`: what the loads read.
    pub(crate) fn acceleration(
        &mut self,
        pose: &SolvedPose<'_>,
        state: SlidingState,
        drive: Drive,
        numbers: Numbers<'_>,
    ) -> Option<f64> {
        self.read_values(pose);
        let of_one = |list: &[[f64; 2]]| list.iter().map(|&[value, _]| vec![value]).collect();
        let (tables, over): (Vec<_>, Vec<_>) = (of_one(numbers.tables), of_one(numbers.over));
        let ways: Vec<Vec<f64>> = numbers.ways.iter().map(|&way| vec![way]).collect();
        let external: Vec<f64> = numbers.external.iter().map(|&[value, _]| value).collect();
        let Self { machine, bodies, plan, pairs, sources, guides, values, scene, friction, .. } =
            self;
        let pairs = &pairs[..];
        let values_of_loads = Values {
            tables: &tables,
            over: &over,
            ways: &ways,
            external: &external,
            callbacks: external.len(),
            varied: Varied::default(),
        };
        let columns: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
        let moving =
            |speed, acceleration| Solved { columns: &columns, speed, acceleration, positions: 1 };
        scene.read(plan, sources, guides, &moving(&[0.0], &[1.0]), ROW);
        scene.apply_bodies(plan, bodies);
        scene.start(plan);
        let per_acceleration = scene.pair_reactions(plan, pairs);
        let force_per_acceleration = scene.greatest_force(self.unit);
        let inertia = scene.driver[0] + drive.inertia;
        let speed = [state.speed];
        let still = moving(&speed, &[0.0]);
        scene.read(plan, sources, guides, &still, ROW);
        scene.apply(plan, machine, values_of_loads, ROW);
        let planned = (&*plan, pairs);
        friction.read(scene, planned, sources, (&still, ROW), &[state.sense], self.unit);
        friction.is_static = Some(state.is_static);
        friction.drag(scene, plan, pairs);
        scene.start(plan);
        let base = scene.pair_reactions(plan, pairs);
        let force = scene.greatest_force(self.unit);
        let effort = scene.driver[0];
        let mut per_friction = Vec::new();
        friction.respond(scene, plan, pairs, |scene| per_friction.push(scene.driver[0]));
        // α = (motors − D₀ − D₂ τ)/D₁.
        let free = (drive.effort - effort) / inertia;
        friction.base = base
            .iter()
            .zip(&per_acceleration)
            .map(|(&base, &rate)| base + rate.scale(free))
            .collect();
        friction.force = force + force_per_acceleration * free.abs();
        for (force, effort) in friction.forces_per_unit.iter_mut().zip(&per_friction) {
            *force += force_per_acceleration * (effort / inertia).abs();
        }
        for (slopes, effort) in friction.slopes.iter_mut().zip(&per_friction) {
            for (slope, &rate) in slopes.iter_mut().zip(&per_acceleration) {
                *slope = *slope - rate.scale(effort / inertia);
            }
        }
        if let Some(held) = &self.held {
            for (pair, &way) in held.iter().enumerate() {
                friction.hold(pair, way * state.sense);
            }
        }
        let (problem, used) = friction.problem(scene, pairs, 0);
        let problem = problem.in_forces(self.unit);
        let dry = problem.first().ok()??;
        let of_friction: f64 = used
            .iter()
            .zip(&problem.pairs)
            .zip(&dry)
            .map(|((&used, pair), dry)| per_friction[used] * (pair.law.unit(self.unit) * dry))
            .sum();
        Some(free - of_friction / inertia)
    }

    /// Fills the columns that reactions read.
    fn read_values(&mut self, pose: &SolvedPose<'_>) {
        let needs_angles = self.machine.needs_angles();
        for (column, values) in self.columns.iter().zip(&mut self.values) {
            let k = column.order;
            match column.quantity {
                Quantity::Joint(joint) => {
                    let place = pose.point(Point::Joint(joint), k);
                    [values[0], values[LANES]] = [place.x, place.y];
                }
                Quantity::Origin(link) => {
                    let place = pose.point(Point::Link { link, at: [0.0, 0.0] }, k);
                    [values[0], values[LANES]] = [place.x, place.y];
                }
                Quantity::Slide(slide) => values[0] = pose.slide(slide, k),
                Quantity::Angle(link) if k > 0 => values[0] = pose.angle(link, k),
                // Without torsion springs only the direction is read.
                Quantity::Angle(link) if needs_angles => values[0] = pose.total_angle(link),
                Quantity::Angle(link) => values[0] = pose.frame(link, 0).angle(),
                Quantity::Direction(link) => {
                    let unit = pose.frame(link, k);
                    [values[0], values[LANES]] = [unit.x, unit.y];
                }
            }
        }
    }
}
