//! What the equations of motion of a machine read at every position, compiled once for all calls.

use std::sync::Arc;

use super::request::Term;
use crate::batch::request::{Coordinates, Outputs, Request};
use crate::batch::writer::Writer;
use crate::branch::driven_chord::positions_share_branch;
use crate::description::error::SolveError;
use crate::dynamics::machine::Machine;
use crate::dynamics::reactions::columns::Sources;
use crate::dynamics::reactions::force_plan::ForcePlan;
use crate::math::derivatives::DerivativeTables;
use crate::plan::mechanism::Mechanism;
use crate::sensitivity::plan::SensitivityPlan;

/// The compiled equations of a machine on its mechanism.
#[derive(Debug)]
pub struct EquationPlan {
    pub(super) forces: ForcePlan,
    /// Order to which positions are solved.
    pub(super) solved_order: usize,
    pub(super) derivatives: DerivativeTables,
    pub(super) writer: Arc<Writer>,
    pub(super) sources: Sources,
    /// Joints whose Jacobians may be requested.
    joints: Vec<usize>,
}

impl EquationPlan {
    /// Compiles a machine; `joints`: those whose Jacobians may be requested.
    #[must_use]
    pub fn new(mechanism: &Mechanism, machine: &Machine, joints: Vec<usize>) -> Self {
        let mut forces = ForcePlan::for_equations(mechanism, machine, order(machine));
        for &joint in &joints {
            forces.need_joint(joint);
        }
        let mut compiled = Self::compiled(mechanism, forces, false);
        compiled.joints = joints;
        compiled
    }

    /// Compiles a machine for steps in time and for accelerations alone, which read its bodies and loaded links.
    #[must_use]
    pub fn for_accelerations(mechanism: &Mechanism, machine: &Machine) -> Self {
        let forces = ForcePlan::for_accelerations(mechanism, machine, order(machine));
        Self::compiled(mechanism, forces, false)
    }

    /// Compiles a machine whose terms are to be differentiated: it is solved to one order more, with what
    /// derivatives by dimensions need.
    #[must_use]
    pub fn for_derivatives(mechanism: &Mechanism, machine: &Machine) -> Self {
        let forces = ForcePlan::for_equations(mechanism, machine, order(machine));
        Self::compiled(mechanism, forces, true)
    }

    fn compiled(mechanism: &Mechanism, mut forces: ForcePlan, differentiates: bool) -> Self {
        let solved_order = if differentiates {
            add_outputs(&mut forces.outputs, &SensitivityPlan::new(mechanism, &[]).outputs);
            forces.order + 1
        } else {
            forces.order
        };
        let derivatives = DerivativeTables::new(forces.drivers, solved_order);
        let request = Request {
            dimensions: &[],
            coordinates: Coordinates::Shared(&[]),
            signs: &[],
            order: solved_order,
            outputs: &forces.outputs,
        };
        let writer = Writer::of(mechanism, &derivatives, &request);
        let sources = Sources::new(&forces, &writer.columns);
        Self { forces, solved_order, derivatives, writer, sources, joints: Vec::new() }
    }

    /// About how many times as long as a slider-crank a position takes: groups above class II are solved by
    /// iteration, and some angles of several drivers are followed from the drawing.
    #[must_use]
    pub fn cost(&self, mechanism: &Mechanism) -> u64 {
        if self.serves_all(mechanism) { 1 } else { 100 }
    }

    /// Whether one branch serves all positions of a design.
    pub(super) fn serves_all(&self, mechanism: &Mechanism) -> bool {
        positions_share_branch(mechanism.plan(), !self.forces.outputs.links.is_empty())
    }

    /// Refuses Jacobians of joints that it was not compiled for.
    pub(super) fn check(&self, terms: &[Term]) -> Result<(), SolveError> {
        for term in terms {
            if let Term::Jacobian(joint) = term
                && !self.joints.contains(joint)
            {
                return Err(SolveError::Shape("a Jacobian of another joint".into()));
            }
        }
        Ok(())
    }
}

/// Order of the derivatives that the equations of a machine read.
fn order(machine: &Machine) -> usize {
    let has_inertia = machine.bodies.iter().any(|b| b.mass != 0.0 || b.inertia != 0.0);
    if has_inertia { 2 } else { 1 }
}

/// Adds what derivatives by dimensions read, and the turning of every link whose direction is read.
fn add_outputs(outputs: &mut Outputs, more: &Outputs) {
    for (list, others) in
        [(&mut outputs.directions, &more.directions), (&mut outputs.slides, &more.slides)]
    {
        list.extend(others);
        list.sort_unstable();
        list.dedup();
    }
    outputs.rates.extend(more.rates.iter().chain(&outputs.directions));
    outputs.rates.retain(|link| !outputs.links.contains(link));
    outputs.rates.sort_unstable();
    outputs.rates.dedup();
}
