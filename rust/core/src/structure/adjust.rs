//! Adjusts drawings of linkages with redundant links so that the links fit at every position.
//!
//! A linkage with redundant links moves only if some lengths agree, and typed coordinates agree
//! only to their digits. Along its motion such a linkage leaves a residual `r`; the self-stress `ω`
//! of the pose (`ωᵀ J = 0`) shows that no displacement removes the part `ωᵀ r`. To first order, a
//! change `δ` of the drawing removes it if `ωᵀ (r + ∂r/∂δ · δ) = 0` at all poses. The smallest such
//! change (minimum norm) is applied repeatedly until only rounding remains.

use std::sync::atomic::AtomicBool;

use super::closure::Closure;
use super::drawing_change::{Change, Tolerance, Weights};
use super::equal_parts::with_equal_parts;
use super::fit_conditions::{FitConditions, OTHER_BRANCH, Stage};
use super::skeleton::paired_size;
use crate::description::Linkage;
use crate::description::error::StructureError;
use crate::math::tolerance::{NEARLY_REDUNDANT, UNIT_ROUNDOFF};

/// Misfit, relative to the size, up to which a drawing is exact: the rounding of coordinates.
const EXACT: f64 = 16.0 * UNIT_ROUNDOFF;
/// Misfit that a drawing can have along its motion, in units of its tolerance: a self-stress sums
/// the errors of a few coordinates.
const MISFIT_PER_TOLERANCE: f64 = 8.0;
/// Misfit allowed after an adjustment: with more, change points are missed.
const ACCEPTED: f64 = 64.0 * UNIT_ROUNDOFF;
/// Misfit below which further adjustment is useless.
const CONVERGED: f64 = 2.0 * UNIT_ROUNDOFF;
/// Least pivot of a regular pose, relative to the most regular one. Near a change point the errors
/// of linear conditions grow with the inverse square of the pivot; other poses give the same
/// conditions.
const REGULAR_PIVOT_RATIO: f64 = 0.3;
/// Most new weightings of an adjustment within a tolerance.
const MAX_WEIGHINGS: usize = 6;

/// From within the rounding of a drawing each iteration squares the error of the one before.
const OF_ROUNDING: Stage = Stage {
    nearly: NEARLY_REDUNDANT,
    least_pivot_ratio: 0.0,
    iterations: 8,
    progress: 0.5,
    until: CONVERGED,
    overshoot: 1.0,
};

/// The poses near change points, at the end of an adjustment within a tolerance. They show a misfit that the
/// other poses do not, so it may grow at first.
const NEAR_CHANGE_POINTS: Stage =
    Stage { iterations: 20, progress: f64::INFINITY, until: EXACT, overshoot: 4.0, ..OF_ROUNDING };

impl Stage {
    /// From further away. Conditions of second order only halve the distance in each iteration: to
    /// first order, the bed of a lift may be longer than the ground if its legs grow as well.
    fn of_tolerance(tolerance: Tolerance, size: f64) -> Self {
        let part = (tolerance.length / size).max(tolerance.angle);
        Self {
            nearly: (MISFIT_PER_TOLERANCE * part).clamp(NEARLY_REDUNDANT, OTHER_BRANCH),
            least_pivot_ratio: REGULAR_PIVOT_RATIO,
            iterations: 40,
            progress: 0.7,
            until: EXACT,
            overshoot: 4.0,
        }
    }
}

/// Result of an adjustment.
#[derive(Debug)]
pub(crate) enum Adjusted {
    /// The drawing fits, or nothing is redundant.
    AsDrawn,
    /// A drawing that fits, and its differences from the original.
    By(Box<Linkage>, Change),
    /// Lengths that should agree do not: the links concerned and their misfit, in m and relative
    /// to the size.
    TooFar { links: Vec<String>, gap: f64, part: f64 },
}

