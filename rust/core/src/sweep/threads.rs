//! The work of each thread: one design after another, first at the probes.

use std::mem::MaybeUninit;

use super::evaluate_design::{Outcome, SweepBatch};
use super::gradients::Kept;
use crate::batch::chunks::{Chunk, Chunks, DesignRow, Designs};
use crate::batch::dispatch::{Entry, ForLevel};
use crate::batch::rows::{Layout, RowSlices};
use crate::batch::scratch::{CopyRows, Scratch, ScratchRows};
use crate::batch::worker::Worker;
use crate::description::error::SolveError;
use crate::math::lanes::Real;
use crate::sensitivity::evaluate::SensitivitySpace;
use crate::state::status::Status;

/// Designs after which the solver decides whether probes are worth their time, and the least part of them
/// that the probes must drop.
const TRIAL: usize = 64;
const LEAST_PART_DROPPED: usize = 8;

/// Positions of a design that are solved at once: with more, a signal would wait until all are loaded.
const POSITIONS: usize = 65_536;

/// Measures all chunks.
pub(super) struct Measure<'b, 'r> {
    pub batch: &'b SweepBatch<'b>,
    pub chunks: Chunks<'r>,
}

/// The working data of one thread.
struct ThreadState<'b, R: Real, const G: usize> {
    solver: Solver<'b, R, G>,
    designs: Designs,
    scratch: Scratch,
    space: SensitivitySpace<R>,
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
        let SweepBatch { mechanism, request, derivatives, writer, control, .. } = *batch;
        let new_worker = || Worker::new(mechanism, request, derivatives, writer, control);
        let worker = || ThreadState::<'_, L::Register, G> {
            solver: Solver { worker: new_worker(), probe: new_worker(), probed: 0, dropped: 0 },
            designs: Designs::default(),
            scratch: batch.scratch(),
            space: SensitivitySpace::default(),
        };
        let work =
            |state: &mut ThreadState<'_, L::Register, G>, chunk: &Chunk, rows: RowSlices<'_>| {
                batch.measure_chunk::<L, G>(state, chunk, rows);
            };
        control.run(self.chunks, worker, work, |state| {
            state.solver.worker.finish();
            state.solver.probe.finish();
        })
    }
}

impl<R: Real, const G: usize> Solver<'_, R, G> {
    /// Solves and evaluates a design.
    fn solve<L: Entry<Register = R>>(
        &mut self,
        batch: &SweepBatch<'_>,
        (row, design): (DesignRow<'_>, usize),
        rows: &mut ScratchRows<'_>,
        values: &mut [f64],
    ) -> Outcome {
        let (all, q, probes) = (batch.q, batch.course.q, &batch.probes.q[..]);
        let step = batch.course.turn.map(|turn| turn / batch.course.count() as f64);
        if step.is_some_and(|step| self.worker.lengths_miss_position(row, step)) {
            return Outcome::Fails(Status::Unreachable as u8);
        }
        if !self.worker.bind(row, &mut rows.job(all, design)) {
            return batch.evaluate(rows, (row, q), false, values);
        }
        if step.is_some_and(|step| self.worker.misses_position(step)) {
            return Outcome::Fails(Status::Unreachable as u8);
        }
        let is_trial = self.probed < TRIAL || !batch.sweep.conditions.is_empty();
        let is_worth = is_trial || self.dropped * LEAST_PART_DROPPED >= self.probed;
        if is_worth && !probes.is_empty() {
            self.worker.swap_space(&mut self.probe);
            L::run(&mut self.worker, &mut rows.job(probes, design));
            self.worker.swap_space(&mut self.probe);
            batch.copy_rows::<L>(rows, probes);
            let outcome = batch.evaluate(rows, (row, probes), true, values);
            let is_dropped = !matches!(outcome, Outcome::Moves(_));
            self.probed += 1;
            self.dropped += usize::from(is_dropped);
            if is_dropped {
                return outcome;
            }
        }
        let drivers = batch.shape.drivers;
        for (part, q) in all.chunks(POSITIONS * drivers).enumerate() {
            if batch.control.is_cancelled() {
                break;
            }
            L::run(&mut self.worker, &mut rows.part(q, part * POSITIONS, design));
        }
        batch.copy_rows::<L>(rows, all);
        batch.evaluate(rows, (row, q), false, values)
    }
}

impl SweepBatch<'_> {
    /// Gradients read blocks, metrics rows.
    fn scratch(&self) -> Scratch {
        let positions = self.shape.positions;
        if self.gradients.is_empty() {
            return Scratch::new(self.columns, positions, Layout::Rows);
        }
        let is_read = |column: usize| self.sources.iter().any(|of| of.contains(&column));
        Scratch::new(self.columns, positions, Layout::Blocks).copying(self.columns, is_read)
    }

    /// Lets metrics read the positions at `q`.
    fn copy_rows<L: Entry>(&self, rows: &mut ScratchRows<'_>, q: &[f64]) {
        if !self.gradients.is_empty() {
            L::call(&mut CopyRows { rows, count: q.len() / self.shape.drivers });
        }
    }

    /// Measures the designs of a chunk; `results` holds one row a design.
    fn measure_chunk<L: Entry, const G: usize>(
        &self,
        state: &mut ThreadState<'_, L::Register, G>,
        chunk: &Chunk,
        mut results: RowSlices<'_>,
    ) {
        let ThreadState { solver, designs, scratch, space } = state;
        let all = self.shape.designs;
        designs.read(self.mechanism, self.sweep.dimensions, all, chunk.designs.clone());
        let mut rows = scratch.rows();
        let mut values = vec![f64::NAN; self.sweep.metrics.len()];
        for (place, design) in chunk.designs.clone().enumerate() {
            if self.control.is_cancelled() {
                return;
            }
            let row = designs.row(place);
            let outcome = solver.solve::<L>(self, (row, design), &mut rows, &mut values);
            let (status, is_kept) = match outcome {
                Outcome::Moves(status) => (status, true),
                Outcome::Fails(status) => (status, false),
                Outcome::FailsCondition => (Status::Ok as u8, false),
            };
            match outcome {
                Outcome::Moves(_) => {}
                Outcome::Fails(_) => {
                    for (value, metric) in values.iter_mut().zip(self.sweep.metrics) {
                        *value = metric.of_failed();
                    }
                }
                Outcome::FailsCondition => values.fill(f64::NAN),
            }
            if !self.gradients.is_empty() {
                let results = (&mut results, place);
                if is_kept {
                    let slopes = |metric| self.slopes(&rows, (row, self.course.q), metric);
                    let slopes: Vec<_> = self.gradients.metrics().map(slopes).collect();
                    let kept = Kept {
                        design: solver.worker.bound_design(),
                        dimensions: row.dimensions,
                        q: self.course.q,
                        count: self.course.count(),
                        values: &values,
                        slopes: &slopes,
                    };
                    self.gradients.write::<L>(space, &mut rows, &kept, results);
                } else {
                    self.gradients.write_none(values.len(), results);
                }
            }
            values.push(f64::from(u8::from(is_kept)));
            for (column, &value) in results.columns.iter_mut().zip(&values) {
                column[place] = MaybeUninit::new(value);
            }
            values.pop();
            results.status[place] = MaybeUninit::new(status);
        }
        L::Register::fence();
    }
}
