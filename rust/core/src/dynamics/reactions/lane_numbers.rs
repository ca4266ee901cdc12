//! The numbers of bodies, loads and motors at a few positions, one per lane: those of the machine, or where
//! they vary those of each position's own machine.

use super::lane_rows::Rows;
use crate::dynamics::load::Load;
use crate::dynamics::machine::Machine;
use crate::dynamics::variation::{MachineNumber, Varied};
use crate::math::lanes::Real;

/// The most numbers of a load, see [`Load::number_names`].
const OF_LOAD: usize = 3;

/// The numbers in a register's lanes.
#[derive(Debug, Clone)]
pub(crate) struct LaneNumbers<R> {
    /// Mass and moment of inertia of every body.
    pub bodies: Vec<[R; 2]>,
    /// The numbers of every load.
    pub loads: Vec<[R; OF_LOAD]>,
    /// Ratio and rotor's inertia of every motor.
    pub motors: Vec<[R; 2]>,
    filled: bool,
}

impl<R: Real> LaneNumbers<R> {
    /// Room for a machine's numbers: the first reading fills it, in a function compiled for the lanes.
    pub(crate) fn new(machine: &Machine) -> Self {
        Self {
            bodies: vec![[R::ZERO; 2]; machine.bodies.len()],
            loads: vec![[R::ZERO; OF_LOAD]; machine.loads.len()],
            motors: vec![[R::ZERO; 2]; machine.motors.len()],
            filled: false,
        }
    }

    /// Reads the machine's numbers once, and what varies at some positions.
    #[inline(always)]
    pub(crate) fn read(&mut self, machine: &Machine, varied: Varied<'_>, rows: Rows) {
        if !self.filled {
            self.fill(machine);
        }
        for (number, values) in varied.each() {
            let value = rows.read(values, 1, 0);
            match number {
                MachineNumber::Mass(body) => self.bodies[body][0] = value,
                MachineNumber::Inertia(body) => self.bodies[body][1] = value,
                MachineNumber::Load(load, index) => self.loads[load][index] = value,
                MachineNumber::Motor(motor, index) => {
                    // The others give the motor's torque, which is added to the efforts.
                    if let Some(place) = self.motors[motor].get_mut(index) {
                        *place = value;
                    }
                }
            }
        }
    }

    /// Reads the machine's own numbers.
    #[inline(always)]
    pub(crate) fn fill(&mut self, machine: &Machine) {
        self.filled = true;
        for (place, body) in self.bodies.iter_mut().zip(&machine.bodies) {
            *place = [R::splat(body.mass), R::splat(body.inertia)];
        }
        for (place, load) in self.loads.iter_mut().zip(&machine.loads) {
            let [a, b, c] = numbers(load);
            *place = [R::splat(a), R::splat(b), R::splat(c)];
        }
        for (place, motor) in self.motors.iter_mut().zip(&machine.motors) {
            *place = [R::splat(motor.ratio), R::splat(motor.rotor_inertia)];
        }
    }
}

/// The numbers of a load, in the order of [`Load::number_names`].
fn numbers(load: &Load) -> [f64; OF_LOAD] {
    match load {
        Load::Force { force: [x, y], .. } => [x.constant(), y.constant(), 0.0],
        Load::Torque { torque, .. } => [torque.constant(), 0.0, 0.0],
        Load::Pressure { pressure, ambient, .. } => [pressure.constant(), *ambient, 0.0],
        Load::Spring { stiffness, length, preload, .. } => [*stiffness, *length, *preload],
        Load::TorsionSpring { stiffness, angle, preload, .. } => [*stiffness, *angle, *preload],
        Load::Damper { damping, .. } | Load::TorsionDamper { damping, .. } => [*damping, 0.0, 0.0],
    }
}
