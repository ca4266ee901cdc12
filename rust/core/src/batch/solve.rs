//! Solves a request (designs, coordinates, outputs) into arrays.

use std::mem::MaybeUninit;
use std::sync::Arc;

use super::chunks::{Chunk, Chunks, Designs};
use super::dispatch::{self, Entry, ForLevel};
use super::request::{
    Arrays, Coordinates, Motion, Quantity, Request, Series, Shape, check_arrays, product,
};
use super::rows::RowSlices;
use super::schedule::Control;
use super::worker::{Job, Worker};
use super::writer::Writer;
use crate::description::error::SolveError;
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::Real;
use crate::math::room::has_room;
use crate::plan::mechanism::Mechanism;

impl Mechanism {
    /// Solves designs at positions.
    ///
    /// # Errors
    ///
    /// [`SolveError`] if the whole request is invalid (shapes, order). Single positions that cannot
    /// be solved are NaN, each with its own status.
    pub fn solve(&self, request: &Request<'_>) -> Result<Motion, SolveError> {
        self.solve_with(request, &Control::default())
    }

    /// Solves a request with the threads and vector instructions that `control` allows.
    ///
    /// # Errors
    ///
    /// Those of [`Mechanism::solve`]; [`SolveError::Interrupted`] if `control` was cancelled.
    pub fn solve_with(
        &self,
        request: &Request<'_>,
        control: &Control<'_>,
    ) -> Result<Motion, SolveError> {
        solve(self, request, control)
    }
}

/// Solves a request; see [`Mechanism::solve_with`].
///
/// # Errors
///
/// Those of [`Mechanism::solve`], and [`SolveError::Interrupted`].
pub(crate) fn solve(
    mechanism: &Mechanism,
    request: &Request<'_>,
    control: &Control<'_>,
) -> Result<Motion, SolveError> {
    let [designs, positions] = request.shape(mechanism)?;
    let rows = product(designs, positions)?;
    let columns = request.columns(mechanism);
    let widths = columns.iter().map(|column| column.width);
    let (values, status) =
        filled(rows, widths, |arrays| fill(mechanism, request, arrays, control))?;
    let mut motion = Motion { designs, positions, status, ..Motion::default() };
    for (column, values) in columns.iter().zip(values) {
        let (list, index) = match column.quantity {
            Quantity::Joint(index) => (&mut motion.joints, index),
            Quantity::Origin(index) => (&mut motion.origins, index),
            Quantity::Slide(index) => (&mut motion.slides, index),
            Quantity::Angle(index) if request.outputs.links.contains(&index) => {
                (&mut motion.links, index)
            }
            Quantity::Angle(index) => (&mut motion.rates, index),
            Quantity::Direction(index) => (&mut motion.directions, index),
        };
        if column.order == 0 || list.last().is_none_or(|series| series.index != index) {
            list.push(Series { index, derivatives: Vec::new() });
        }
        if let Some(series) = list.last_mut() {
            series.derivatives.push(values);
        }
    }
    Ok(motion)
}

