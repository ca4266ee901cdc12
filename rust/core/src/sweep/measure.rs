//! Measures a batch: solves one design after another and keeps the metrics alone.

use std::mem::MaybeUninit;

use super::metric::{Condition, Metric, Positions};
use super::scratch::{Scratch, ScratchRows};
use crate::batch::designs::{DesignRow, Designs};
use crate::batch::dispatch::{self, Entry, ForLevel};
use crate::batch::outputs::{Arrays, Column, Outputs, Quantity};
use crate::batch::request::{Coordinates, Request, Shape};
use crate::batch::schedule::{Chunk, Chunks, Control};
use crate::batch::solve::as_unwritten;
use crate::batch::worker::Worker;
use crate::batch::writer::{RowSlices, Writer};
use crate::description::error::SolveError;
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::{LANES, Real};
use crate::plan::mechanism::Mechanism;
use crate::state::status::Status;

/// Positions that are solved first, spread over all: most designs that do not move over all of these,
/// or miss a condition, are known by them.
const PROBES: usize = LANES;
/// Positions from which that is worth it.
const MANY_POSITIONS: usize = 4 * PROBES;
/// Designs after which it is decided whether probes are worth their time, and the least part of them
/// that these must drop.
const TRIAL: usize = 64;
const LEAST_PART_DROPPED: usize = 8;

/// Code from which a position has failed.
const FIRST_FAILURE: u8 = Status::Unreachable as u8;

/// What to measure.
#[derive(Clone, Copy)]
pub struct Sweep<'a> {
    /// Dimensions: the first of every design, then the second of every design, and so on.
    pub dimensions: &'a [f64],
    /// Coordinates of all designs, rad or m.
    pub q: &'a [f64],
    /// Assembly signs, +1 or −1 for every dyad with two solutions.
    pub signs: &'a [i8],
    /// The metrics.
    pub metrics: &'a [&'a dyn Metric],
    /// What designs must meet, in the order in which it is asked.
    pub conditions: &'a [Condition],
}

/// The metrics of a batch.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Measured {
    /// For every metric, its value of every design; NaN of those that are not kept.
    pub values: Vec<Vec<f64>>,
    /// For every design a [`Status`] code: that of a position that cannot be solved, if there is one.
    pub status: Vec<u8>,
    /// Whether it moves over all positions and meets all conditions.
    pub kept: Vec<bool>,
}

impl<'a> Sweep<'a> {
    /// Designs of a mechanism in the assembly of its drawing, without metrics.
    #[must_use]
    pub fn of(mechanism: &'a Mechanism, dimensions: &'a [f64], q: &'a [f64]) -> Self {
        Self { dimensions, q, signs: mechanism.signs(), metrics: &[], conditions: &[] }
    }
}

impl Mechanism {
    /// Solves designs at positions for their metrics. A design must move over all positions.
    ///
    /// # Errors
    ///
    /// Those of [`Mechanism::solve`]; [`SolveError::Interrupted`] if `control` was cancelled.
    pub fn measure(
        &self,
        sweep: &Sweep<'_>,
        control: &Control<'_>,
    ) -> Result<Measured, SolveError> {
        let (outputs, order) = needed(sweep.metrics);
        let request = Request {
            dimensions: sweep.dimensions,
            coordinates: Coordinates::Shared(sweep.q),
            signs: sweep.signs,
            order,
            outputs: &outputs,
            by: None,
        };
        let shape = Shape::of(self, &request)?;
        if sweep.conditions.iter().any(|condition| condition.metric >= sweep.metrics.len()) {
            return Err(SolveError::Shape("a condition's metric is beyond what there is".into()));
        }
        let columns = request.columns(self);
        let sources = sources(sweep.metrics, &columns);
        let derivatives = DerivativeTables::new(shape.drivers, order);
        let writer = Writer::new(self, &derivatives, &columns);
        let probes = Probes::new(sweep.q, &shape);
        // After the metrics 1 of each design that is kept.
        let mut values = vec![vec![f64::NAN; shape.designs]; sweep.metrics.len() + 1];
        let mut status = vec![Status::Ok as u8; shape.designs];
        #[allow(unsafe_code, reason = "the standard library has no safe form of this yet")]
        // SAFETY: only initialised numbers are stored.
        let arrays = unsafe {
            Arrays {
                columns: values.iter_mut().map(|values| as_unwritten(values)).collect(),
                status: as_unwritten(&mut status),
            }
        };
        let width = Column { quantity: Quantity::Joint(0), order: 0, width: 1 };
        let results = vec![width; sweep.metrics.len() + 1];
        let chunks = Chunks::new(arrays, &results, [shape.designs, 1], shape.drivers);
        let batch = Batch {
            mechanism: self,
            sweep,
            request: &request,
            derivatives: &derivatives,
            writer: &writer,
            columns: &columns,
            sources: &sources,
            probes: &probes,
            shape: &shape,
            control,
        };
        dispatch::at_level(control.simd, Measure { batch: &batch, chunks })?;
        let kept = values.pop().unwrap_or_default().iter().map(|&kept| kept == 1.0).collect();
        Ok(Measured { values, status, kept })
    }
}

