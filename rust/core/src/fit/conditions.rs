//! Conditions on a design: metrics of its travel that have limits, or values to come near to.
//!
//! Each limit is a squared residual √μ·max(0, c + λ/μ), where c is by how much it is missed: see
//! [`Multipliers`].

use super::multipliers::Multipliers;
use super::point::Point;
use super::variables::Variables;
use crate::sweep::Metric;

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

/// Adds conditions to a linearised point: their values and derivatives by the dimensions that move.
pub(super) fn add_conditions(
    (conditions, variables): (&[FitCondition], &Variables),
    point: &mut Point,
    (values, gradients): (&[f64], &[&[f64]]),
) {
    let mut row = vec![0.0; point.x.len()];
    let mut misfit = 0.0;
    for (index, condition) in conditions.iter().enumerate() {
        let (value, unit) = (values[index], condition.unit);
        variables.chain(gradients[index], &mut row);
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
