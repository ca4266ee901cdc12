//! Reactions of many designs at many positions.

use std::mem::MaybeUninit;

use super::applied::Values;
use super::columns::{Rows, Solved, Sources, guide_directions};
use super::force_plan::ForcePlan;
use super::pair_forces::{JointForce, Reaction};
use super::scene::Scene;
use crate::batch::chunks::{Chunk, Chunks};
use crate::batch::designs::Designs;
use crate::batch::dispatch::{self, Entry, ForLevel, Task};
use crate::batch::outputs::{Arrays, Column, Quantity};
use crate::batch::request::{Coordinates, Request, Shape, check_arrays, product};
use crate::batch::schedule::Control;
use crate::batch::worker::{Job, Worker};
use crate::batch::writer::{RowSlices, Writer, begins_line, store_pairs, write};
use crate::description::error::SolveError;
use crate::dynamics::machine::Machine;
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::{Mask, Real};
use crate::math::vector::Vector;
use crate::plan::mechanism::Mechanism;
use crate::state::status::Status;
use crate::sweep::scratch::Scratch;

/// Motions of a batch of designs, of which reactions are asked for.
#[derive(Debug, Clone, Copy)]
pub struct ReactionRequest<'a> {
    /// Dimensions: the first of every design, then the second of every design, and so on.
    pub dimensions: &'a [f64],
    /// Coordinates of the drivers, rad or m.
    pub coordinates: Coordinates<'a>,
    /// Assembly signs, +1 or −1 for every dyad with two solutions.
    pub signs: &'a [i8],
    /// Speeds of the drivers: designs × positions × drivers, rad/s or m/s.
    pub speed: &'a [f64],
    /// Their accelerations, rad/s² or m/s².
    pub acceleration: &'a [f64],
    /// Values of the loads' callbacks: designs × positions × callbacks.
    pub external: &'a [f64],
    /// What is asked for.
    pub reactions: &'a [Reaction],
}

impl Machine {
    /// Finds the reactions of designs at positions: one array for each, and the statuses.
    ///
    /// # Errors
    ///
    /// Those of [`crate::fill`]; arrays or inputs of other sizes.
    pub fn reactions(
        &self,
        mechanism: &Mechanism,
        asked: &ReactionRequest<'_>,
        arrays: Arrays<'_>,
        control: &Control<'_>,
    ) -> Result<(), SolveError> {
        let plan = ForcePlan::new(mechanism, self);
        let request = Request {
            dimensions: asked.dimensions,
            coordinates: asked.coordinates,
            signs: asked.signs,
            order: plan.order,
            outputs: &plan.outputs,
            by: None,
        };
        let shape = Shape::of(mechanism, &request)?;
        let rows = product(shape.designs, shape.positions)?;
        let results: Vec<Column> = asked
            .reactions
            .iter()
            .map(|reaction| Column {
                quantity: Quantity::Joint(0),
                order: 0,
                width: reaction.width(),
            })
            .collect();
        check_arrays(&results, &arrays, rows)?;
        let fits = [asked.speed, asked.acceleration]
            .iter()
            .all(|values| values.len() == rows * shape.drivers)
            && (rows == 0 || asked.external.len().is_multiple_of(rows));
        if !fits {
            return Err(SolveError::Shape("speeds, accelerations or values do not fit".into()));
        }
        let columns = request.columns(mechanism);
        let derivatives = DerivativeTables::new(shape.drivers, plan.order);
        let writer = Writer::new(mechanism, &derivatives, &columns);
        let linkage = mechanism.linkage();
        let links_at: Vec<Vec<usize>> =
            (0..linkage.joints.len()).map(|joint| linkage.links_at(joint).collect()).collect();
        let joint_force = |reaction: &Reaction| match *reaction {
            Reaction::Joint { joint, on } => JointForce::new(&plan, &links_at, joint, on),
            _ => JointForce::Free,
        };
        let batch = Batch {
            mechanism,
            machine: self,
            joints: asked.reactions.iter().map(joint_force).collect(),
            sources: Sources::new(&plan, &columns),
            plan: &plan,
            asked,
            request: &request,
            derivatives: &derivatives,
            writer: &writer,
            columns: &columns,
            callbacks: asked.external.len().checked_div(rows).unwrap_or(0),
            shape: &shape,
            control,
        };
        let chunks = Chunks::new(arrays, &results, [shape.designs, shape.positions], shape.drivers);
        dispatch::at_level(control.simd, React { batch: &batch, chunks })
    }
}

