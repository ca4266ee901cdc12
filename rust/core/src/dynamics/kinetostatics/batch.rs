//! Reactions of many designs at many positions.

use super::evaluate::{Evaluate, ReactionBatch};
use super::followed::{Drivers, Followed};
use super::request::{Reaction, ReactionRequest};
use super::squares::Squares;
use crate::batch::chunks::{Chunk, Chunks, Designs};
use crate::batch::dispatch::{self, Entry, ForLevel};
use crate::batch::request::{
    Arrays, Column, Coordinates, Quantity, Request, Shape, check_arrays, product,
};
use crate::batch::schedule::Control;
use crate::batch::scratch::Scratch;
use crate::batch::worker::{Job, Worker};
use crate::batch::writer::{RowSlices, Writer};
use crate::description::error::SolveError;
use crate::dynamics::friction::pairs::FrictionPair;
use crate::dynamics::friction::workspace::FrictionWorkspace;
use crate::dynamics::machine::Machine;
use crate::dynamics::pair_friction::Friction;
use crate::dynamics::reactions::applied::Values;
use crate::dynamics::reactions::columns::{Solved, Sources, guide_directions};
use crate::dynamics::reactions::force_plan::ForcePlan;
use crate::dynamics::reactions::pair_forces::JointForce;
use crate::dynamics::reactions::scene::Scene;
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::Real;
use crate::plan::mechanism::Mechanism;

impl Machine {
    /// Finds the reactions of designs at positions: one array for each, and the statuses. With
    /// [`squares`](ReactionRequest::squares) each array has two numbers per design, NaN if a position has no
    /// value, and the status of a design is the worst of its positions.
    ///
    /// # Errors
    ///
    /// Those of [`crate::fill`]; arrays or inputs of other sizes.
    pub fn reactions(
        &self,
        mechanism: &Mechanism,
        request: &ReactionRequest<'_>,
        arrays: Arrays<'_>,
        control: &Control<'_>,
    ) -> Result<(), SolveError> {
        let plan = ForcePlan::new(mechanism, self);
        let solve_request = Request {
            dimensions: request.dimensions,
            coordinates: request.coordinates,
            signs: request.signs,
            order: plan.order,
            outputs: &plan.outputs,
            by: None,
        };
        let shape = Shape::of(mechanism, &solve_request)?;
        let rows = product(shape.designs, shape.positions)?;
        let results: Vec<Column> = request
            .reactions
            .iter()
            .map(|reaction| Column {
                quantity: Quantity::Joint(0),
                order: 0,
                width: if request.squares { 2 } else { reaction.width() },
            })
            .collect();
        let written = if request.squares { 1 } else { shape.positions };
        check_arrays(&results, &arrays, product(shape.designs, written)?)?;
        let fits = [request.speed, request.acceleration]
            .iter()
            .all(|values| [rows * shape.drivers, shape.drivers].contains(&values.len()))
            && (rows == 0 || request.external.len().is_multiple_of(rows));
        if !fits {
            return Err(SolveError::Shape("speeds, accelerations or values do not fit".into()));
        }
        let derivatives = DerivativeTables::new(shape.drivers, plan.order);
        let writer = Writer::of(mechanism, &derivatives, &solve_request);
        Scratch::check(&writer.columns, shape.positions, control)?;
        let linkage = mechanism.linkage();
        let links_at: Vec<Vec<usize>> =
            (0..linkage.joints.len()).map(|joint| linkage.links_at(joint).collect()).collect();
        let joint_force = |reaction: &Reaction| match *reaction {
            Reaction::Joint { joint, on } => JointForce::new(&plan, &links_at, joint, on),
            _ => JointForce::Free,
        };
        let balances = !request.reactions.iter().all(|reaction| reaction.is_given());
        let friction: &[Friction] = if balances { &self.friction } else { &[] };
        let batch = ReactionBatch {
            mechanism,
            machine: self,
            balances,
            joints: request.reactions.iter().map(joint_force).collect(),
            friction: FrictionPair::of(&plan, &links_at, friction),
            sources: Sources::new(&plan, &writer.columns),
            plan: &plan,
            request,
            solve_request: &solve_request,
            derivatives: &derivatives,
            writer: &writer,
            columns: &writer.columns,
            callbacks: request.external.len().checked_div(rows).unwrap_or(0),
            shape: &shape,
            control,
        };
        let chunks = Chunks::new(arrays, &results, [shape.designs, written], shape.drivers);
        dispatch::at_level(control.simd, React { batch: &batch, chunks })
    }
}

