//! Gradients of means by dimensions, from the positions that were solved for their values.
//!
//! Every position counts for a mean. So that none is solved twice, a thread passes weights back through the
//! positions of each design as soon as they have shown that it is kept.

use std::mem::MaybeUninit;

use super::metric::MeanOf;
use super::request::{Gradients, Sweep};
use crate::batch::dispatch::Entry;
use crate::batch::motion::SolvedDesign;
use crate::batch::request::{Column, Outputs, Quantity};
use crate::batch::rows::RowSlices;
use crate::batch::scratch::ScratchRows;
use crate::branch::design::Design;
use crate::description::error::SolveError;
use crate::plan::mechanism::Mechanism;
use crate::sensitivity::evaluate::{Evaluate, SensitivitySpace};
use crate::sensitivity::plan::SensitivityPlan;
use crate::sensitivity::request::Product;

/// The gradient of a mean, compiled.
pub(super) struct MeanGradient<'m> {
    sensitivity: SensitivityPlan<'m>,
    /// Index of the metric.
    metric: usize,
    mean: MeanOf,
    /// Weights of the components of its coordinate, at each position.
    weights: Vec<f64>,
}

/// The gradients of all designs.
#[derive(Default)]
pub(super) struct MeanGradients<'m> {
    each: Vec<MeanGradient<'m>>,
    by: &'m [usize],
    /// Columns of the request.
    read: usize,
}

impl<'m> MeanGradients<'m> {
    /// Compiles the gradients of a sweep over so many positions.
    pub(super) fn new(
        mechanism: &'m Mechanism,
        sweep: &Sweep<'m>,
        positions: usize,
    ) -> Result<Self, SolveError> {
        let Gradients { of, by } = sweep.gradients;
        if of.is_empty() {
            return Ok(Self::default());
        }
        SensitivityPlan::refuse_redundant(mechanism)?;
        let count = mechanism.dimensions().len();
        if let Some(dimension) = by.iter().find(|&&dimension| dimension >= count) {
            return Err(SolveError::Shape(format!(
                "gradients by dimension {dimension}, but there are only {count}"
            )));
        }
        let each = of.iter().map(|&metric| {
            let mean = sweep.metrics.get(metric).and_then(|of| of.mean_of()).ok_or_else(|| {
                SolveError::Shape(format!(
                    "metric {metric} is not a mean: only means have gradients"
                ))
            })?;
            let mut weights = vec![0.0; mean.need.width()];
            weights[mean.component.min(mean.need.width() - 1)] = 1.0 / positions as f64;
            let result = [(mean.need.quantity, mean.need.order)];
            let sensitivity =
                SensitivityPlan::backward(mechanism, &result, mean.is_root_of_squares);
            Ok(MeanGradient { sensitivity, metric, mean, weights })
        });
        Ok(Self { each: each.collect::<Result<_, SolveError>>()?, by, ..Self::default() })
    }

    /// Whether none are requested.
    pub(super) fn is_empty(&self) -> bool {
        self.each.is_empty()
    }

    /// Adds what they read to the quantities of a sweep.
    pub(super) fn add_outputs(&self, outputs: &mut Outputs) {
        for gradient in &self.each {
            outputs.add(&gradient.sensitivity.outputs);
        }
    }

    /// Finds what they read in the columns of the request.
    pub(super) fn read_from(&mut self, columns: &[Column]) {
        for gradient in &mut self.each {
            let need = gradient.mean.need;
            gradient.sensitivity.read_from(columns);
            gradient.sensitivity.read_values(&[(need.quantity, need.order)], columns);
        }
        self.read = columns.len();
    }

    /// The numbers of each design: a column for each gradient.
    pub(super) fn columns(&self) -> impl Iterator<Item = Column> + use<'_> {
        let width = self.by.len();
        self.each.iter().map(move |_| Column { quantity: Quantity::Joint(0), order: 0, width })
    }

    /// Writes the gradients of a design into its row of the results.
    pub(super) fn write<L: Entry>(
        &self,
        space: &mut SensitivitySpace<L::Register>,
        rows: &mut ScratchRows<'_>,
        kept: &Kept<'_, '_>,
        (results, place): (&mut RowSlices<'_>, usize),
    ) {
        let count = kept.count;
        rows.repeat_last(count);
        let columns: Vec<&[f64]> = (0..self.read).map(|column| rows.column(column)).collect();
        let solved = SolvedDesign {
            q: kept.q,
            index: place,
            rows: 0..count,
            dimensions: kept.dimensions,
            columns: &columns,
            status: &rows.status()[..count],
            is_valid: true,
            design: kept.design,
        };
        for (gradient, column) in self.each.iter().zip(kept.values.len() + 1..) {
            let is_root = gradient.mean.is_root_of_squares;
            let product = Product::Backward {
                weights: &[&gradient.weights],
                by: self.by,
                total: true,
                of_squares: is_root,
            };
            L::call(&mut Evaluate {
                sensitivity: &gradient.sensitivity,
                product,
                solved: &solved,
                rates: None,
                space,
                results,
                column,
                first: place,
                // d√m = dm / 2√m.
                divisor: if is_root { kept.values[gradient.metric] } else { 1.0 },
            });
        }
    }

    /// Writes NaN for a design that is not kept.
    pub(super) fn write_none(&self, metrics: usize, (results, place): (&mut RowSlices<'_>, usize)) {
        let width = self.by.len();
        for column in results.columns.iter_mut().skip(metrics + 1) {
            column[place * width..][..width].fill(MaybeUninit::new(f64::NAN));
        }
    }
}

/// A design that is kept.
pub(super) struct Kept<'k, 'b> {
    pub design: &'k Design<'b>,
    pub dimensions: &'k [f64],
    /// Coordinates of the drivers, and how many positions these are.
    pub q: &'k [f64],
    pub count: usize,
    /// The values of all metrics.
    pub values: &'k [f64],
}
