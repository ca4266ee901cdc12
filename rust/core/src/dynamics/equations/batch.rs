//! The equations of motion of many designs at many positions.

use super::equation_batch::EquationBatch;
use super::evaluate::{Equation, Evaluate};
use super::plan::EquationPlan;
use super::request::{EquationRequest, Term};
use crate::batch::chunks::{Chunk, Chunks};
use crate::batch::dispatch::{self, Entry, ForLevel};
use crate::batch::request::{Arrays, Column, Quantity, Request, Shape, check_arrays, product};
use crate::batch::rows::RowSlices;
use crate::batch::schedule::Control;
use crate::description::error::SolveError;
use crate::dynamics::kinetostatics::positions::{Positions, of_rows};
use crate::dynamics::machine::Machine;
use crate::dynamics::reactions::scene::Scene;
use crate::math::lanes::Real;
use crate::plan::mechanism::Mechanism;

/// Positions of a chunk that share a branch: what they need stays in the caches.
const CHUNK: usize = 512;

impl Machine {
    /// The terms of the equations of motion of designs at positions: one array for each, and the statuses.
    /// Friction is not among the loads.
    ///
    /// # Errors
    ///
    /// Those of [`crate::fill`]; arrays or inputs of other sizes.
    pub fn equations(
        &self,
        mechanism: &Mechanism,
        plan: &EquationPlan,
        request: &EquationRequest<'_>,
        arrays: Arrays<'_>,
        control: &Control<'_>,
    ) -> Result<(), SolveError> {
        let forces = &plan.forces;
        let n = forces.drivers;
        plan.check(request.terms)?;
        let solve_request = Request {
            dimensions: request.dimensions,
            coordinates: request.coordinates,
            signs: request.signs,
            order: plan.solved_order,
            outputs: &forces.outputs,
        };
        let shape = Shape::of(mechanism, &solve_request)?;
        let rows = product(shape.designs, shape.positions)?;
        let column =
            |term: &Term| Column { quantity: Quantity::Joint(0), order: 0, width: term.width(n) };
        let results: Vec<Column> = request.terms.iter().map(column).collect();
        check_arrays(&results, &arrays, rows)?;
        let rest = vec![0.0; n];
        let mut batch = EquationBatch::new(
            (mechanism, self, plan),
            (&solve_request, &shape),
            request,
            &rest,
            control,
        );
        batch.positions.check()?;
        let fits = [request.effort, request.acceleration]
            .iter()
            .all(|values| batch.positions.covers(values, rows * n));
        if !fits {
            return Err(SolveError::Shape("efforts or accelerations do not fit".into()));
        }
        let mut chunks = Chunks::new(arrays, &results, [shape.designs, shape.positions], n);
        if plan.serves_all(mechanism) {
            // One branch serves all positions of a chunk.
            chunks.size = CHUNK;
        }
        // Each thread makes room for so many: more would cost more than the work.
        batch.positions.motion.most = shape.positions.min(chunks.size);
        dispatch::at_level(control.simd, Terms { batch: &batch, chunks })
    }
}

struct Terms<'b, 'r> {
    batch: &'b EquationBatch<'b>,
    chunks: Chunks<'r>,
}

/// The working data of one thread.
struct ThreadState<'b, R: Real, const G: usize> {
    positions: Positions<'b, R, G>,
    scene: Scene<R>,
    equation: Equation<R>,
    efforts: Vec<f64>,
}

impl<'b> ForLevel for Terms<'b, '_> {
    type Output = Result<(), SolveError>;

    fn run<L: Entry, const G: usize>(self) -> Self::Output {
        let batch = self.batch;
        let new_state = || ThreadState::<'b, L::Register, G> {
            positions: batch.positions.thread(),
            scene: Scene::new(batch.positions.plan, batch.positions.machine),
            equation: Equation::default(),
            efforts: Vec::new(),
        };
        let work =
            |state: &mut ThreadState<'b, L::Register, G>, chunk: &Chunk, rows: RowSlices<'_>| {
                batch.chunk::<L, G>(state, chunk, rows);
            };
        batch
            .positions
            .motion
            .control
            .run(self.chunks, new_state, work, |state| state.positions.finish())
    }
}

impl<'b> EquationBatch<'b> {
    fn chunk<L: Entry, const G: usize>(
        &self,
        state: &mut ThreadState<'b, L::Register, G>,
        chunk: &Chunk,
        mut results: RowSlices<'_>,
    ) {
        let ThreadState { positions, scene, equation, efforts } = state;
        let (request, n) = (self.request, self.positions.plan.drivers);
        self.positions.solve::<L, G>(positions, chunk, false, |design| {
            let count = design.status.len();
            let mut effort = of_rows(request.effort, n, &design.rows);
            if request.has_motors {
                self.add_motors(&design.values, design.solved.speed, effort, count, efforts);
                effort = efforts;
            }
            let mut task = Evaluate {
                batch: self,
                effort,
                acceleration: of_rows(request.acceleration, n, &design.rows),
                first: design.index * count,
                design,
                scene,
                equation,
                results: &mut results,
            };
            L::call(&mut task);
        });
    }
}