/// What all metrics read, each quantity once, and the highest order.
fn needed(metrics: &[&dyn Metric]) -> (Outputs, usize) {
    let mut outputs = Outputs::default();
    let mut highest = 0;
    for need in metrics.iter().flat_map(|metric| metric.needs()) {
        let (list, index) = match need.quantity {
            Quantity::Joint(index) => (&mut outputs.joints, index),
            Quantity::Place(index) => (&mut outputs.places, index),
            Quantity::Slide(index) => (&mut outputs.slides, index),
            Quantity::Angle(index) => (&mut outputs.links, index),
        };
        if !list.contains(&index) {
            list.push(index);
        }
        highest = highest.max(need.order);
    }
    (outputs, highest)
}

/// For every metric the columns that it reads.
fn sources(metrics: &[&dyn Metric], columns: &[Column]) -> Vec<Vec<usize>> {
    let column = |need: super::metric::Need| {
        let is_it = |c: &Column| c.quantity == need.quantity && c.order == need.order;
        columns.iter().position(is_it).unwrap_or(0)
    };
    metrics.iter().map(|metric| metric.needs().into_iter().map(column).collect()).collect()
}

/// The positions that are solved first.
struct Probes {
    places: Vec<usize>,
    q: Vec<f64>,
}

impl Probes {
    fn new(q: &[f64], shape: &Shape) -> Self {
        let are_many = shape.drivers == 1 && shape.positions >= MANY_POSITIONS;
        let count = if are_many { PROBES } else { 0 };
        let places: Vec<usize> = (0..count).map(|k| k * shape.positions / PROBES).collect();
        let q = places.iter().map(|&place| q[place]).collect();
        Self { places, q }
    }
}

/// What all chunks of a batch share.
struct Batch<'b> {
    mechanism: &'b Mechanism,
    sweep: &'b Sweep<'b>,
    request: &'b Request<'b>,
    derivatives: &'b DerivativeTables,
    writer: &'b Writer<'b>,
    columns: &'b [Column],
    sources: &'b [Vec<usize>],
    probes: &'b Probes,
    shape: &'b Shape,
    control: &'b Control<'b>,
}

/// What becomes of a design.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Outcome {
    /// It moves, with the worst status of its positions.
    Moves(u8),
    /// A position has failed, with this status.
    Fails(u8),
    /// It misses a condition.
    Misses,
}

struct Measure<'b, 'r> {
    batch: &'b Batch<'b>,
    chunks: Chunks<'r>,
}

/// What one thread works with.
struct Own<'b, R: Real, const G: usize> {
    solver: Solver<'b, R, G>,
    designs: Designs,
    scratch: Scratch,
}

/// Solves designs, first at the probes.
struct Solver<'b, R: Real, const G: usize> {
    worker: Worker<'b, R, G>,
    /// Holds the work space of probes.
    probe: Worker<'b, R, G>,
    /// Designs probed, and those dropped by that.
    probed: usize,
    dropped: usize,
}

impl ForLevel for Measure<'_, '_> {
    type Output = Result<(), SolveError>;

    fn run<L: Entry, const G: usize>(self) -> Self::Output {
        let batch = self.batch;
        let Batch { mechanism, request, derivatives, writer, columns, control, .. } = *batch;
        let one = || Worker::new(mechanism, request, derivatives, writer, columns, control);
        let worker = || Own::<'_, L::Register, G> {
            solver: Solver { worker: one(), probe: one(), probed: 0, dropped: 0 },
            designs: Designs::default(),
            scratch: Scratch::new(columns, batch.shape.positions),
        };
        let work = |own: &mut Own<'_, L::Register, G>, chunk: &Chunk, rows: RowSlices<'_>| {
            batch.measure_chunk::<L, G>(own, chunk, rows);
        };
        control.run(self.chunks, worker, work, |own| {
            own.solver.worker.finish();
            own.solver.probe.finish();
        })
    }
}