/// Adjusts a drawing so that its redundant links fit, within a tolerance: by default its rounding.
///
/// # Errors
///
/// [`StructureError::Interrupted`], and those of `rotations`.
pub(crate) fn adjust(
    linkage: &Linkage,
    closure: &Closure,
    tolerance: Option<Tolerance>,
    cancel: Option<&AtomicBool>,
) -> Result<Adjusted, StructureError> {
    let size = paired_size(linkage);
    let stages = match tolerance {
        None => vec![OF_ROUNDING],
        Some(tolerance) => vec![Stage::of_tolerance(tolerance, size), NEAR_CHANGE_POINTS],
    };
    let allowed = tolerance.unwrap_or(Tolerance::of_rounding(size));
    let Some(initial) = FitConditions::of(linkage, closure, stages[0], cancel)? else {
        return Ok(Adjusted::AsDrawn);
    };
    if initial.misfit() <= EXACT {
        return Ok(Adjusted::AsDrawn);
    }
    let part = initial.misfit();
    let mut weights = Weights::of(linkage, allowed, size);
    if tolerance.is_some() {
        for _ in 0..MAX_WEIGHINGS {
            let equal = with_equal_parts(linkage, &initial.links, allowed, &weights, size);
            let Some(fitted) = equal else { break };
            if !fits(&fitted, closure, cancel)? {
                break;
            }
            let change = Change::between(linkage, &fitted);
            if allowed.allows(change) {
                return Ok(Adjusted::By(Box::new(fitted), change));
            }
            weights.stiffen(linkage, &fitted, allowed);
        }
        weights = Weights::of(linkage, allowed, size);
    }
    for _ in 0..if tolerance.is_some() { MAX_WEIGHINGS } else { 1 } {
        let adjusted = converged(linkage, closure, &stages, &initial, allowed, &weights, cancel)?;
        let Some(fitted) = adjusted else { break };
        let change = Change::between(linkage, &fitted);
        if allowed.allows(change) {
            return Ok(Adjusted::By(Box::new(fitted), change));
        }
        weights.stiffen(linkage, &fitted, allowed);
    }
    Ok(Adjusted::TooFar { links: initial.links, gap: part * size, part })
}

/// Whether a drawing fits along its motion, also near its change points.
fn fits(
    linkage: &Linkage,
    closure: &Closure,
    cancel: Option<&AtomicBool>,
) -> Result<bool, StructureError> {
    let fit_conditions = FitConditions::of(linkage, closure, NEAR_CHANGE_POINTS, cancel)?;
    Ok(fit_conditions.is_some_and(|conditions| conditions.misfit() <= ACCEPTED))
}

/// The drawing that the stages lead to; `None` if it does not fit, or is far beyond the tolerance.
fn converged(
    linkage: &Linkage,
    closure: &Closure,
    stages: &[Stage],
    initial: &FitConditions,
    allowed: Tolerance,
    weights: &Weights,
    cancel: Option<&AtomicBool>,
) -> Result<Option<Linkage>, StructureError> {
    let mut best = linkage.clone();
    let mut conditions = initial.clone();
    for (index, &stage) in stages.iter().enumerate() {
        if index > 0 {
            let Some(next_conditions) = FitConditions::of(&best, closure, stage, cancel)? else {
                return Ok(None);
            };
            conditions = next_conditions;
        }
        for _ in 0..stage.iterations {
            if conditions.misfit() <= stage.until {
                break;
            }
            let next = conditions.adjusted(&best, weights);
            if !allowed.scaled(stage.overshoot).allows(Change::between(linkage, &next)) {
                return Ok(None);
            }
            match FitConditions::of(&next, closure, stage, cancel)? {
                Some(after) if after.misfit() < stage.progress * conditions.misfit() => {
                    (best, conditions) = (next, after);
                }
                _ => break,
            }
        }
    }
    Ok((conditions.misfit() <= ACCEPTED).then_some(best))
}
