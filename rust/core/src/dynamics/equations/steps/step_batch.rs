//! What all chunks of environments share, and the working data of a thread.

use super::request::StepRequest;
use crate::dynamics::equations::equation_batch::EquationBatch;
use crate::dynamics::equations::evaluate::Equation;
use crate::dynamics::kinetostatics::positions::Positions;
use crate::dynamics::reactions::applied::Values;
use crate::dynamics::reactions::scene::Scene;
use crate::math::lanes::Real;
use crate::plan::mechanism::Mechanism;

/// What all chunks share.
pub(super) struct StepBatch<'b> {
    pub equations: EquationBatch<'b>,
    pub request: &'b StepRequest<'b>,
}

/// The working data of one thread, whatever the method.
pub(super) struct StepWorker<'b, R: Real, const G: usize> {
    pub positions: Positions<'b, R, G>,
    pub scene: Scene<R>,
    pub equation: Equation<R>,
    pub efforts: Vec<f64>,
}

impl<'b> StepBatch<'b> {
    /// The working data of a thread.
    pub(super) fn worker<R: Real, const G: usize>(&self) -> StepWorker<'b, R, G> {
        let positions = &self.equations.positions;
        StepWorker {
            positions: positions.thread(),
            scene: Scene::new(positions.plan, positions.machine),
            equation: Equation::default(),
            efforts: Vec::new(),
        }
    }

    pub(super) fn mechanism(&self) -> &'b Mechanism {
        self.equations.positions.motion.mechanism
    }

    /// The number of drivers.
    pub(super) fn drivers(&self) -> usize {
        self.equations.positions.plan.drivers
    }

    pub(super) fn is_cancelled(&self) -> bool {
        self.equations.positions.motion.control.is_cancelled()
    }

    /// Whether a design must be bound anew at every position: the reach of driven slides belongs to the one
    /// that is bound.
    pub(super) fn binds_again(&self) -> bool {
        let plan = self.mechanism().plan();
        (0..self.drivers()).any(|driver| plan.driven_slide(driver).is_some())
    }

    /// The efforts at some states, with those of the motors if these act.
    pub(super) fn efforts<'e>(
        &self,
        values: &Values<'_>,
        [speed, effort]: [&'e [f64]; 2],
        count: usize,
        room: &'e mut Vec<f64>,
    ) -> &'e [f64] {
        if !self.request.has_motors {
            return effort;
        }
        self.equations.add_motors(values, speed, effort, count, room);
        room
    }
}
