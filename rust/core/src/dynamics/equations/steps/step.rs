//! Environments in chunks, stepped by the method of the request.

use std::mem::MaybeUninit;

use super::controlled::ControlledSteps;
use super::even::EvenSteps;
use super::failures::has_failed;
use super::request::{StepMethod, StepRequest};
use super::step_batch::{StepBatch, StepWorker};
use crate::batch::chunks::{Chunk, Chunks};
use crate::batch::dispatch::{self, Entry, ForLevel};
use crate::batch::known_signs::KnownSigns;
use crate::batch::motion::Asked;
use crate::batch::request::{
    Arrays, Column, Coordinates, Quantity, Request, Shape, check_arrays, product,
};
use crate::batch::rows::RowSlices;
use crate::batch::schedule::Control;
use crate::description::error::SolveError;
use crate::dynamics::equations::equation_batch::EquationBatch;
use crate::dynamics::equations::plan::EquationPlan;
use crate::dynamics::equations::request::{EquationRequest, Term};
use crate::dynamics::machine::Machine;
use crate::dynamics::variation;
use crate::math::lanes::Real;
use crate::plan::mechanism::Mechanism;

/// Environments of a chunk: what they need stays in the caches.
const CHUNK: usize = 128;

impl Machine {
    /// Steps environments in time: writes coordinates, speeds and statuses.
    ///
    /// # Errors
    ///
    /// Those of [`crate::fill`]; arrays or inputs of other sizes, tolerances that no step meets.
    pub fn step(
        &self,
        mechanism: &Mechanism,
        plan: &EquationPlan,
        request: &StepRequest<'_>,
        arrays: Arrays<'_>,
        control: &Control<'_>,
    ) -> Result<(), SolveError> {
        let forces = &plan.forces;
        let n = forces.drivers;
        let coordinates = Coordinates::PerDesign(request.q);
        let solve_request = Request {
            dimensions: request.dimensions,
            coordinates,
            signs: request.signs,
            order: plan.solved_order,
            outputs: &forces.outputs,
        };
        let shape = Shape::of(mechanism, &solve_request)?;
        let rows = product(shape.designs, shape.positions)?;
        let column = Column { quantity: Quantity::Joint(0), order: 0, width: n };
        let results = [column, column];
        check_arrays(&results, &arrays, rows)?;
        if request.speed.len() != rows * n || ![rows * n, n].contains(&request.effort.len()) {
            return Err(SolveError::Shape("speeds or efforts do not fit".into()));
        }
        request.method.check()?;
        variation::check(self, request.variations, rows)?;
        let known_signs = KnownSigns::new(shape.designs)
            .map_err(|_| SolveError::OutOfMemory { numbers: shape.designs })?;
        let control = &Control { known_signs: Some(&known_signs), failures: None, ..*control };
        let rest = vec![0.0; n];
        let equation_request = EquationRequest {
            dimensions: request.dimensions,
            coordinates,
            signs: request.signs,
            speed: request.speed,
            acceleration: &rest,
            effort: request.effort,
            has_motors: request.has_motors,
            external: &[],
            sense: &[],
            variations: request.variations,
            terms: &[Term::Acceleration],
        };
        let mut equations = EquationBatch::new(
            (mechanism, self, plan),
            (&solve_request, &shape),
            &equation_request,
            &rest,
            control,
        );
        equations.positions.motion.most = shape.positions.min(CHUNK);
        let batch = StepBatch { equations, request };
        let mut chunks = Chunks::new(arrays, &results, [shape.designs, shape.positions], n);
        chunks.size = CHUNK;
        dispatch::at_level(control.simd, Steps { batch: &batch, chunks })
    }
}

struct Steps<'b, 'r> {
    batch: &'b StepBatch<'b>,
    chunks: Chunks<'r>,
}

/// The working data of one thread.
struct ThreadState<'b, R: Real, const G: usize> {
    worker: StepWorker<'b, R, G>,
    even: EvenSteps,
    controlled: ControlledSteps,
}

impl<'b> ForLevel for Steps<'b, '_> {
    type Output = Result<(), SolveError>;

    fn run<L: Entry, const G: usize>(self) -> Self::Output {
        let batch = self.batch;
        let new_state = || ThreadState::<'b, L::Register, G> {
            worker: batch.worker(),
            even: EvenSteps::default(),
            controlled: ControlledSteps::default(),
        };
        let work =
            |state: &mut ThreadState<'b, L::Register, G>, chunk: &Chunk, rows: RowSlices<'_>| {
                batch.chunk::<L, G>(state, chunk, rows);
            };
        let control = batch.equations.positions.motion.control;
        control.run(self.chunks, new_state, work, |state| state.worker.positions.finish())
    }
}

impl<'b> StepBatch<'b> {
    fn chunk<L: Entry, const G: usize>(
        &self,
        state: &mut ThreadState<'b, L::Register, G>,
        chunk: &Chunk,
        mut results: RowSlices<'_>,
    ) {
        let ThreadState { worker, even, controlled } = state;
        let motion = &self.equations.positions.motion;
        motion.read_designs(&mut worker.positions.motion, chunk);
        for (index, design) in chunk.designs.clone().enumerate() {
            let first = design * motion.shape.positions;
            let rows = first + chunk.positions.start..first + chunk.positions.end;
            let out = index * rows.len();
            let asked = Asked { q: &[], shared: None, index, design, rows, binds: true };
            let done = match self.request.method {
                StepMethod::Even => even.run::<L, G>(self, worker, asked),
                StepMethod::Controlled { pair, relative, absolute } => {
                    controlled.run::<L, G>(self, worker, asked, (pair, (relative, absolute)))
                }
            };
            if !done {
                return;
            }
            match self.request.method {
                StepMethod::Even => {
                    let last = |failed: bool| even.arrays.last_states(failed);
                    self.write(&even.status, last, &mut results, out);
                }
                StepMethod::Controlled { .. } => {
                    let last = [&controlled.q[..], &controlled.speed];
                    self.write(&controlled.status, |_| last, &mut results, out);
                }
            }
        }
    }

    /// Writes the environments of a design; `last`: their last states, of those that have failed or not.
    fn write<'s>(
        &self,
        status: &[u8],
        last: impl Fn(bool) -> [&'s [f64]; 2],
        results: &mut RowSlices<'_>,
        first: usize,
    ) {
        let n = self.drivers();
        for (row, &status) in status.iter().enumerate() {
            results.status[first + row] = MaybeUninit::new(status);
            let is_nan = has_failed(status) && !self.request.holds;
            for (column, values) in results.columns.iter_mut().zip(last(has_failed(status))) {
                for driver in 0..n {
                    let value = if is_nan { f64::NAN } else { values[row * n + driver] };
                    column[(first + row) * n + driver] = MaybeUninit::new(value);
                }
            }
        }
    }
}
