//! The damped least squares of Levenberg (1944) and Marquardt (1963) for the objective of a search.

use nalgebra::{DMatrix, DVector};

use super::normal::Normal;
use super::objective::{Candidate, Objective, Workspace};
use crate::batch::dispatch::Entry;
use crate::population::packed::{PackedLinkage, Placement};

/// Damping at first; its factors after a success and a failure.
const DAMPING: f64 = 0.01;
const AFTER_SUCCESS: f64 = 0.25;
const AFTER_FAILURE: f64 = 5.0;
/// Steps that are tried in an iteration.
const TRIES: usize = 7;
/// Share of the mean diagonal that is added to each entry of it.
const FLOOR: f64 = 1e-4;
/// Iterations that gain less than this part of the value, after so many of which it stops.
const SMALL_GAIN: f64 = 1e-4;
const SMALL_GAINS: usize = 3;
/// Least length of a bar, in radii of the target.
const LEAST_LENGTH: f64 = 1e-3;

/// Memory of the method.
#[derive(Debug, Clone, Default)]
pub(crate) struct Refiner {
    pub work: Workspace,
    normal: Normal,
}

impl Refiner {
    /// Evaluates a candidate.
    pub(crate) fn evaluate<L: Entry>(&mut self, objective: &Objective, candidate: &mut Candidate) {
        candidate.value = objective.value::<L>(&candidate.linkage, candidate.arc, &mut self.work);
    }

    /// Improves a candidate by some iterations at most. What does not make a linkage gets an infinite value.
    pub(crate) fn refine<L: Entry>(
        &mut self,
        objective: &Objective,
        candidate: &mut Candidate,
        iterations: usize,
    ) {
        if candidate.linkage.links().is_none() {
            candidate.value = f64::INFINITY;
            return;
        }
        self.evaluate::<L>(objective, candidate);
        if candidate.value.is_infinite() {
            return;
        }
        let mut damping = DAMPING;
        let mut small_gains = 0;
        let mut trial = candidate.clone();
        for _ in 0..iterations {
            objective.linearize::<L>(&candidate.linkage, &mut self.work, &mut self.normal);
            let before = candidate.value;
            let mut tries = 0;
            loop {
                if let Some(step) = self.step(objective, &candidate.linkage, damping) {
                    take(objective, candidate, &step, &mut trial);
                    self.evaluate::<L>(objective, &mut trial);
                    if trial.value < candidate.value {
                        std::mem::swap(candidate, &mut trial);
                        damping *= AFTER_SUCCESS;
                        break;
                    }
                }
                damping *= AFTER_FAILURE;
                tries += 1;
                if tries == TRIES {
                    return;
                }
            }
            let is_small = before - candidate.value < SMALL_GAIN * before;
            small_gains = if is_small { small_gains + 1 } else { 0 };
            if small_gains == SMALL_GAINS {
                return;
            }
        }
    }

    /// The value that one step promises.
    pub(crate) fn promise<L: Entry>(
        &mut self,
        objective: &Objective,
        candidate: &Candidate,
    ) -> f64 {
        if candidate.linkage.links().is_none() {
            return f64::INFINITY;
        }
        let value = objective.value::<L>(&candidate.linkage, candidate.arc, &mut self.work);
        if value.is_infinite() {
            return value;
        }
        objective.linearize::<L>(&candidate.linkage, &mut self.work, &mut self.normal);
        let Some(step) = self.step(objective, &candidate.linkage, DAMPING) else { return value };
        let slope: f64 = step.iter().zip(&self.normal.g).map(|(d, g)| d * g).sum();
        value + 0.5 * slope
    }

    /// The step of a damping; `None` if the equations are not positive definite.
    fn step(
        &self,
        objective: &Objective,
        linkage: &PackedLinkage,
        damping: f64,
    ) -> Option<DVector<f64>> {
        let count = 2 * linkage.len() + usize::from(objective.has_arc());
        let Normal { h, g, width, .. } = &self.normal;
        let mean = (0..count).map(|p| h[p * width + p]).sum::<f64>() / count as f64;
        let mut matrix = DMatrix::from_fn(count, count, |p, q| h[p.max(q) * width + p.min(q)]);
        for p in 0..count {
            matrix[(p, p)] += damping * (matrix[(p, p)] + FLOOR * mean);
        }
        let gradient = DVector::from_fn(count, |p, _| -g[p]);
        Some(matrix.cholesky()?.solve(&gradient))
    }
}

/// The candidate after a step, within its bounds.
fn take(objective: &Objective, from: &Candidate, step: &DVector<f64>, to: &mut Candidate) {
    to.linkage.clone_from(&from.linkage);
    for (joint, numbers) in to.linkage.numbers.iter_mut().enumerate() {
        for (axis, number) in numbers.iter_mut().enumerate() {
            *number += step[2 * joint + axis];
        }
        if let Placement::Dyad { .. } = to.linkage.placements[joint] {
            *numbers = numbers.map(|length| length.max(LEAST_LENGTH));
        }
    }
    to.arc = from.arc;
    if objective.has_arc() {
        let [least, most] = objective.limits().arc;
        to.arc = (from.arc + step[step.len() - 1]).clamp(least, most);
    }
}
