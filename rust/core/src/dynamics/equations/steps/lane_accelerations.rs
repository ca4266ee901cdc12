//! The accelerations of the environments of a chunk, a register of these at a time.

use crate::dynamics::equations::bodies::Partials;
use crate::dynamics::equations::equation_batch::EquationBatch;
use crate::dynamics::equations::evaluate::Equation;
use crate::dynamics::kinetostatics::positions::{DesignPositions, MachineBatch};
use crate::dynamics::reactions::lane_rows::Rows;
use crate::dynamics::reactions::scene::Scene;
use crate::math::lanes::Real;

/// States whose accelerations are to be found, at solved positions.
pub(super) struct LaneAccelerations<'e, R: Real> {
    pub batch: &'e EquationBatch<'e>,
    pub design: DesignPositions<'e>,
    pub scene: &'e mut Scene<R>,
    pub equation: &'e mut Equation<R>,
    /// Efforts of the drivers, drivers fastest.
    pub effort: &'e [f64],
}

impl<R: Real> LaneAccelerations<'_, R> {
    /// Prepares for the states of a design; returns how many there are.
    #[inline(always)]
    pub(super) fn begin(&mut self) -> usize {
        self.scene.place_known(self.design.known);
        self.design.solved.positions
    }

    /// Finds the accelerations of the states in a register.
    #[inline(always)]
    pub(super) fn find(&mut self, rows: Rows) {
        let MachineBatch { plan, sources, .. } = &self.batch.positions;
        let solved = &{ self.design.solved };
        let partials = Partials { plan, sources, solved, rows, drivers: plan.drivers };
        self.equation.read_directly(self.batch, self.scene, partials, &self.design);
        self.equation.accelerate(self.effort, rows);
    }
}
