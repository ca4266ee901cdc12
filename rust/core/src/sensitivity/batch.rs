//! Derivatives by dimensions of many designs at many positions.

use super::evaluate::{Evaluate, SensitivitySpace};
use super::plan::SensitivityPlan;
use super::request::{Product, SensitivityRequest};
use crate::batch::chunks::{Chunk, Chunks, most_positions};
use crate::batch::dispatch::{self, Entry, ForLevel};
use crate::batch::motion::{MotionBatch, MotionWorker};
use crate::batch::request::{Arrays, Column, Quantity, Request, Shape, check_arrays, product};
use crate::batch::rows::RowSlices;
use crate::batch::schedule::Control;
use crate::batch::solve::filled;
use crate::batch::writer::Writer;
use crate::description::error::SolveError;
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::Real;
use crate::plan::mechanism::Mechanism;

impl Mechanism {
    /// Derivatives of positions and analogues by dimensions, or their products with vectors: the arrays of the
    /// product, and the status of each row. Where a position has no derivatives they are NaN.
    ///
    /// # Errors
    ///
    /// Those of [`crate::fill`]; rates or weights of other sizes; redundant links.
    pub fn sensitivities(
        &self,
        request: &SensitivityRequest<'_>,
        control: &Control<'_>,
    ) -> Result<(Vec<Vec<f64>>, Vec<u8>), SolveError> {
        let widths = request.widths(self).into_iter();
        filled(request.rows(self)?, widths, |arrays| {
            self.fill_sensitivities(request, arrays, control)
        })
    }

    /// The same into the caller's arrays.
    ///
    /// # Errors
    ///
    /// Those of [`Mechanism::sensitivities`]; arrays of other sizes.
    pub fn fill_sensitivities(
        &self,
        request: &SensitivityRequest<'_>,
        arrays: Arrays<'_>,
        control: &Control<'_>,
    ) -> Result<(), SolveError> {
        SensitivityPlan::refuse_redundant(self)?;
        self.check_results(request.of)?;
        let mut sensitivity = match request.product {
            Product::Forward { .. } => SensitivityPlan::restricted(self, request.of),
            Product::Jacobian { .. } => SensitivityPlan::backward(self, request.of, false),
            Product::Backward { of_squares, .. } => {
                SensitivityPlan::backward(self, request.of, of_squares)
            }
        };
        let outputs = sensitivity.outputs.clone();
        let motion = Request {
            dimensions: request.dimensions,
            coordinates: request.coordinates,
            signs: request.signs,
            order: sensitivity.order,
            outputs: &outputs,
        };
        let shape = Shape::of(self, &motion)?;
        let rows = product(shape.designs, shape.positions)?;
        let results = self.columns(request, &sensitivity, [shape.designs, rows])?;
        check_arrays(&results, &arrays, request.rows(self)?)?;
        let derivatives = DerivativeTables::shared(shape.drivers, sensitivity.order);
        let writer = Writer::of(self, &derivatives, &motion);
        sensitivity.read_from(&writer.columns);
        sensitivity.read_values(request.of, &writer.columns);
        let batch = SensitivityBatch {
            motion: MotionBatch {
                mechanism: self,
                request: &motion,
                derivatives: &derivatives,
                writer: &writer,
                shape: &shape,
                // A total is of all positions.
                most: if request.product.is_total() {
                    shape.positions
                } else {
                    most_positions(shape.positions)
                },
                control,
            },
            sensitivity: &sensitivity,
            request,
        };
        batch.motion.check()?;
        let written = if request.product.is_total() { 1 } else { shape.positions };
        let chunks = Chunks::new(arrays, &results, [shape.designs, written], shape.drivers);
        dispatch::at_level(control.simd, Derive { batch: &batch, chunks })
    }

