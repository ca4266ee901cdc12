//! The outcome of a design, and its metrics, given its positions.

use std::sync::Arc;

use super::course::Course;
use super::gradients::{DesignSlopes, MetricGradients};
use super::metric::{Metric, Positions, Slopes};
use super::request::Sweep;
use crate::batch::chunks::DesignRow;
use crate::batch::request::{Column, Request, Shape};
use crate::batch::schedule::Control;
use crate::batch::scratch::ScratchRows;
use crate::batch::writer::Writer;
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::LANES;
use crate::plan::mechanism::Mechanism;
use crate::state::status::Status;

/// Positions that are solved first, spread over all: they show most designs that do not move over all
/// positions, or miss a condition.
const PROBES: usize = LANES;
/// Number of positions from which probes are worth their time.
const MANY_POSITIONS: usize = 4 * PROBES;

/// Columns that a metric reads without an allocation.
const FEW_SOURCES: usize = 8;

/// A motion returns if its positions at the end of a turn and at its start agree to this part of the size.
/// Near a change point positions are known to 1.5e-8, the root of the rounding; different assemblies differ
/// by far more.
const SAME: f64 = 1.0e-6;

/// Code from which a position has failed.
const FIRST_FAILURE: u8 = Status::Unreachable as u8;

/// The positions that are solved first.
pub(super) struct Probes {
    pub places: Vec<usize>,
    pub q: Vec<f64>,
}

impl Probes {
    pub(super) fn new(course: &Course<'_>) -> Self {
        let are_many = course.drivers == 1 && course.count() >= MANY_POSITIONS;
        let count = if are_many { PROBES } else { 0 };
        let places: Vec<usize> = (0..count).map(|k| k * course.count() / PROBES).collect();
        let q = places.iter().map(|&place| course.q[place]).collect();
        Self { places, q }
    }
}

/// The data that all chunks of a batch share.
pub(super) struct SweepBatch<'b> {
    pub mechanism: &'b Mechanism,
    pub sweep: &'b Sweep<'b>,
    pub request: &'b Request<'b>,
    pub derivatives: &'b DerivativeTables,
    pub writer: &'b Arc<Writer>,
    pub columns: &'b [Column],
    pub sources: &'b [Vec<usize>],
    pub probes: &'b Probes,
    pub course: &'b Course<'b>,
    pub gradients: &'b MetricGradients<'b>,
    /// All coordinates that are solved: after those of the course may follow two of the next turn.
    pub q: &'b [f64],
    pub shape: &'b Shape,
    pub control: &'b Control<'b>,
}

/// The outcome of a design.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Outcome {
    /// It moves, with the worst status of its positions.
    Moves(u8),
    /// A position has failed, with this status.
    Fails(u8),
    /// A condition does not hold.
    FailsCondition,
}

