//! Reactions of many designs at many positions.

use super::evaluate::{Evaluate, ReactionBatch};
use super::positions::{Driven, MachineBatch, Positions};
use super::request::{Reaction, ReactionRequest};
use super::squares::Squares;
use crate::batch::chunks::{Chunk, Chunks, most_positions};
use crate::batch::dispatch::{self, Entry, ForLevel};
use crate::batch::motion::MotionBatch;
use crate::batch::request::{Arrays, Column, Quantity, Request, Shape, check_arrays, product};
use crate::batch::rows::RowSlices;
use crate::batch::schedule::Control;
use crate::batch::writer::Writer;
use crate::description::error::SolveError;
use crate::dynamics::friction::pairs::FrictionPair;
use crate::dynamics::friction::workspace::FrictionWorkspace;
use crate::dynamics::machine::Machine;
use crate::dynamics::pair_friction::Friction;
use crate::dynamics::reactions::columns::Sources;
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
        let derivatives = DerivativeTables::new(shape.drivers, plan.order);
        let writer = Writer::of(mechanism, &derivatives, &solve_request);
        let linkage = mechanism.linkage();
        let links_at: Vec<Vec<usize>> =
            (0..linkage.joints.len()).map(|joint| linkage.links_at(joint).collect()).collect();
        let joint_force = |reaction: &Reaction| match *reaction {
            Reaction::Joint { joint, on } => JointForce::new(&plan, &links_at, joint, on),
            _ => JointForce::Free,
        };
        let balances = !request.reactions.iter().all(|reaction| reaction.is_given());
        let friction: &[Friction] = if balances { &self.friction } else { &[] };
        let sources = Sources::new(&plan, &writer.columns);
        let batch = ReactionBatch {
            balances,
            joints: request.reactions.iter().map(joint_force).collect(),
            friction: FrictionPair::of(&plan, &links_at, friction),
            request,
            positions: MachineBatch {
                motion: MotionBatch {
                    mechanism,
                    request: &solve_request,
                    derivatives: &derivatives,
                    writer: &writer,
                    shape: &shape,
                    // Squares cover all positions.
                    most: if request.squares {
                        shape.positions
                    } else {
                        most_positions(shape.positions)
                    },
                    control,
                },
                machine: self,
                sources: &sources,
                plan: &plan,
                driven: Driven {
                    speed: request.speed,
                    acceleration: request.acceleration,
                    external: request.external,
                    sense: request.sense,
                },
                callbacks: request.external.len().checked_div(rows).unwrap_or(0),
                variations: &[],
            },
        };
        batch.positions.check()?;
        let mut chunks = Chunks::new(arrays, &results, [shape.designs, written], shape.drivers);
        chunks.lengthen(mechanism, &writer);
        dispatch::at_level(control.simd, React { batch: &batch, chunks })
    }
}

struct React<'b, 'r> {
    batch: &'b ReactionBatch<'b>,
    chunks: Chunks<'r>,
}

/// The working data of one thread.
struct ThreadState<'b, R: Real, const G: usize> {
    positions: Positions<'b, R, G>,
    scene: Scene<R>,
    friction: FrictionWorkspace<R>,
    squares: Vec<Squares<R>>,
}

impl<'b> ForLevel for React<'b, '_> {
    type Output = Result<(), SolveError>;

    fn run<L: Entry, const G: usize>(self) -> Self::Output {
        let batch = self.batch;
        let new_state = || ThreadState::<'b, L::Register, G> {
            positions: batch.positions.thread(),
            scene: Scene::new(batch.positions.plan, batch.positions.machine),
            friction: FrictionWorkspace::default(),
            squares: Vec::new(),
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

impl<'b> ReactionBatch<'b> {
    fn chunk<L: Entry, const G: usize>(
        &self,
        state: &mut ThreadState<'b, L::Register, G>,
        chunk: &Chunk,
        mut results: RowSlices<'_>,
    ) {
        let ThreadState { positions, scene, friction, squares } = state;
        // Squares cover all positions.
        let whole = self.request.squares;
        self.positions.solve::<L, G>(positions, chunk, whole, |design| {
            let count = design.status.len();
            let mut task = Evaluate {
                batch: self,
                first: if whole { design.index } else { design.index * count },
                design,
                scene,
                friction,
                results: &mut results,
                squares,
            };
            L::call(&mut task);
        });
    }
}
