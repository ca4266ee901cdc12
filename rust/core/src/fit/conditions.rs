//! Conditions on a design: metrics of its travel that have limits, or values to come near to.
//!
//! Each limit is a squared residual √μ·max(0, c + λ/μ), where c is by how much it is missed: see
//! [`super::multipliers`].

use super::point::Point;
use super::variables::Variables;
use crate::sweep::Metric;

/// Limits are narrowed by this part of their unit: positions of the travel may miss an extreme by as much. A limit
/// counts as kept if it is missed by less than that.
const MARGIN: f64 = 2e-4;
pub(super) const KEPT: f64 = 1.9e-4;

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

/// Sets by how much limits are missed.
pub(super) fn set_misses(conditions: &[FitCondition], point: &mut Point, values: &[f64]) {
    for ((condition, &value), miss) in
        conditions.iter().zip(values).zip(&mut point.multipliers.misses)
    {
        *miss = match condition.aim {
            Aim::Near(_) => 0.0,
            Aim::AtMost(limit) => (value - limit) / condition.unit + MARGIN,
            Aim::AtLeast(limit) => (limit - value) / condition.unit + MARGIN,
        };
        if miss.is_nan() {
            point.value = f64::INFINITY;
        }
    }
}

/// Whether a condition counts where a point is: a target, or a limit that is missed or pressed upon.
pub(super) fn is_active(conditions: &[FitCondition], point: &Point) -> bool {
    let hinge = |index: usize| point.multipliers.hinge(index) > 0.0;
    point.value.is_finite()
        && conditions
            .iter()
            .enumerate()
            .any(|(index, one)| matches!(one.aim, Aim::Near(_)) || hinge(index))
}

/// Adds conditions to a linearised point: their values and derivatives by the dimensions that move.
pub(super) fn add_conditions(
    (conditions, variables): (&[FitCondition], &Variables),
    point: &mut Point,
    (values, gradients): (&[f64], &[&[f64]]),
) {
    let mut row = vec![0.0; point.x.len()];
    for (index, condition) in conditions.iter().enumerate() {
        variables.chain(gradients[index], &mut row);
        let (residual, scale) = match condition.aim {
            Aim::Near(wanted) => {
                let residual = (values[index] - wanted) / condition.unit;
                point.misfit += 0.5 * residual * residual;
                (residual, 1.0)
            }
            Aim::AtMost(_) | Aim::AtLeast(_) => {
                let hinge = point.multipliers.hinge(index);
                if hinge == 0.0 {
                    continue;
                }
                let side = if matches!(condition.aim, Aim::AtMost(_)) { 1.0 } else { -1.0 };
                let root = point.multipliers.penalty.sqrt();
                (root * hinge, side * root)
            }
        };
        for derivative in &mut row {
            *derivative *= scale / condition.unit;
        }
        point.value += point.normal.add_row(residual, &row);
    }
    if !point.value.is_finite() {
        point.value = f64::INFINITY;
    }
}