impl SweepBatch<'_> {
    /// The outcome of a design, given its positions at `q`, all or only the probes; and its metrics, over all
    /// positions.
    pub(super) fn evaluate(
        &self,
        rows: &ScratchRows<'_>,
        (row, q): (DesignRow<'_>, &[f64]),
        are_probes: bool,
        results: &mut [f64],
    ) -> Outcome {
        let status = &rows.status()[..q.len() / self.shape.drivers];
        let worst = status.iter().fold(0, |worst, &code| worst.max(code));
        if worst >= FIRST_FAILURE {
            // The probes come first, also if they were solved before.
            let places: &[usize] = if are_probes { &[] } else { &self.probes.places };
            let mut all = places.iter().map(|&place| &status[place]).chain(status);
            let failed = all.find(|&&code| code >= FIRST_FAILURE);
            return Outcome::Fails(failed.copied().unwrap_or(worst));
        }
        let metrics = self.sweep.metrics;
        results.fill(f64::NAN);
        for condition in self.sweep.conditions {
            let metric = metrics[condition.metric];
            if !are_probes || condition.stays_false(metric.growth()) {
                let value = self.value(rows, (row, q), condition.metric, worst);
                results[condition.metric] = value;
                // A part of the positions may lack a probe.
                if !(condition.holds(value) || are_probes && value.is_nan()) {
                    return Outcome::FailsCondition;
                }
            }
        }
        if !are_probes {
            let has_condition =
                |metric: usize| self.sweep.conditions.iter().any(|c| c.metric == metric);
            for metric in (0..metrics.len()).filter(|&metric| !has_condition(metric)) {
                results[metric] = self.value(rows, (row, q), metric, worst);
            }
        }
        Outcome::Moves(worst)
    }

    /// A metric of the positions at `q`, the first of the rows, with their worst status. Singular positions
    /// have no derivatives.
    fn value(
        &self,
        rows: &ScratchRows<'_>,
        at: (DesignRow<'_>, &[f64]),
        metric: usize,
        worst: u8,
    ) -> f64 {
        let is_derivative = |&column: &usize| self.columns[column].order > 0;
        if worst >= Status::Singular as u8 && self.sources[metric].iter().any(is_derivative) {
            return f64::NAN;
        }
        self.show(rows, at, metric, |positions| self.sweep.metrics[metric].of(positions))
    }

    /// The derivatives, by what it reads, of a metric that knows them; none are needed of a mean.
    pub(super) fn slopes(
        &self,
        rows: &ScratchRows<'_>,
        at: (DesignRow<'_>, &[f64]),
        metric: usize,
    ) -> DesignSlopes {
        let of_metric = self.sweep.metrics[metric];
        let slopes = |of: &dyn Slopes| {
            self.show(rows, at, metric, |seen| DesignSlopes {
                by_numbers: of.slopes(seen),
                by_dimensions: of.by_dimensions(seen),
            })
        };
        match (of_metric.mean_of(), of_metric.with_slopes()) {
            (None, Some(of)) => slopes(of),
            _ => DesignSlopes::default(),
        }
    }

    /// Shows a metric the positions at `q`, the first of the rows.
    #[inline]
    fn show<T>(
        &self,
        rows: &ScratchRows<'_>,
        (row, q): (DesignRow<'_>, &[f64]),
        metric: usize,
        see: impl FnOnce(&Positions<'_>) -> T,
    ) -> T {
        let drivers = self.shape.drivers;
        let count = q.len() / drivers;
        let column = |&index: &usize| &rows.by_row(index)[..count * self.columns[index].width];
        let sources = &self.sources[metric][..];
        // Most read few columns; an allocation would take as long as the metric of the probes.
        let mut few = [&[][..]; FEW_SOURCES];
        let collected: Vec<&[f64]>;
        let values = if let Some(few) = few.get_mut(..sources.len()) {
            for (values, source) in few.iter_mut().zip(sources) {
                *values = column(source);
            }
            few
        } else {
            collected = sources.iter().map(column).collect();
            &collected[..]
        };
        let metric = (self.sweep.metrics[metric], sources);
        let returns = q.len() == self.course.q.len() && self.returns(rows, metric);
        let dimensions = row.dimensions;
        let cancel = self.control.cancel;
        see(&Positions { q, drivers, dimensions, values, returns, cancel })
    }

    /// Whether the numbers that a metric reads are the same after a turn, at two positions.
    fn returns(&self, rows: &ScratchRows<'_>, (metric, sources): (&dyn Metric, &[usize])) -> bool {
        let (count, next) = (self.course.count(), 2);
        let is_solved = self.q.len() > self.course.q.len();
        is_solved
            && metric.asks_return()
            && sources.iter().all(|&index| {
                let width = self.columns[index].width;
                let values = rows.by_row(index);
                let (turn, after) = values.split_at(count * width);
                let size = turn.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
                // NaN is not the same.
                let mut pairs = turn.iter().zip(after).take(next * width);
                pairs.all(|(first, again)| (again - first).abs() <= SAME * size)
            })
    }
}
