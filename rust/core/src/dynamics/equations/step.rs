//! Steps in time of many environments of a machine: the classical Runge-Kutta method of order 4 (W. Kutta
//! 1901), efforts constant over a step. An environment has the bits that it has alone.

use std::mem::MaybeUninit;

use super::equation_batch::EquationBatch;
use super::evaluate::Equation;
use super::plan::EquationPlan;
use super::request::{EquationRequest, Term};
use super::stage::{LONGEST, Stage, StageArrays, note};
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
use crate::dynamics::kinetostatics::positions::{DesignPositions, Positions, of_rows};
use crate::dynamics::machine::Machine;
use crate::dynamics::reactions::scene::Scene;
use crate::dynamics::variation::{self, Variation};
use crate::math::lanes::Real;
use crate::plan::mechanism::Mechanism;
use crate::state::status::Status;

/// Environments of a chunk: what they need stays in the caches.
const CHUNK: usize = 128;
/// Stages of a step; one more shows whether the last state exists.
const STAGES: usize = 4;

/// Environments, each a state of a design, and the steps that they make.
#[derive(Debug, Clone, Copy)]
pub struct StepRequest<'a> {
    /// Dimensions: the first of every design, then the second of every design, and so on.
    pub dimensions: &'a [f64],
    /// Assembly signs, +1 or −1 for every dyad with two solutions.
    pub signs: &'a [i8],
    /// Coordinates and speeds of the drivers: designs × environments × drivers.
    pub q: &'a [f64],
    /// See `q`.
    pub speed: &'a [f64],
    /// Efforts of the drivers, N·m or N, in that layout, or one for all.
    pub effort: &'a [f64],
    /// Whether the motors act, too.
    pub has_motors: bool,
    /// Numbers of bodies, loads and motors that differ from machine to machine. May be empty.
    pub variations: &'a [Variation<'a>],
    /// Time of a step, s.
    pub dt: f64,
    /// Number of steps.
    pub steps: u64,
    /// Whether an environment that cannot go on keeps its last state; else it has NaN.
    pub holds: bool,
}

impl Machine {
    /// Steps environments in time: writes coordinates, speeds and statuses.
    ///
    /// # Errors
    ///
    /// Those of [`crate::fill`]; arrays or inputs of other sizes.
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

struct StepBatch<'b> {
    equations: EquationBatch<'b>,
    request: &'b StepRequest<'b>,
}

struct Steps<'b, 'r> {
    batch: &'b StepBatch<'b>,
    chunks: Chunks<'r>,
}

/// The working data of one thread.
struct ThreadState<'b, R: Real, const G: usize> {
    positions: Positions<'b, R, G>,
    scene: Scene<R>,
    equation: Equation<R>,
    efforts: Vec<f64>,
    arrays: StageArrays,
    status: Vec<u8>,
}

impl<'b> ForLevel for Steps<'b, '_> {
    type Output = Result<(), SolveError>;

    fn run<L: Entry, const G: usize>(self) -> Self::Output {
        let batch = self.batch;
        let new_state = || ThreadState::<'b, L::Register, G> {
            positions: batch.equations.positions.thread(),
            scene: Scene::new(batch.equations.positions.plan, batch.equations.positions.machine),
            equation: Equation::default(),
            efforts: Vec::new(),
            arrays: StageArrays::default(),
            status: Vec::new(),
        };
        let work =
            |state: &mut ThreadState<'b, L::Register, G>, chunk: &Chunk, rows: RowSlices<'_>| {
                batch.chunk::<L, G>(state, chunk, rows);
            };
        let control = batch.equations.positions.motion.control;
        control.run(self.chunks, new_state, work, |state| state.positions.finish())
    }
}

impl<'b> StepBatch<'b> {
    fn chunk<L: Entry, const G: usize>(
        &self,
        state: &mut ThreadState<'b, L::Register, G>,
        chunk: &Chunk,
        mut results: RowSlices<'_>,
    ) {
        let n = self.equations.positions.plan.drivers;
        self.equations.positions.motion.read_designs(&mut state.positions.motion, chunk);
        for (index, design) in chunk.designs.clone().enumerate() {
            let first = design * self.equations.positions.motion.shape.positions;
            let rows = first + chunk.positions.start..first + chunk.positions.end;
            let asked =
                Asked { q: &[], shared: None, index, design, rows: rows.clone(), binds: true };
            state.arrays.start(
                &self.request.q[rows.start * n..rows.end * n],
                &self.request.speed[rows.start * n..rows.end * n],
            );
            state.status.clear();
            state.status.resize(rows.len(), Status::Ok as u8);
            if !self.steps::<L, G>(state, asked) {
                return;
            }
            self.write(state, &mut results, index * rows.len());
        }
    }

