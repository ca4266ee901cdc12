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
}

impl<R: Real> LaneNumbers<R> {
    pub(crate) fn new(machine: &Machine) -> Self {
        let bodies = machine.bodies.iter().map(|body| [body.mass, body.inertia]);
        let motors = machine.motors.iter().map(|motor| [motor.ratio, motor.rotor_inertia]);
        Self {
            bodies: bodies.map(|numbers| numbers.map(R::splat)).collect(),
            loads: machine.loads.iter().map(|load| numbers(load).map(R::splat)).collect(),
            motors: motors.map(|numbers| numbers.map(R::splat)).collect(),
        }
    }

    /// Reads what varies at some positions.
    #[inline(always)]
    pub(crate) fn vary(&mut self, varied: Varied<'_>, rows: Rows) {
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