/// What all chunks of a batch share.
struct Batch<'b> {
    mechanism: &'b Mechanism,
    machine: &'b Machine,
    plan: &'b ForcePlan,
    sources: Sources,
    joints: Vec<JointForce>,
    asked: &'b ReactionRequest<'b>,
    request: &'b Request<'b>,
    derivatives: &'b DerivativeTables,
    writer: &'b Writer<'b>,
    columns: &'b [Column],
    callbacks: usize,
    shape: &'b Shape,
    control: &'b Control<'b>,
}

struct React<'b, 'r> {
    batch: &'b Batch<'b>,
    chunks: Chunks<'r>,
}

/// What one thread works with.
struct Own<'b, R: Real, const G: usize> {
    worker: Worker<'b, R, G>,
    designs: Designs,
    scratch: Scratch,
    scene: Scene<R>,
    tables: Vec<Vec<f64>>,
}

impl ForLevel for React<'_, '_> {
    type Output = Result<(), SolveError>;

    fn run<L: Entry, const G: usize>(self) -> Self::Output {
        let batch = self.batch;
        let Batch { mechanism, request, derivatives, writer, columns, control, .. } = *batch;
        let own = || Own::<'_, L::Register, G> {
            worker: Worker::new(mechanism, request, derivatives, writer, columns, control),
            designs: Designs::default(),
            scratch: Scratch::new(columns, batch.shape.positions),
            scene: Scene::new(batch.plan),
            tables: vec![Vec::new(); batch.machine.tables.len()],
        };
        let work = |own: &mut Own<'_, L::Register, G>, chunk: &Chunk, rows: RowSlices<'_>| {
            batch.chunk::<L, G>(own, chunk, rows);
        };
        control.run(self.chunks, own, work, |own| own.worker.finish())
    }
}

impl Batch<'_> {
    fn chunk<L: Entry, const G: usize>(
        &self,
        own: &mut Own<'_, L::Register, G>,
        chunk: &Chunk,
        mut results: RowSlices<'_>,
    ) {
        let Shape { designs: all, positions, drivers } = *self.shape;
        let Own { worker, designs, scratch, scene, tables } = own;
        designs.read(self.mechanism, self.asked.dimensions, all, chunk.designs.clone());
        let count = chunk.positions.len();
        for (index, design) in chunk.designs.clone().enumerate() {
            if self.control.is_cancelled() {
                return;
            }
            let q = self.asked.coordinates.of(design, positions * drivers);
            let q = &q[chunk.positions.start * drivers..chunk.positions.end * drivers];
            let row = designs.row(index);
            let first = design * positions + chunk.positions.start;
            let mut rows = scratch.rows();
            let shared = match self.asked.coordinates {
                Coordinates::Shared(_) => Some(chunk.positions.start),
                Coordinates::PerDesign(_) => None,
            };
            let mut job = Job { index: first, shared, ..rows.job(q, design) };
            if worker.bind(row, &mut job) {
                L::run(worker, &mut job);
            }
            let values: Vec<&[f64]> =
                (0..self.columns.len()).map(|column| rows.column(column)).collect();
            for (table, values) in self.machine.tables.iter().zip(tables.iter_mut()) {
                values.clear();
                values.extend(q.iter().step_by(drivers).map(|&q| table.at(q)));
            }
            let drive = first * drivers..(first + count) * drivers;
            let external = first * self.callbacks..(first + count) * self.callbacks;
            let mut task = Evaluate {
                batch: self,
                guides: guide_directions(self.mechanism, row.dimensions),
                solved: Solved {
                    columns: &values,
                    speed: &self.asked.speed[drive.clone()],
                    acceleration: &self.asked.acceleration[drive],
                    positions: count,
                },
                values: Values {
                    tables,
                    external: &self.asked.external[external],
                    callbacks: self.callbacks,
                },
                status: &rows.status()[..count],
                scene,
                results: &mut results,
                first: index * count,
            };
            L::call(&mut task);
        }
        L::Register::fence();
    }
}

/// The reactions of one design at some positions.
struct Evaluate<'e, 'r, R: Real> {
    batch: &'e Batch<'e>,
    guides: Vec<Vector>,
    solved: Solved<'e>,
    values: Values<'e>,
    status: &'e [u8],
    scene: &'e mut Scene<R>,
    results: &'e mut RowSlices<'r>,
    /// Row of the first position.
    first: usize,
}