    /// Makes all steps of some environments of a design; false if the work was cancelled.
    fn steps<L: Entry, const G: usize>(
        &self,
        state: &mut ThreadState<'b, L::Register, G>,
        mut asked: Asked<'_>,
    ) -> bool {
        let mechanism = self.equations.positions.motion.mechanism;
        let n = self.equations.positions.plan.drivers;
        let slides = (0..n).any(|driver| mechanism.plan().driven_slide(driver).is_some());
        for _ in 0..self.request.steps {
            if self.equations.positions.motion.control.is_cancelled() {
                return false;
            }
            for stage in 0..STAGES {
                if !self.stage::<L, G>(state, &asked, stage) {
                    state.status.fill(Status::BadDimension as u8);
                    return true;
                }
                // The reach of driven slides belongs to the design that is bound.
                asked.binds = slides;
            }
            state.arrays.finish_step(&state.status, n);
        }
        // The last state must exist, too.
        if self.stage::<L, G>(state, &asked, STAGES) {
            state.arrays.finish_step(&state.status, n);
        }
        true
    }

    /// Computes one stage of a step; false if the design has invalid dimensions.
    fn stage<L: Entry, const G: usize>(
        &self,
        state: &mut ThreadState<'b, L::Register, G>,
        asked: &Asked<'_>,
        stage: usize,
    ) -> bool {
        let ThreadState { positions, scene, equation, efforts, arrays, status } = state;
        let batch = &self.equations;
        let (request, n) = (self.request, batch.positions.plan.drivers);
        let [q, speed] = arrays.take_stage();
        let stage_asked = Asked { q: &q, rows: asked.rows.clone(), ..*asked };
        let is_valid = batch.positions.solve_design::<L, G>(
            positions,
            &stage_asked,
            &speed,
            &mut |design: DesignPositions<'_>| {
                if stage == 0 {
                    refuse_long_steps(&speed, request.dt, (design.size, batch), status);
                }
                for (status, &now) in status.iter_mut().zip(design.status) {
                    // At a change point there is a motion through it.
                    if now != Status::Singular as u8 {
                        note(status, now);
                    }
                }
                if stage == 0 {
                    arrays.keep_good(&q, &speed, status);
                }
                if stage == STAGES {
                    return;
                }
                let mut effort = of_rows(request.effort, n, &design.rows);
                if request.has_motors {
                    let count = design.status.len();
                    batch.add_motors(&design.values, &speed, effort, count, efforts);
                    effort = efforts;
                }
                let mut task = Stage {
                    batch,
                    design,
                    scene: &mut *scene,
                    equation: &mut *equation,
                    effort,
                    speed: &speed,
                    arrays: &mut *arrays,
                    status: &mut *status,
                    dt: request.dt,
                    number: stage,
                };
                L::call(&mut task);
            },
        );
        if stage == STAGES {
            arrays.put_back([q, speed]);
        } else {
            arrays.go_on([q, speed]);
        }
        is_valid
    }

    fn write<R: Real, const G: usize>(
        &self,
        state: &ThreadState<'b, R, G>,
        results: &mut RowSlices<'_>,
        first: usize,
    ) {
        let n = self.equations.positions.plan.drivers;
        for (row, &status) in state.status.iter().enumerate() {
            results.status[first + row] = MaybeUninit::new(status);
            let fails = status > Status::NearSingular as u8 && !self.request.holds;
            let [q, speed] = state.arrays.last_states(status > Status::NearSingular as u8);
            for (column, values) in results.columns.iter_mut().zip([q, speed]) {
                for driver in 0..n {
                    let value = if fails { f64::NAN } else { values[row * n + driver] };
                    column[(first + row) * n + driver] = MaybeUninit::new(value);
                }
            }
        }
    }
}

/// Marks the environments whose drivers would go too far in one step.
fn refuse_long_steps(
    speed: &[f64],
    dt: f64,
    (size, batch): (f64, &EquationBatch<'_>),
    status: &mut [u8],
) {
    let links = &batch.positions.plan.driven_links;
    for (speeds, status) in speed.chunks_exact(links.len()).zip(status) {
        for (speed, link) in speeds.iter().zip(links) {
            let longest = if link.is_some() { LONGEST } else { LONGEST * size };
            // NaN is too long, too.
            let is_short = (speed * dt).abs() <= longest;
            if !is_short {
                note(status, Status::BadInput as u8);
            }
        }
    }
}