struct React<'b, 'r> {
    batch: &'b ReactionBatch<'b>,
    chunks: Chunks<'r>,
}

/// The working data of one thread.
struct ThreadState<'b, R: Real, const G: usize> {
    worker: Worker<'b, R, G>,
    designs: Designs,
    scratch: Scratch,
    scene: Scene<R>,
    friction: FrictionWorkspace<R>,
    tables: Vec<Vec<f64>>,
    followed: Followed,
    squares: Vec<Squares<R>>,
}

impl ForLevel for React<'_, '_> {
    type Output = Result<(), SolveError>;

    fn run<L: Entry, const G: usize>(self) -> Self::Output {
        let batch = self.batch;
        let ReactionBatch {
            mechanism, solve_request, derivatives, writer, columns, control, ..
        } = *batch;
        let new_state = || ThreadState::<'_, L::Register, G> {
            worker: Worker::new(mechanism, solve_request, derivatives, writer, control),
            designs: Designs::default(),
            scratch: Scratch::new(columns, batch.shape.positions),
            scene: Scene::new(batch.plan),
            friction: FrictionWorkspace::default(),
            tables: vec![Vec::new(); batch.machine.tables.len()],
            followed: Followed::default(),
            squares: Vec::new(),
        };
        let work =
            |state: &mut ThreadState<'_, L::Register, G>, chunk: &Chunk, rows: RowSlices<'_>| {
                batch.chunk::<L, G>(state, chunk, rows);
            };
        control.run(self.chunks, new_state, work, |state| state.worker.finish())
    }
}

impl ReactionBatch<'_> {
    fn chunk<L: Entry, const G: usize>(
        &self,
        state: &mut ThreadState<'_, L::Register, G>,
        chunk: &Chunk,
        mut results: RowSlices<'_>,
    ) {
        let Shape { designs: all, positions, drivers } = *self.shape;
        let ThreadState { worker, designs, scratch, scene, friction, tables, followed, squares } =
            state;
        designs.read(self.mechanism, self.request.dimensions, all, chunk.designs.clone());
        // Squares cover all positions.
        let range = if self.request.squares { 0..positions } else { chunk.positions.clone() };
        let count = range.len();
        for (index, design) in chunk.designs.clone().enumerate() {
            if self.control.is_cancelled() {
                return;
            }
            let q = self.request.coordinates.of(design, positions * drivers);
            let q = &q[range.start * drivers..range.end * drivers];
            let row = designs.row(index);
            let first = design * positions + range.start;
            let mut rows = scratch.rows();
            let shared = match self.request.coordinates {
                Coordinates::Shared(_) => Some(range.start),
                Coordinates::PerDesign(_) => None,
            };
            let mut job = Job { index: first, shared, ..rows.job(q, design) };
            if worker.bind(row, &mut job) {
                L::run(worker, &mut job);
            }
            let size = worker.size();
            let unit = |link: &Option<usize>| if link.is_some() { 1.0 } else { size };
            let units: Vec<f64> = self.plan.driven_links.iter().map(unit).collect();
            let values: Vec<&[f64]> =
                (0..self.columns.len()).map(|column| rows.column(column)).collect();
            for (table, values) in self.machine.tables.iter().zip(tables.iter_mut()) {
                values.clear();
                values.extend(q.iter().step_by(drivers).map(|&q| table.at(q)));
            }
            let drive = |all: &'_ [f64]| {
                if all.len() == drivers {
                    0..drivers
                } else {
                    first * drivers..(first + count) * drivers
                }
            };
            let external = first * self.callbacks..(first + count) * self.callbacks;
            let solved = Solved {
                columns: &values,
                speed: &self.request.speed[drive(self.request.speed)],
                acceleration: &self.request.acceleration[drive(self.request.acceleration)],
                positions: count,
            };
            if self.machine.follows() {
                let drivers = Drivers { q, units: &units, sense: self.request.sense };
                followed.read(self.machine, &self.sources, &solved, drivers, size);
            }
            let mut task = Evaluate {
                batch: self,
                guides: guide_directions(self.mechanism, row.dimensions),
                size,
                solved,
                values: Values {
                    tables,
                    over: &followed.over,
                    ways: &followed.ways,
                    external: &self.request.external[external],
                    callbacks: self.callbacks,
                },
                status: &rows.status()[..count],
                scene,
                friction,
                results: &mut results,
                squares,
                first: if self.request.squares { index } else { index * count },
            };
            L::call(&mut task);
        }
        L::Register::fence();
    }
}
