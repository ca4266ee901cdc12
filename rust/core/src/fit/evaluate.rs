//! Asks the solver for a block of designs: whether they move, their conditions, their residuals.

use std::num::NonZeroUsize;
use std::sync::atomic::AtomicBool;

use super::conditions::{add_conditions, is_active, set_misses};
use super::point::Point;
use super::problem::{Problem, TRAVEL_POSITIONS, Travel, between, series, turn};
use super::residuals::{Solved, linearize};
use super::target::Timing;
use crate::batch::request::{Coordinates, Motion, Request};
use crate::batch::schedule::Control;
use crate::description::error::SolveError;
use crate::sensitivity::request::{Product, SensitivityRequest};
use crate::sweep::{Gradients, Measured, Metric, Sweep};

impl Problem<'_> {
    /// How the solver is to work for one block: blocks run side by side.
    fn control<'c>(&self, cancel: &'c AtomicBool) -> Control<'c> {
        let threads = Some(NonZeroUsize::MIN);
        Control { threads, simd: self.simd, cancel: Some(cancel), ..Control::default() }
    }

    /// Evaluates and linearises points of one assembly, over so many positions of their travel.
    pub(super) fn evaluate(
        &self,
        points: &mut [&mut Point],
        (assembly, travel): (usize, usize),
        cancel: &AtomicBool,
    ) -> Result<(), SolveError> {
        let designs = points.len();
        if designs == 0 {
            return Ok(());
        }
        let mut dimensions = vec![0.0; designs * self.mechanism.dimensions().len()];
        let mut q = Vec::with_capacity(designs * self.positions());
        for (design, point) in points.iter_mut().enumerate() {
            self.set_timing(point);
            self.variables.write(&point.x, &mut dimensions, (design, designs));
            q.extend_from_slice(&point.q);
        }
        let (signs, control) = (&self.assemblies[assembly], self.control(cancel));
        let measured = self.measure(&dimensions, &q, (signs, travel), false, &control)?;
        let coordinates = Coordinates::PerDesign(&q);
        let motion = self.mechanism.solve_with(
            &Request {
                dimensions: &dimensions,
                coordinates,
                signs,
                order: 1,
                outputs: &self.outputs,
            },
            &control,
        )?;
        let (derivatives, status) = self.mechanism.sensitivities(
            &SensitivityRequest {
                dimensions: &dimensions,
                coordinates,
                signs,
                of: &self.quantities,
                product: Product::Jacobian { by: &self.variables.by },
            },
            &control,
        )?;
        let series = self.quantities.iter().filter_map(|&(quantity, _)| series(&motion, quantity));
        let solved =
            Solved { series: series.collect(), derivatives: &derivatives, status: &status };
        let mut active = vec![];
        for (design, point) in points.iter_mut().enumerate() {
            if !measured.kept[design] {
                point.value = f64::INFINITY;
                continue;
            }
            linearize(self, &solved, design, point);
            let values: Vec<f64> = measured.values.iter().map(|all| all[design]).collect();
            set_misses(&self.conditions, point, &values);
            if is_active(&self.conditions, point) {
                active.push(design);
            }
        }
        if active.is_empty() {
            return Ok(());
        }
        let dimensions: Vec<f64> = dimensions
            .chunks_exact(designs)
            .flat_map(|each| active.iter().map(|&design| each[design]))
            .collect();
        let count = self.positions();
        let q: Vec<f64> =
            active.iter().flat_map(|&design| &q[design * count..][..count]).copied().collect();
        let measured = self.measure(&dimensions, &q, (signs, travel), true, &control)?;
        let width = self.variables.by.len();
        for (place, &design) in active.iter().enumerate() {
            let values: Vec<f64> = measured.values.iter().map(|all| all[place]).collect();
            let gradients = measured.gradients.iter();
            let gradients: Vec<&[f64]> =
                gradients.map(|all| &all[place * width..][..width]).collect();
            let of = (&*self.conditions, &self.variables);
            add_conditions(of, points[design], (&values, &gradients));
        }
        Ok(())
    }

    /// Whether designs move over their travel, and the metrics of conditions there.
    fn measure(
        &self,
        dimensions: &[f64],
        q: &[f64],
        (signs, travel): (&[i8], usize),
        has_gradients: bool,
        control: &Control<'_>,
    ) -> Result<Measured, SolveError> {
        let metrics: Vec<&dyn Metric> =
            self.conditions.iter().map(|one| &*one.metric as &dyn Metric).collect();
        let of: Vec<usize> = (0..if has_gradients { metrics.len() } else { 0 }).collect();
        let gradients = Gradients { of: &of, by: &self.variables.by };
        let measure = |dimensions: &[f64], q: &[f64]| {
            let sweep =
                Sweep { dimensions, q, signs, metrics: &metrics, conditions: &[], gradients };
            self.mechanism.measure(&sweep, control)
        };
        if self.travel == Travel::WholeTurn {
            return measure(dimensions, &turn(travel));
        }
        if self.targets.iter().all(|target| matches!(target.timing, Timing::Fixed(_))) {
            return measure(dimensions, &between(&q[..self.positions()], travel));
        }
        // Each design has a travel of its own.
        let designs = dimensions.len() / self.mechanism.dimensions().len();
        let mut all = Measured::default();
        for (design, q) in q.chunks_exact(self.positions()).enumerate() {
            let own: Vec<f64> = dimensions.iter().skip(design).step_by(designs).copied().collect();
            let one = measure(&own, &between(q, travel))?;
            all.values.resize(one.values.len(), vec![]);
            all.gradients.resize(one.gradients.len(), vec![]);
            for (all, one) in all.values.iter_mut().zip(one.values) {
                all.extend(one);
            }
            for (all, one) in all.gradients.iter_mut().zip(one.gradients) {
                all.extend(one);
            }
            all.kept.extend(one.kept);
        }
        Ok(all)
    }

    /// Solves points of one assembly at the positions of their targets.
    pub(super) fn at_positions(
        &self,
        points: &mut [&mut Point],
        assembly: usize,
        cancel: &AtomicBool,
    ) -> Result<Motion, SolveError> {
        let designs = points.len();
        let mut dimensions = vec![0.0; designs * self.mechanism.dimensions().len()];
        let mut q = Vec::with_capacity(designs * self.positions());
        for (design, point) in points.iter_mut().enumerate() {
            self.set_timing(point);
            self.variables.write(&point.x, &mut dimensions, (design, designs));
            q.extend_from_slice(&point.q);
        }
        self.mechanism.solve_with(
            &Request {
                dimensions: &dimensions,
                coordinates: Coordinates::PerDesign(&q),
                signs: &self.assemblies[assembly],
                order: 0,
                outputs: &self.outputs,
            },
            &self.control(cancel),
        )
    }

    /// Solves designs of one assembly over a whole turn.
    pub(super) fn curves(
        &self,
        dimensions: &[f64],
        assembly: usize,
        cancel: &AtomicBool,
    ) -> Result<Motion, SolveError> {
        self.mechanism.solve_with(
            &Request {
                dimensions,
                coordinates: Coordinates::Shared(&turn(TRAVEL_POSITIONS)),
                signs: &self.assemblies[assembly],
                order: 0,
                outputs: &self.outputs,
            },
            &self.control(cancel),
        )
    }
}
