//! Conditions on a design: metrics of its travel that have limits, or values to come near to.
//!
//! Limits are kept by the augmented Lagrangian of Hestenes and Powell (1969): each is a squared residual
//! √μ·max(0, c + λ/μ), where c is by how much it is missed; λ grows by μ·c between descents.

use super::point::Point;
use super::problem::Problem;
use crate::sweep::Metric;

/// The square of a miss of one unit, at first, in sizes of the target; how it grows where misses stay.
const PENALTY: f64 = 10.0;
const GROWTH: f64 = 4.0;
/// A miss that falls to this part stays no longer.
const FALLS: f64 = 0.25;
/// A limit counts as kept if it is missed by less than this, in its unit.
pub(super) const KEPT: f64 = 1e-6;

/// What a metric is to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Aim {
    /// At most this.
    AtMost(f64),
    /// At least this.
    AtLeast(f64),
    /// Near this: a target.
    Near(f64),
}

/// A metric of the travel, with what it is to be.
pub struct FitCondition {
    /// The metric; it has a gradient.
    pub metric: Box<dyn Metric + Send>,
    /// What it is to be.
    pub aim: Aim,
    /// What counts as a miss of 1.
    pub unit: f64,
}

impl std::fmt::Debug for FitCondition {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { aim, unit, .. } = self;
        formatter.debug_struct("FitCondition").field("aim", aim).field("unit", unit).finish()
    }
}

/// By how much limits are missed, and how strongly that counts.
#[derive(Debug, Clone, Default)]
pub(super) struct Multipliers {
    /// In units; not positive where a limit is kept.
    pub misses: Vec<f64>,
    lambda: Vec<f64>,
    penalty: f64,
    /// The worst miss after the last descent.
    worst: f64,
}

impl Multipliers {
    pub(super) fn new(problem: &Problem) -> Self {
        Self {
            misses: vec![0.0; problem.conditions.len()],
            lambda: vec![0.0; problem.conditions.len()],
            penalty: PENALTY * problem.size,
            worst: f64::INFINITY,
        }
    }

    /// The worst miss, in units.
    pub(super) fn worst(&self) -> f64 {
        self.misses.iter().copied().fold(0.0, f64::max)
    }

    /// After a descent.
    pub(super) fn update(&mut self) {
        for (lambda, miss) in self.lambda.iter_mut().zip(&self.misses) {
            *lambda = (*lambda + self.penalty * miss).max(0.0);
        }
        let worst = self.worst();
        if worst > FALLS * self.worst {
            self.penalty *= GROWTH;
        }
        self.worst = worst;
    }
}

/// Adds conditions to a linearised point: their values and derivatives by the dimensions that move.
pub(super) fn add_conditions(
    problem: &Problem,
    point: &mut Point,
    (values, gradients): (&[f64], &[&[f64]]),
) {
    let mut row = vec![0.0; point.x.len()];
    let mut misfit = 0.0;
    for (index, condition) in problem.conditions.iter().enumerate() {
        let (value, unit) = (values[index], condition.unit);
        problem.variables.chain(gradients[index], &mut row);
        let Multipliers { misses, lambda, penalty, .. } = &mut point.multipliers;
        let (residual, scale) = match condition.aim {
            Aim::Near(wanted) => {
                let residual = (value - wanted) / unit;
                misfit += 0.5 * residual * residual;
                (residual, 1.0 / unit)
            }
            Aim::AtMost(limit) | Aim::AtLeast(limit) => {
                let side = if matches!(condition.aim, Aim::AtMost(_)) { 1.0 } else { -1.0 };
                misses[index] = side * (value - limit) / unit;
                let root = penalty.sqrt();
                let hinge = (misses[index] + lambda[index] / *penalty).max(0.0);
                // (max lets a value that is not a number pass as 0.)
                let hinge = if misses[index].is_nan() { f64::NAN } else { hinge };
                if hinge == 0.0 {
                    continue;
                }
                (root * hinge, side * root / unit)
            }
        };
        for derivative in &mut row {
            *derivative *= scale;
        }
        point.value += point.normal.add_row(residual, &row);
    }
    point.misfit += misfit;
    if !point.value.is_finite() {
        point.value = f64::INFINITY;
    }
}
