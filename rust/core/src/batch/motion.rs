//! The motion of many designs, solved chunk by chunk into memory that is read at once: for results that
//! follow from it.

use std::ops::Range;
use std::sync::Arc;

use super::chunks::{Chunk, Designs};
use super::dispatch::Entry;
use super::request::{Coordinates, Request, Shape};
use super::rows::Layout;
use super::schedule::Control;
use super::scratch::Scratch;
use super::worker::{Job, Worker};
use super::writer::Writer;
use crate::branch::design::Design;
use crate::description::error::SolveError;
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::Real;
use crate::plan::mechanism::Mechanism;

/// What all chunks share.
#[derive(Clone, Copy)]
pub(crate) struct MotionBatch<'b> {
    pub mechanism: &'b Mechanism,
    pub request: &'b Request<'b>,
    pub derivatives: &'b DerivativeTables,
    pub writer: &'b Arc<Writer>,
    pub shape: &'b Shape,
    /// Most positions of a design that are solved at once: room for all of them would take seconds.
    pub most: usize,
    pub control: &'b Control<'b>,
}

/// The working data of one thread.
pub(crate) struct MotionWorker<'b, R: Real, const G: usize> {
    worker: Worker<'b, R, G>,
    designs: Designs,
    scratch: Scratch,
}

/// Positions of one design to solve.
pub(crate) struct Asked<'a> {
    /// Coordinates of the drivers, drivers fastest.
    pub q: &'a [f64],
    /// Offset into the shared coordinates, if shared.
    pub shared: Option<usize>,
    /// Index of the design in its chunk, and in the batch.
    pub index: usize,
    pub design: usize,
    /// Rows of the whole batch.
    pub rows: Range<usize>,
    /// Whether the design must be bound; else it is the one of the last call.
    pub binds: bool,
}

/// The solved positions of one design of a chunk.
pub(crate) struct SolvedDesign<'d, 'b> {
    /// Coordinates of the drivers, drivers fastest.
    pub q: &'d [f64],
    /// Index of the design in its chunk.
    pub index: usize,
    /// Rows of the whole batch.
    pub rows: Range<usize>,
    pub dimensions: &'d [f64],
    /// The columns of the request, with [`Layout::Blocks`].
    pub columns: &'d [&'d [f64]],
    pub status: &'d [u8],
    /// Whether all dimensions are in range; if not, `design` is another.
    pub is_valid: bool,
    pub design: &'d Design<'b>,
}

impl<'b> MotionBatch<'b> {
    /// Whether memory has room for the work of the threads.
    pub(crate) fn check(&self) -> Result<(), SolveError> {
        Scratch::check(&self.writer.columns, self.most, self.control)
    }

    /// The working data of a thread.
    pub(crate) fn thread<R: Real, const G: usize>(&self) -> MotionWorker<'b, R, G> {
        let Self { mechanism, request, derivatives, writer, control, .. } = *self;
        MotionWorker {
            worker: Worker::new(mechanism, request, derivatives, writer, control),
            designs: Designs::default(),
            scratch: Scratch::new(&writer.columns, self.most, Layout::Blocks),
        }
    }

    /// What to solve of each design of a chunk, one after another, until the work is cancelled. `whole`: all
    /// positions of each, not those of the chunk.
    pub(crate) fn designs(
        &self,
        chunk: &Chunk,
        whole: bool,
    ) -> impl Iterator<Item = Asked<'b>> + use<'b> {
        let Shape { positions, drivers, .. } = *self.shape;
        let range = if whole { 0..positions } else { chunk.positions.clone() };
        let (coordinates, control) = (self.request.coordinates, self.control);
        let designs = chunk.designs.clone().enumerate();
        designs.take_while(|_| !control.is_cancelled()).map(move |(index, design)| {
            let q = coordinates.of(design, positions * drivers);
            let first = design * positions + range.start;
            Asked {
                q: &q[range.start * drivers..range.end * drivers],
                shared: match coordinates {
                    Coordinates::Shared(_) => Some(range.start),
                    Coordinates::PerDesign(_) => None,
                },
                index,
                design,
                rows: first..first + range.len(),
                binds: true,
            }
        })
    }

    /// Reads the dimensions of the designs of a chunk.
    pub(crate) fn read_designs<R: Real, const G: usize>(
        &self,
        state: &mut MotionWorker<'b, R, G>,
        chunk: &Chunk,
    ) {
        let dimensions = self.request.dimensions;
        state.designs.read(self.mechanism, dimensions, self.shape.designs, chunk.designs.clone());
    }

    /// Solves some positions of one design of the chunk whose designs were read.
    pub(crate) fn solve<L: Entry, const G: usize>(
        &self,
        state: &mut MotionWorker<'b, L::Register, G>,
        asked: &Asked<'_>,
        read: impl FnOnce(SolvedDesign<'_, 'b>),
    ) {
        let MotionWorker { worker, designs, scratch } = state;
        let &Asked { q, shared, index, design, ref rows, binds } = asked;
        let row = designs.row(index);
        let mut scratch_rows = scratch.rows();
        let mut job = Job { index: rows.start, shared, ..scratch_rows.job(q, design) };
        let is_valid = !binds || worker.bind(row, &mut job);
        if is_valid {
            L::run(worker, &mut job);
        }
        scratch_rows.repeat_last(rows.len());
        let columns: Vec<&[f64]> =
            (0..self.writer.columns.len()).map(|column| scratch_rows.column(column)).collect();
        read(SolvedDesign {
            q,
            index,
            rows: rows.clone(),
            dimensions: row.dimensions,
            columns: &columns,
            status: &scratch_rows.status()[..rows.len()],
            is_valid,
            design: worker.bound_design(),
        });
    }
}

impl<R: Real, const G: usize> MotionWorker<'_, R, G> {
    /// Keeps the work space for later calls.
    pub(crate) fn finish(self) {
        self.worker.finish();
    }
}
