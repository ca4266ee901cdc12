//! Loads and inertia forces of all links.

use super::force_plan::ForcePlan;
use super::lane_rows::Rows;
use super::load_actions::LoadAction;
use super::scene::{Moving, Scene};
use crate::dynamics::kinematics::Point;
use crate::dynamics::load::Load;
use crate::dynamics::machine::Machine;
use crate::dynamics::measure::OneWay;
use crate::dynamics::value::Value;
use crate::dynamics::variation::Varied;
use crate::math::lanes::{Mask, Real};
use crate::math::vector::Vector;
use crate::structure::closure::point_of_joint;

/// The values of tables and callbacks at positions.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Values<'a> {
    /// Values of every table, at every position.
    pub tables: &'a [Vec<f64>],
    /// Values of every curve over another coordinate.
    pub over: &'a [Vec<f64>],
    /// Direction of every coordinate that a load follows.
    pub ways: &'a [Vec<f64>],
    /// Values of the callbacks: `callbacks` numbers a position.
    pub external: &'a [f64],
    pub callbacks: usize,
    /// Numbers that each position's machine has for itself.
    pub varied: Varied<'a>,
}

impl Values<'_> {
    /// A value; `number` in the lanes if it is one.
    #[inline(always)]
    fn read<R: Real>(self, value: Value, number: R, rows: Rows) -> R {
        match value {
            Value::Number(_) => number,
            Value::Table(index) => rows.read(&self.tables[index], 1, 0),
            Value::Over(index) => rows.read(&self.over[index], 1, 0),
            Value::External(index) => rows.read(self.external, self.callbacks, index),
        }
    }

    /// A value where the load acts; 0 elsewhere.
    #[inline(always)]
    fn read_acting<R: Real>(
        self,
        value: Value,
        number: R,
        one_way: Option<OneWay>,
        rows: Rows,
    ) -> R {
        let all = self.read(value, number, rows);
        self.acting(all, one_way, rows)
    }

    #[inline(always)]
    fn acting<R: Real>(self, value: R, one_way: Option<OneWay>, rows: Rows) -> R {
        let Some(OneWay { way, sign }) = one_way else { return value };
        let along = rows.read::<R>(&self.ways[way], 1, 0) * R::splat(sign);
        R::select(along.le(R::ZERO), R::ZERO, value)
    }
}

impl<R: Real> Scene<R> {
    /// Sums the loads and inertia forces on every link.
    #[inline(always)]
    pub(crate) fn apply(
        &mut self,
        plan: &ForcePlan,
        machine: &Machine,
        values: Values<'_>,
        rows: Rows,
    ) {
        self.numbers.read(machine, values.varied, rows);
        self.apply_bodies(plan, machine);
        self.apply_loads(plan, machine, values, rows);
    }

    /// Begins the sums of forces on links.
    #[inline(always)]
    pub(crate) fn clear_forces(&mut self) {
        self.link_force.fill(Vector::ZERO);
        self.link_moment.fill(R::ZERO);
    }

    /// Adds the loads to these sums.
    #[inline(always)]
    pub(crate) fn apply_loads(
        &mut self,
        plan: &ForcePlan,
        machine: &Machine,
        values: Values<'_>,
        rows: Rows,
    ) {
        for (index, load) in machine.loads.iter().enumerate() {
            self.loads[index] = self.strength(plan, load, self.numbers.loads[index], values, rows);
        }
        for action in &plan.load_actions {
            // The ground takes every force, wherever it acts.
            if action.link == plan.ground {
                continue;
            }
            let strength = self.load_on(action);
            match action.at {
                Some(point) => {
                    let place = self.place(plan, point).at;
                    self.force_on(plan, action.link, place, strength);
                }
                None => self.moment_on(plan, action.link, strength.x),
            }
        }
    }

    /// Sums weights and inertia forces on every link.
    #[inline(always)]
    pub(crate) fn apply_bodies(&mut self, plan: &ForcePlan, machine: &Machine) {
        self.clear_forces();
        self.shaking_force = Vector::ZERO;
        self.shaking_moment = R::ZERO;
        let gravity = Vector::new(R::splat(machine.gravity[0]), R::splat(machine.gravity[1]));
        for (index, body) in machine.bodies.iter().enumerate() {
            let [mass, inertia] = self.numbers.bodies[index];
            let at = self.place(plan, body.at);
            let weight = gravity.scale(mass);
            if !plan.has_inertia || body.link == plan.ground {
                self.force_on(plan, body.link, at.at, weight);
                continue;
            }
            let inertia_force = -at.acceleration.scale(mass);
            let couple = -self.angles[body.link].acceleration * inertia;
            self.force_on(plan, body.link, at.at, weight + inertia_force);
            self.moment_on(plan, body.link, couple);
            self.shaking_force += inertia_force;
            self.shaking_moment += at.at.cross(inertia_force) + couple;
        }
    }

