//! Gradients of metrics by dimensions, from the positions that were solved for their values.
//!
//! Every position may count. So that none is solved twice, a thread passes weights back through the positions of
//! each design as soon as they have shown that it is kept: those of a mean are the same at all positions, others are
//! the metric's own derivatives by what it reads.

use std::mem::MaybeUninit;

use super::metric::{Metric, Need};
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

/// The gradient of a metric, compiled.
struct MetricGradient<'m> {
    sensitivity: SensitivityPlan<'m>,
    /// Index of the metric.
    metric: usize,
    /// The results that it weighs.
    of: Vec<(Quantity, usize)>,
    /// Of a mean.
    shared: Option<Shared>,
}

/// Weights that are the same at all positions.
struct Shared {
    weights: Vec<f64>,
    /// Whether the metric is the root of the mean of squares.
    is_root_of_squares: bool,
}

/// The gradients of all designs.
#[derive(Default)]
pub(super) struct MetricGradients<'m> {
    each: Vec<MetricGradient<'m>>,
    by: &'m [usize],
    /// Columns of the request.
    read: usize,
}

impl<'m> MetricGradient<'m> {
    /// Compiles that of a metric over so many positions; `None` if it has none.
    fn new(
        mechanism: &'m Mechanism,
        (metric, of_metric): (usize, &dyn Metric),
        positions: usize,
    ) -> Option<Self> {
        let pair = |need: Need| (need.quantity, need.order);
        let Some(mean) = of_metric.mean_of() else {
            of_metric.with_slopes()?;
            let of: Vec<_> = of_metric.needs().into_iter().map(pair).collect();
            let sensitivity = SensitivityPlan::backward(mechanism, &of, false);
            return Some(Self { sensitivity, metric, of, shared: None });
        };
        let mut weights = vec![0.0; mean.need.width()];
        weights[mean.component.min(mean.need.width() - 1)] = 1.0 / positions as f64;
        let is_root_of_squares = mean.is_root_of_squares;
        let of = vec![pair(mean.need)];
        let sensitivity = SensitivityPlan::backward(mechanism, &of, is_root_of_squares);
        let shared = Some(Shared { weights, is_root_of_squares });
        Some(Self { sensitivity, metric, of, shared })
    }
}

impl<'m> MetricGradients<'m> {
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
            let of_metric = sweep.metrics.get(metric);
            of_metric
                .and_then(|&of| MetricGradient::new(mechanism, (metric, of), positions))
                .ok_or_else(|| {
                    SolveError::Shape(format!(
                        "metric {metric} has no gradient: it is not a mean and has no slopes"
                    ))
                })
        });
        Ok(Self { each: each.collect::<Result<_, SolveError>>()?, by, ..Self::default() })
    }

    /// The metric of each gradient.
    pub(super) fn metrics(&self) -> impl Iterator<Item = usize> + use<'_> {
        self.each.iter().map(|gradient| gradient.metric)
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
            gradient.sensitivity.read_from(columns);
            gradient.sensitivity.read_values(&gradient.of, columns);
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
        let slopes = kept.slopes.iter();
        for ((gradient, slopes), column) in
            self.each.iter().zip(slopes).zip(kept.values.len() + 1..)
        {
            let shared = gradient.shared.as_ref();
            let is_root = shared.is_some_and(|shared| shared.is_root_of_squares);
            let weights: Vec<&[f64]> = match shared {
                Some(shared) => vec![&shared.weights],
                None => slopes.by_numbers.iter().map(Vec::as_slice).collect(),
            };
            let product = Product::Backward {
                weights: &weights,
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
                besides: &slopes.by_dimensions,
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

/// The [slopes](super::Slopes) of a metric of one design.
#[derive(Debug, Default)]
pub(super) struct DesignSlopes {
    pub by_numbers: Vec<Vec<f64>>,
    pub by_dimensions: Vec<(usize, f64)>,
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
    /// For each gradient the [slopes](super::Slopes) of its metric, if it is not a mean.
    pub slopes: &'k [DesignSlopes],
}
