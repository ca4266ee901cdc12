//! Measures a batch: solves one design after another and keeps only the metrics.

use super::course::Course;
use super::evaluate_design::{Probes, SweepBatch};
use super::gradients::MetricGradients;
use super::metric::{Metric, Need};
use super::request::{Measured, Sweep};
use super::threads::Measure;
use crate::batch::chunks::Chunks;
use crate::batch::dispatch;
use crate::batch::request::{Arrays, Column, Coordinates, Outputs, Quantity, Request, Shape};
use crate::batch::schedule::Control;
use crate::batch::scratch::Scratch;
use crate::batch::solve::as_unwritten;
use crate::batch::writer::Writer;
use crate::description::error::SolveError;
use crate::math::derivatives::DerivativeTables;
use crate::math::room::has_room;
use crate::plan::mechanism::Mechanism;
use crate::state::status::Status;

/// Designs below which a chunk has few of them, so that each thread has work.
const FEW_DESIGNS: usize = 1024;

impl Mechanism {
    /// Solves designs at positions for their metrics. A design must move over all positions.
    ///
    /// # Errors
    ///
    /// Those of [`Mechanism::solve`], and of [`Metric::check`]; [`SolveError::Interrupted`] if `control`
    /// was cancelled.
    pub fn measure(
        &self,
        sweep: &Sweep<'_>,
        control: &Control<'_>,
    ) -> Result<Measured, SolveError> {
        let course = self.course(sweep.q);
        let mut gradients = MetricGradients::new(self, sweep, course.count())?;
        let (mut outputs, order) = needed(sweep.metrics);
        gradients.add_outputs(&mut outputs);
        for (index, metric) in sweep.metrics.iter().enumerate() {
            let named = |reason| SolveError::Shape(format!("metric {index}: {reason}"));
            metric.check(&course).map_err(named)?;
        }
        let asks = sweep.metrics.iter().any(|metric| metric.asks_return());
        let with_return = asks.then(|| course.with_return()).flatten();
        let q = with_return.as_deref().unwrap_or(sweep.q);
        let request = Request {
            dimensions: sweep.dimensions,
            coordinates: Coordinates::Shared(q),
            signs: sweep.signs,
            order,
            outputs: &outputs,
        };
        let shape = Shape::of(self, &request)?;
        if sweep.conditions.iter().any(|condition| condition.metric >= sweep.metrics.len()) {
            return Err(SolveError::Shape("a condition's metric is beyond what there is".into()));
        }
        let derivatives = DerivativeTables::new(shape.drivers, order);
        let writer = Writer::of(self, &derivatives, &request);
        let sources = sources(sweep.metrics, &writer.columns);
        gradients.read_from(&writer.columns);
        let probes = Probes::new(&course);
        // After the metrics 1 of each design that is kept, then the gradients.
        let width = Column { quantity: Quantity::Joint(0), order: 0, width: 1 };
        let mut results = vec![width; sweep.metrics.len() + 1];
        results.extend(gradients.columns());
        let width = results.iter().map(|column| column.width).sum::<usize>();
        let numbers = shape.designs.saturating_mul(width + 1);
        if !has_room(numbers) {
            return Err(SolveError::OutOfMemory { numbers });
        }
        Scratch::check(&writer.columns, shape.positions, control)?;
        let mut values: Vec<Vec<f64>> =
            results.iter().map(|column| vec![f64::NAN; shape.designs * column.width]).collect();
        let mut status = vec![Status::Ok as u8; shape.designs];
        #[allow(unsafe_code, reason = "the standard library has no safe form of this yet")]
        // SAFETY: only initialised numbers are stored.
        let arrays = unsafe {
            Arrays {
                columns: values.iter_mut().map(|values| as_unwritten(values)).collect(),
                status: as_unwritten(&mut status),
            }
        };
        // Chunks of several drivers are small.
        let drivers = if shape.designs < FEW_DESIGNS { 2 } else { shape.drivers };
        let chunks = Chunks::new(arrays, &results, [shape.designs, 1], drivers);
        let batch = SweepBatch {
            mechanism: self,
            sweep,
            request: &request,
            derivatives: &derivatives,
            writer: &writer,
            columns: &writer.columns,
            sources: &sources,
            probes: &probes,
            course: &course,
            gradients: &gradients,
            q,
            shape: &shape,
            control,
        };
        dispatch::at_level(control.simd, Measure { batch: &batch, chunks })?;
        let gradients = values.split_off(sweep.metrics.len() + 1);
        let kept = values.pop().unwrap_or_default().iter().map(|&kept| kept == 1.0).collect();
        Ok(Measured { values, status, kept, gradients })
    }

    /// The course with which metrics are [checked](Metric::check): the coordinates of all designs.
    #[must_use]
    pub fn course<'a>(&self, q: &'a [f64]) -> Course<'a> {
        Course::new(q, self.q0().len(), self.plan().driven_slide(0).is_none())
    }
}

/// The quantities that all metrics read, each once, and the highest order.
fn needed(metrics: &[&dyn Metric]) -> (Outputs, usize) {
    let mut outputs = Outputs::default();
    let mut highest = 0;
    for need in metrics.iter().flat_map(|metric| metric.needs()) {
        let (list, index) = match need.quantity {
            Quantity::Joint(index) => (&mut outputs.joints, index),
            Quantity::Origin(index) => (&mut outputs.origins, index),
            Quantity::Slide(index) => (&mut outputs.slides, index),
            Quantity::Angle(index) => (&mut outputs.links, index),
            Quantity::Direction(index) => (&mut outputs.directions, index),
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
    let column = |need: Need| {
        let is_it = |c: &Column| c.quantity == need.quantity && c.order == need.order;
        columns.iter().position(is_it).unwrap_or(0)
    };
    metrics.iter().map(|metric| metric.needs().into_iter().map(column).collect()).collect()
}