/// New arrays of rows with these widths, and statuses, that a function fills.
pub(crate) fn filled(
    rows: usize,
    widths: impl Iterator<Item = usize> + Clone,
    fill: impl FnOnce(Arrays<'_>) -> Result<(), SolveError>,
) -> Result<(Vec<Vec<f64>>, Vec<u8>), SolveError> {
    let numbers = rows.saturating_mul(1 + widths.clone().sum::<usize>());
    if !has_room(numbers) {
        return Err(SolveError::OutOfMemory { numbers });
    }
    let mut values: Vec<Vec<f64>> = widths.map(|width| vec![0.0; rows * width]).collect();
    let mut status = vec![0; rows];
    // SAFETY: only initialised numbers are stored.
    #[allow(unsafe_code, reason = "the standard library has no safe form of this yet")]
    let arrays = unsafe {
        Arrays {
            columns: values.iter_mut().map(|v| as_unwritten(v)).collect(),
            status: as_unwritten(&mut status),
        }
    };
    fill(arrays)?;
    Ok((values, status))
}

/// Views initialised numbers as `MaybeUninit`.
///
/// # Safety
///
/// The caller must not store uninitialised values in the slice.
#[allow(unsafe_code, reason = "the standard library has no safe form of this yet")]
pub(crate) unsafe fn as_unwritten<T: Copy>(values: &mut [T]) -> &mut [MaybeUninit<T>] {
    // SAFETY: the layout is the same, and the caller stores only initialised values.
    unsafe { &mut *(std::ptr::from_mut(values) as *mut [MaybeUninit<T>]) }
}

/// Solves a request into the caller's arrays.
///
/// # Errors
///
/// Those of [`Mechanism::solve`], and arrays of other sizes: nothing is written then.
/// After [`SolveError::Interrupted`] only some of the numbers are written.
pub fn fill(
    mechanism: &Mechanism,
    request: &Request<'_>,
    arrays: Arrays<'_>,
    control: &Control<'_>,
) -> Result<(), SolveError> {
    let shape = Shape::of(mechanism, request)?;
    let derivatives = DerivativeTables::shared(shape.drivers, request.order);
    let writer = &Writer::of(mechanism, &derivatives, request);
    let columns = &writer.columns;
    check_arrays(columns, &arrays, product(shape.designs, shape.positions)?)?;
    let mut chunks = Chunks::new(arrays, columns, [shape.designs, shape.positions], shape.drivers);
    chunks.lengthen(mechanism, writer);
    let derivatives = &derivatives;
    let batch = Batch { mechanism, request, derivatives, writer, shape, control };
    dispatch::at_level(control.simd, Fill { batch: &batch, chunks })
}

/// The data that all chunks of a batch share.
struct Batch<'b> {
    mechanism: &'b Mechanism,
    request: &'b Request<'b>,
    derivatives: &'b DerivativeTables,
    writer: &'b Arc<Writer>,
    shape: Shape,
    control: &'b Control<'b>,
}

/// The chunks of a batch, to be filled.
struct Fill<'b, 'r> {
    batch: &'b Batch<'b>,
    chunks: Chunks<'r>,
}

impl ForLevel for Fill<'_, '_> {
    type Output = Result<(), SolveError>;

    fn run<L: Entry, const G: usize>(self) -> Self::Output {
        type ThreadState<'a, R, const G: usize> = (Worker<'a, R, G>, Designs);
        let Batch { mechanism, request, derivatives, writer, shape, control } = self.batch;
        let worker = || -> ThreadState<'_, L::Register, G> {
            let solver = Worker::new(mechanism, request, derivatives, writer, control);
            (solver, Designs::default())
        };
        let work = |(worker, designs): &mut ThreadState<'_, L::Register, G>,
                    chunk: &Chunk,
                    mut rows: RowSlices<'_>| {
            designs.read(mechanism, request.dimensions, shape.designs, chunk.designs.clone());
            for (index, design) in chunk.designs.clone().enumerate() {
                if control.is_cancelled() {
                    break;
                }
                let mut job = self.batch.job(design, chunk, &mut rows);
                if worker.bind(designs.row(index), &mut job) {
                    L::run(worker, &mut job);
                }
            }
            L::Register::fence();
        };
        control.run(self.chunks, worker, work, |(worker, _)| worker.finish())
    }
}

impl Batch<'_> {
    /// The positions of one design of a chunk.
    fn job<'j, 'r>(
        &'j self,
        design: usize,
        chunk: &Chunk,
        rows: &'j mut RowSlices<'r>,
    ) -> Job<'j, 'r> {
        let Shape { positions, drivers, .. } = self.shape;
        let q = self.request.coordinates.of(design, positions * drivers);
        let q = &q[chunk.positions.start * drivers..chunk.positions.end * drivers];
        let shared = match self.request.coordinates {
            Coordinates::Shared(_) => Some(chunk.positions.start),
            Coordinates::PerDesign(_) => None,
        };
        let first = (design - chunk.designs.start) * chunk.positions.len();
        let index = design * positions + chunk.positions.start;
        Job { q, rows, first, index, design, shared }
    }
}