    fn check_results(&self, of: &[(Quantity, usize)]) -> Result<(), SolveError> {
        let linkage = self.linkage();
        let exists = |&(quantity, _): &(Quantity, usize)| match quantity {
            Quantity::Joint(index) => index < linkage.joints.len(),
            Quantity::Slide(index) => index < linkage.slides.len(),
            Quantity::Angle(index) | Quantity::Origin(index) => index < linkage.links.len(),
            Quantity::Direction(_) => false,
        };
        if of.iter().all(exists) {
            Ok(())
        } else {
            Err(SolveError::Shape("a result has an index that does not exist".into()))
        }
    }

    /// The arrays of a product, after checks of its vectors.
    fn columns(
        &self,
        request: &SensitivityRequest<'_>,
        sensitivity: &SensitivityPlan<'_>,
        [designs, rows]: [usize; 2],
    ) -> Result<Vec<Column>, SolveError> {
        let dimensions = self.dimensions().len();
        let components = || sensitivity.results.iter().map(Vec::len);
        let exist = |by: &[usize]| by.iter().all(|&index| index < dimensions);
        let fits = match request.product {
            Product::Jacobian { by } => exist(by),
            Product::Forward { rates } => [dimensions, designs * dimensions].contains(&rates.len()),
            Product::Backward { weights, by, .. } => {
                let fit = |(width, weights): (usize, &&[f64])| {
                    [width, rows * width].contains(&weights.len())
                };
                weights.len() == request.of.len() && components().zip(weights).all(fit) && exist(by)
            }
        };
        let column = |width: usize| Column { quantity: Quantity::Joint(0), order: 0, width };
        let columns = request.widths(self).into_iter().map(column).collect();
        if fits {
            Ok(columns)
        } else {
            Err(SolveError::Shape("rates, weights or dimensions do not fit".into()))
        }
    }
}

/// What all chunks share.
struct SensitivityBatch<'b> {
    motion: MotionBatch<'b>,
    sensitivity: &'b SensitivityPlan<'b>,
    request: &'b SensitivityRequest<'b>,
}

struct Derive<'b, 'r> {
    batch: &'b SensitivityBatch<'b>,
    chunks: Chunks<'r>,
}

/// The working data of one thread.
struct ThreadState<'b, R: Real, const G: usize> {
    motion: MotionWorker<'b, R, G>,
    space: SensitivitySpace<R>,
}

impl<'b> ForLevel for Derive<'b, '_> {
    type Output = Result<(), SolveError>;

    fn run<L: Entry, const G: usize>(self) -> Self::Output {
        let batch = self.batch;
        let new_state = || ThreadState::<'b, L::Register, G> {
            motion: batch.motion.thread(),
            space: SensitivitySpace::default(),
        };
        let work =
            |state: &mut ThreadState<'b, L::Register, G>, chunk: &Chunk, rows: RowSlices<'_>| {
                batch.chunk::<L, G>(state, chunk, rows);
            };
        batch.motion.control.run(self.chunks, new_state, work, |state| state.motion.finish())
    }
}

impl<'b> SensitivityBatch<'b> {
    fn chunk<L: Entry, const G: usize>(
        &self,
        state: &mut ThreadState<'b, L::Register, G>,
        chunk: &Chunk,
        mut results: RowSlices<'_>,
    ) {
        let ThreadState { motion, space } = state;
        self.motion.read_designs(motion, chunk);
        let total = self.request.product.is_total();
        for asked in self.motion.designs(chunk, total) {
            let written = if total { 1 } else { asked.rows.len() };
            let (design, first) = (asked.design, asked.index * written);
            self.motion.solve::<L, G>(motion, &asked, |solved| {
                let rates = match self.request.product {
                    Product::Forward { rates } if solved.is_valid => {
                        let count = solved.dimensions.len();
                        let shared = rates.len() == count;
                        let first = if shared { 0 } else { design * count };
                        Some(solved.design.rate(&rates[first..first + count]))
                    }
                    _ => None,
                };
                let mut task = Evaluate {
                    sensitivity: self.sensitivity,
                    product: self.request.product,
                    solved: &solved,
                    rates: rates.as_ref(),
                    space,
                    results: &mut results,
                    column: 0,
                    first,
                    divisor: 1.0,
                    besides: &[],
                };
                L::call(&mut task);
            });
        }
        L::Register::fence();
    }
}
