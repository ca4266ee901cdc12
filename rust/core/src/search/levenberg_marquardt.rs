//! The damped least squares of Levenberg (1944) and Marquardt (1963) for the objective of a search.

use super::cholesky::Equations;
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
    equations: Equations,
    step: Vec<f64>,
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
                if self.find_step::<L>(objective, &candidate.linkage, damping) {
                    take(objective, candidate, &self.step, &mut trial);
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
        if !self.find_step::<L>(objective, &candidate.linkage, DAMPING) {
            return value;
        }
        let slopes = (0..self.equations.count).map(|number| self.normal.slope(number));
        let slope: f64 = self.step.iter().zip(slopes).map(|(d, g)| d * g).sum();
        value + 0.5 * slope
    }

    /// Finds the step of a damping; `false` if the equations are not positive definite.
    fn find_step<L: Entry>(
        &mut self,
        objective: &Objective,
        linkage: &PackedLinkage,
        damping: f64,
    ) -> bool {
        let Self { normal, equations, step, .. } = self;
        let (width, right) = (normal.width, normal.count);
        let count = 2 * linkage.len() + usize::from(objective.has_arc());
        let mean = (0..count).map(|p| normal.matrix[p * width + p]).sum::<f64>() / count as f64;
        equations.rows.clear();
        equations.rows.extend_from_slice(&normal.matrix[..count * width]);
        for (p, row) in equations.rows.chunks_exact_mut(width).enumerate() {
            row[p] += damping * (row[p] + FLOOR * mean);
            row[right] = -row[right];
        }
        (equations.width, equations.right, equations.count) = (width, right, count);
        equations.solve::<L>(step)
    }
}

/// The candidate after a step, within its bounds.
fn take(objective: &Objective, from: &Candidate, step: &[f64], to: &mut Candidate) {
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
        to.arc = (from.arc + step[2 * from.linkage.len()]).clamp(least, most);
    }
}