impl<R: Real> Task<R> for Evaluate<'_, '_, R> {
    #[inline(always)]
    fn run(&mut self) {
        let Batch { plan, machine, sources, .. } = self.batch;
        let count = self.solved.positions;
        for first in (0..count).step_by(R::LANES) {
            let rows = Rows { first, last: count - 1 };
            self.scene.read(plan, sources, &self.guides, &self.solved, rows);
            self.scene.apply(plan, machine, self.values, rows);
            self.scene.start(plan);
            self.scene.carry_loads(plan);
            self.scene.pass_moments(plan);
            let lanes = R::LANES.min(count - first);
            self.write(first, lanes);
            for &stress in &plan.self_stresses {
                self.scene.stress(plan, stress);
                self.scene.carry_loads(plan);
                self.scene.pass_moments(plan);
                self.drop_stressed(first, lanes);
            }
        }
        for (row, &status) in self.status.iter().enumerate() {
            self.results.status[self.first + row] = MaybeUninit::new(status);
            if status > Status::NearSingular as u8 {
                self.write_nan(self.first + row);
            }
        }
    }
}

impl<R: Real> Evaluate<'_, '_, R> {
    /// Force of a guide on what slides there.
    #[inline(always)]
    fn normal(&self, slide: usize) -> R {
        let Some(edge) = self.batch.plan.guide_edges[slide] else { return R::ZERO };
        -self.scene.guides[slide].cross(self.scene.edge_force[edge])
    }

    /// The value of a reaction in all lanes.
    #[inline(always)]
    fn value(&self, index: usize) -> Vector<R> {
        let (reaction, joint) = (self.batch.asked.reactions[index], &self.batch.joints[index]);
        let scene = &*self.scene;
        match reaction {
            Reaction::Joint { .. } => joint.of(scene),
            Reaction::Normal(slide) => one(self.normal(slide)),
            Reaction::Moment(slide) => one(scene.slide_moment[slide]),
            Reaction::Along(slide) => {
                one(scene.slides[slide] + scene.slide_moment[slide] / self.normal(slide))
            }
            Reaction::Driver(driver) => one(scene.driver[driver]),
            Reaction::ShakingForce => scene.shaking_force,
            Reaction::ShakingMoment => one(scene.shaking_moment),
        }
    }

    #[inline(always)]
    fn write(&mut self, first: usize, lanes: usize) {
        for (index, reaction) in self.batch.asked.reactions.iter().enumerate() {
            let value = self.value(index);
            let width = reaction.width();
            let out = &mut self.results.columns[index][(self.first + first) * width..];
            if lanes == R::LANES {
                let out = &mut out[..lanes * width];
                let past = self.results.past_caches && begins_line(out);
                if width == 2 {
                    store_pairs(out, past, value);
                } else {
                    write(out, past, value.x);
                }
                continue;
            }
            for lane in 0..lanes {
                out[lane * width] = MaybeUninit::new(value.x.lane(lane));
                if width == 2 {
                    out[lane * width + 1] = MaybeUninit::new(value.y.lane(lane));
                }
            }
        }
    }

    /// Leaves out what a self-stress changes: it cannot be known.
    #[inline(always)]
    fn drop_stressed(&mut self, first: usize, lanes: usize) {
        let size = self.batch.mechanism.linkage().size();
        for (index, &reaction) in self.batch.asked.reactions.iter().enumerate() {
            let unit = match reaction {
                Reaction::ShakingForce | Reaction::ShakingMoment => continue,
                Reaction::Moment(_) => size,
                Reaction::Along(slide) => {
                    // Known with the normal force and the moment.
                    let moment = self.scene.slide_moment[slide];
                    let stressed = Scene::is_stressed(self.normal(slide), R::ONE)
                        .or(Scene::is_stressed(moment, R::splat(size)));
                    self.drop_lanes(index, [first, lanes], stressed);
                    continue;
                }
                Reaction::Driver(driver) if self.batch.plan.driven_links[driver].is_some() => size,
                _ => 1.0,
            };
            // A force is known as a whole, or not at all: its axes are the drawing's.
            let stressed = Scene::is_stressed(self.value(index).size(), R::splat(unit));
            self.drop_lanes(index, [first, lanes], stressed);
        }
    }

    #[inline(always)]
    fn drop_lanes(&mut self, index: usize, [first, lanes]: [usize; 2], stressed: R::Mask) {
        for lane in (0..lanes).filter(|&lane| stressed.lane(lane)) {
            let width = self.batch.asked.reactions[index].width();
            let row = self.first + first + lane;
            self.results.columns[index][row * width..(row + 1) * width]
                .fill(MaybeUninit::new(f64::NAN));
        }
    }

    fn write_nan(&mut self, row: usize) {
        for (reaction, column) in self.batch.asked.reactions.iter().zip(&mut self.results.columns) {
            let width = reaction.width();
            column[row * width..(row + 1) * width].fill(MaybeUninit::new(f64::NAN));
        }
    }
}

#[inline(always)]
fn one<R: Real>(value: R) -> Vector<R> {
    Vector::new(value, R::ZERO)
}