impl<R: Real, const G: usize> Solver<'_, R, G> {
    /// Solves and judges a design.
    fn solve<L: Entry<Register = R>>(
        &mut self,
        batch: &Batch<'_>,
        (row, design): (DesignRow<'_>, usize),
        rows: &mut ScratchRows<'_>,
        found: &mut [f64],
    ) -> Outcome {
        let (q, probes) = (batch.sweep.q, &batch.probes.q[..]);
        if !self.worker.bind(row, &mut rows.job(q, design)) {
            return batch.judge(rows, (row, q), false, found);
        }
        let is_trial = self.probed < TRIAL || !batch.sweep.conditions.is_empty();
        let is_worth = is_trial || self.dropped * LEAST_PART_DROPPED >= self.probed;
        if is_worth && !probes.is_empty() {
            self.worker.swap_space(&mut self.probe);
            L::run(&mut self.worker, &mut rows.job(probes, design));
            self.worker.swap_space(&mut self.probe);
            let outcome = batch.judge(rows, (row, probes), true, found);
            let is_dropped = !matches!(outcome, Outcome::Moves(_));
            self.probed += 1;
            self.dropped += usize::from(is_dropped);
            if is_dropped {
                return outcome;
            }
        }
        L::run(&mut self.worker, &mut rows.job(q, design));
        batch.judge(rows, (row, q), false, found)
    }
}

impl Batch<'_> {
    /// Measures the designs of a chunk; `results` holds one row a design.
    fn measure_chunk<L: Entry, const G: usize>(
        &self,
        own: &mut Own<'_, L::Register, G>,
        chunk: &Chunk,
        mut results: RowSlices<'_>,
    ) {
        let Own { solver, designs, scratch } = own;
        let all = self.shape.designs;
        designs.read(self.mechanism, self.sweep.dimensions, all, chunk.designs.clone());
        let mut rows = scratch.rows();
        let mut found = vec![f64::NAN; self.sweep.metrics.len()];
        for (place, design) in chunk.designs.clone().enumerate() {
            if self.control.is_cancelled() {
                return;
            }
            let row = designs.row(place);
            let outcome = solver.solve::<L>(self, (row, design), &mut rows, &mut found);
            let (status, is_kept) = match outcome {
                Outcome::Moves(status) => (status, true),
                Outcome::Fails(status) => (status, false),
                Outcome::Misses => (Status::Ok as u8, false),
            };
            if !is_kept {
                found.fill(f64::NAN);
            }
            found.push(f64::from(u8::from(is_kept)));
            for (column, &value) in results.columns.iter_mut().zip(&found) {
                column[place] = MaybeUninit::new(value);
            }
            found.pop();
            results.status[place] = MaybeUninit::new(status);
        }
        L::Register::fence();
    }

    /// What becomes of a design, given its positions at `q`, all or the probes alone; and its metrics,
    /// of all.
    fn judge(
        &self,
        rows: &ScratchRows<'_>,
        (row, q): (DesignRow<'_>, &[f64]),
        are_probes: bool,
        found: &mut [f64],
    ) -> Outcome {
        let status = &rows.status()[..q.len() / self.shape.drivers];
        let worst = status.iter().fold(0, |worst, &code| worst.max(code));
        if worst >= FIRST_FAILURE {
            // The probes come first, whether or not they were solved before.
            let places: &[usize] = if are_probes { &[] } else { &self.probes.places };
            let mut all = places.iter().map(|&place| &status[place]).chain(status);
            let failed = all.find(|&&code| code >= FIRST_FAILURE);
            return Outcome::Fails(failed.copied().unwrap_or(worst));
        }
        let metrics = self.sweep.metrics;
        found.fill(f64::NAN);
        for condition in self.sweep.conditions {
            let metric = metrics[condition.metric];
            if !are_probes || condition.stays_false(metric.growth()) {
                let value = self.value(rows, (row, q), condition.metric, worst);
                found[condition.metric] = value;
                // A part of the positions may have no probe.
                if !(condition.holds(value) || are_probes && value.is_nan()) {
                    return Outcome::Misses;
                }
            }
        }
        if !are_probes {
            let asked = |metric: usize| self.sweep.conditions.iter().any(|c| c.metric == metric);
            for metric in (0..metrics.len()).filter(|&metric| !asked(metric)) {
                found[metric] = self.value(rows, (row, q), metric, worst);
            }
        }
        Outcome::Moves(worst)
    }

    /// A metric of the positions at `q`, whose worst status is given. At singular ones there are no
    /// derivatives.
    fn value(
        &self,
        rows: &ScratchRows<'_>,
        (row, q): (DesignRow<'_>, &[f64]),
        metric: usize,
        worst: u8,
    ) -> f64 {
        let is_derivative = |&column: &usize| self.columns[column].order > 0;
        if worst >= Status::Singular as u8 && self.sources[metric].iter().any(is_derivative) {
            return f64::NAN;
        }
        let positions = q.len() / self.shape.drivers;
        let column = |&index: &usize| &rows.column(index)[..positions * self.columns[index].width];
        let values: Vec<&[f64]> = self.sources[metric].iter().map(column).collect();
        let positions = Positions { q, dimensions: row.dimensions, values: &values };
        self.sweep.metrics[metric].of(&positions)
    }
}