    /// The force of a load on the first link on which it acts; for a couple, its moment as x.
    #[inline(always)]
    fn strength(
        &self,
        plan: &ForcePlan,
        load: &Load,
        numbers: [R; 3],
        values: Values<'_>,
        rows: Rows,
    ) -> Vector<R> {
        match load {
            Load::Force { force: [x, y], axes, one_way, .. } => {
                let read =
                    |value: &Value, number| values.read_acting(*value, number, *one_way, rows);
                let force = Vector::new(read(x, numbers[0]), read(y, numbers[1]));
                match axes {
                    Some(link) => self.directions[*link] * force,
                    None => force,
                }
            }
            Load::Pressure { slide, area, pressure, one_way, .. } => {
                let [number, ambient, _] = numbers;
                let pressure = values.read(*pressure, number, rows) - ambient;
                let force = values.acting(pressure * R::splat(*area), *one_way, rows);
                self.guides[*slide].scale(force)
            }
            Load::Torque { torque, one_way, .. } => {
                Vector::new(values.read_acting(*torque, numbers[0], *one_way, rows), R::ZERO)
            }
            Load::Spring { ends, .. } => {
                let [stiffness, length, preload] = numbers;
                let (first, second) = (self.place(plan, ends[0]), self.place(plan, ends[1]));
                let (unit, distance) = polar(second.at - first.at);
                let tension = stiffness * (distance - length) + preload;
                // A spring without tension has no direction at zero length.
                let rests = tension.le(R::ZERO).and(R::ZERO.le(tension));
                let pull = unit.scale(tension);
                Vector::new(R::select(rests, R::ZERO, pull.x), R::select(rests, R::ZERO, pull.y))
            }
            Load::Damper { ends, .. } => {
                let (first, second) = (self.place(plan, ends[0]), self.place(plan, ends[1]));
                let (unit, _) = polar(second.at - first.at);
                let rate = unit.dot(second.velocity - first.velocity);
                unit.scale(rate * numbers[0])
            }
            Load::TorsionSpring { link, on, .. } => {
                let [stiffness, angle, preload] = numbers;
                let twist = self.angle(plan, *link).at - self.angle(plan, *on).at - angle;
                let torque = -(stiffness * twist + preload);
                Vector::new(torque, R::ZERO)
            }
            Load::TorsionDamper { link, on, .. } => {
                let rate = self.angle(plan, *link).velocity - self.angle(plan, *on).velocity;
                Vector::new(-(rate * numbers[0]), R::ZERO)
            }
        }
    }

    /// The force of a load on a link; its couple as x.
    #[inline(always)]
    pub(crate) fn load_on(&self, action: &LoadAction) -> Vector<R> {
        let strength = self.loads[action.load];
        if action.is_reaction { -strength } else { strength }
    }

    #[inline(always)]
    pub(crate) fn force_on(
        &mut self,
        plan: &ForcePlan,
        link: usize,
        place: Vector<R>,
        force: Vector<R>,
    ) {
        if link == plan.ground {
            return;
        }
        let arm = place - self.points[plan.reference[link]].at;
        self.link_force[link] += force;
        self.link_moment[link] += arm.cross(force);
    }

    #[inline(always)]
    pub(crate) fn moment_on(&mut self, plan: &ForcePlan, link: usize, moment: R) {
        if link != plan.ground {
            self.link_moment[link] += moment;
        }
    }

    #[inline(always)]
    fn angle(&self, plan: &ForcePlan, link: usize) -> Moving<R> {
        if link == plan.ground {
            return Moving { at: R::ZERO, velocity: R::ZERO, acceleration: R::ZERO };
        }
        self.angles[link]
    }

    /// Motion of a point of a link: `a = a_ref + (i ε − ω²) r`.
    #[inline(always)]
    pub(crate) fn place(&self, plan: &ForcePlan, point: Point) -> Moving<Vector<R>> {
        match point {
            Point::Joint(joint) => self.points[point_of_joint(joint)],
            Point::Link { link, at: [x, y] } if link == plan.ground => Moving {
                at: Vector::new(R::splat(x), R::splat(y)),
                velocity: Vector::ZERO,
                acceleration: Vector::ZERO,
            },
            Point::Link { link, at: [x, y] } => {
                let reference = self.points[plan.reference[link]];
                if x == 0.0 && y == 0.0 {
                    return reference;
                }
                let arm = self.directions[link] * Vector::splat(Vector::new(x, y));
                let angle = self.angles[link];
                let turning = arm.left();
                Moving {
                    at: reference.at + arm,
                    velocity: reference.velocity + turning.scale(angle.velocity),
                    acceleration: reference.acceleration + turning.scale(angle.acceleration)
                        - arm.scale(angle.velocity * angle.velocity),
                }
            }
        }
    }
}

/// Direction and length.
#[inline(always)]
fn polar<R: Real>(span: Vector<R>) -> (Vector<R>, R) {
    let length = span.norm();
    (span.scale(R::ONE / length), length)
}
