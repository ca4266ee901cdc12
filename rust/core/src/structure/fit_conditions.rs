//! Conditions on a drawing for its redundant links to fit along its motion.

use std::sync::atomic::AtomicBool;

use nalgebra::{DMatrix, DVector};

use super::closure::{Closure, LeftOut, rotations};
use super::drawing_change::{Weights, changed};
use super::least_norm::least_norm;
use super::skeleton::Skeleton;
use super::system::{SkeletonPose, System};
use crate::description::Linkage;
use crate::description::error::StructureError;
use crate::math::tolerance::NEARLY_REDUNDANT;

/// Misfit, relative to the size, above which a pose is on another branch.
pub(super) const OTHER_BRANCH: f64 = 100.0 * NEARLY_REDUNDANT;
/// Length of a step along the motion (rad, or relative to the size), and number of steps in each
/// sense.
const STEP: f64 = 0.2;
const STEPS: usize = 16;
/// With at least this many nearly fitting poses a drawing counts as meant to fit, although it stops fitting
/// along its motion.
const MIN_POSES: usize = 4;
/// Directions to try if the drawing has several motions.
const DIRECTIONS: usize = 4;
/// Least share of poses with a self-stress for links to be redundant everywhere.
const MIN_STRESSED_SHARE: f64 = 0.75;
/// Remainder of the conditions after a change, in units of the squared misfit: the conditions are linear.
const CURVATURE: f64 = 16.0;

/// A stage of an adjustment: the poses that give conditions, and the end of the stage.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stage {
    /// Greatest misfit, relative to the size, at which links that should be redundant nearly fit.
    pub(super) nearly: f64,
    /// Least pivot of a pose, relative to the greatest such of all poses.
    pub(super) least_pivot_ratio: f64,
    /// Limit of iterations.
    pub(super) iterations: usize,
    /// Factor by which each iteration must lower the misfit.
    pub(super) progress: f64,
    /// Misfit at which it ends.
    pub(super) until: f64,
    /// Greatest change on the way, in units of the change allowed at the end.
    pub(super) overshoot: f64,
}

/// Linear conditions on a change of the drawing for its redundant links to fit: a row for each
/// pose and self-stress.
#[derive(Clone)]
pub(super) struct FitConditions {
    size: f64,
    /// Names of the links and slides in a self-stress.
    pub(super) links: Vec<String>,
    /// Derivatives by the coordinates of all joints (relative to the size), then by the angles of
    /// guides.
    rows: DMatrix<f64>,
    /// Misfits relative to the size.
    misfits: DVector<f64>,
}

impl FitConditions {
    /// `None` if nothing is redundant, or if it does not nearly fit along the motion.
    pub(super) fn of(
        linkage: &Linkage,
        closure: &Closure,
        stage: Stage,
        cancel: Option<&AtomicBool>,
    ) -> Result<Option<Self>, StructureError> {
        let none_left_out = LeftOut::default();
        let (free, classes) = rotations(linkage, &none_left_out, false)?;
        let skeleton = Skeleton::new(linkage, closure, &free, classes, cancel);
        let system = System::new(linkage, closure, &none_left_out, &free, false);
        let rank = skeleton.tolerant_rank(&system, skeleton.drawing())?;
        if rank.excess == 0 || rank.mobility == 0 {
            return Ok(None);
        }
        let (stressed, _) = skeleton.stressed_parts(&system, &rank.stresses);
        let unstressed = (0..linkage.links.len())
            .filter(|l| *l != linkage.ground && !stressed.contains(l))
            .collect();
        // Other links are left out: they could only limit the motion.
        let left_out = LeftOut { links: unstressed, slides: Vec::new() };
        let (free, classes) = rotations(linkage, &left_out, false)?;
        let part = Skeleton::new(linkage, closure, &free, classes, cancel);
        let part_system = System::new(linkage, closure, &left_out, &free, false);
        let conditions = match Self::along_motion(&part, &part_system, stage)? {
            Some(conditions) => Some(conditions),
            // The stressed part alone may have other motions, along which it does not fit.
            None => Self::along_motion(&skeleton, &system, stage)?,
        };
        let links = skeleton.stressed_names(&system, &rank.stresses);
        Ok(conditions.map(|conditions| Self { links, ..conditions }))
    }

    /// The conditions along the motions of a system; `None` if it does not nearly fit there.
    fn along_motion(
        skeleton: &Skeleton<'_>,
        system: &System,
        stage: Stage,
    ) -> Result<Option<Self>, StructureError> {
        let mut poses = Vec::new();
        for pose in poses_along_motion(skeleton, system, stage)? {
            let rank = skeleton.tolerant_rank(system, &pose)?;
            poses.push((pose, rank));
        }
        let with_stress = poses.iter().filter(|(_, rank)| rank.excess > 0).count();
        if poses.is_empty() || (with_stress as f64) < MIN_STRESSED_SHARE * (poses.len() as f64) {
            return Ok(None);
        }
        let most_regular = poses.iter().map(|(_, rank)| rank.least_pivot).fold(0.0, f64::max);
        let least_pivot = stage.least_pivot_ratio * most_regular;
        let (mut rows, mut misfits) = (Vec::new(), Vec::new());
        for (pose, rank) in poses.iter().filter(|(_, rank)| rank.least_pivot >= least_pivot) {
            let residual = skeleton.residual(system, pose);
            for stress in rank.stresses.column_iter() {
                misfits.push(stress.dot(&residual));
                rows.push(skeleton.drawing_gradient(system, pose, &stress.into_owned()));
            }
        }
        if rows.is_empty() {
            return Ok(None);
        }
        Ok(Some(Self {
            size: skeleton.size(),
            links: Vec::new(),
            rows: DMatrix::from_fn(rows.len(), rows[0].len(), |i, j| rows[i][j]),
            misfits: DVector::from_vec(misfits),
        }))
    }

    /// Greatest misfit, relative to the size.
    pub(super) fn misfit(&self) -> f64 {
        self.misfits.amax()
    }

    /// The drawing after the smallest weighted change that meets the conditions.
    pub(super) fn adjusted(&self, linkage: &Linkage, weights: &Weights) -> Linkage {
        let mut rows = self.rows.clone();
        for (mut column, &weight) in rows.column_iter_mut().zip(weights.0.iter()) {
            column *= weight;
        }
        let error = CURVATURE * self.misfit() * self.misfit();
        let change = least_norm(rows, &self.misfits, error).component_mul(&weights.0);
        changed(linkage, &change, self.size)
    }
}

/// Poses along the motion, in both senses from the drawing, while the linkage nearly fits: up to
/// the stage's misfit. Empty if it stops fitting after fewer than [`MIN_POSES`] poses.
fn poses_along_motion(
    skeleton: &Skeleton<'_>,
    system: &System,
    stage: Stage,
) -> Result<Vec<SkeletonPose>, StructureError> {
    let start = skeleton.tolerant_rank(system, skeleton.drawing())?;
    let (mut poses, mut stops_fitting) = (Vec::new(), false);
    let directions = if start.mobility == 1 { 1 } else { DIRECTIONS };
    for direction in 0..directions {
        // Arbitrary weights, but the same in every run.
        let weights = DVector::from_fn(start.motions.ncols(), |k, _| {
            (1.0 + 2.3 * (k + 3 * direction) as f64) % 1.7 - 0.83
        });
        for sense in [1.0, -1.0] {
            let mut pose = skeleton.drawing().clone();
            let mut tangent = (&start.motions * &weights).scale(sense);
            for _ in 0..STEPS {
                let step = tangent.scale(STEP / tangent.amax().max(f64::MIN_POSITIVE));
                let projected = skeleton.project_tolerant(system, &pose, &step, stage.nearly)?;
                let Some((next, misfit)) = projected else { break };
                if misfit > OTHER_BRANCH {
                    break;
                }
                if misfit > stage.nearly {
                    stops_fitting = true;
                    break;
                }
                let rank = skeleton.tolerant_rank(system, &next)?;
                // Too far off for the links to be redundant here.
                if stage.least_pivot_ratio > 0.0 && rank.excess == 0 {
                    break;
                }
                let motions = rank.motions;
                // Continue in the direction closest to the previous one.
                let Some(gram) = motions.tr_mul(&motions).cholesky() else { break };
                tangent = &motions * gram.solve(&motions.tr_mul(&tangent));
                poses.push(next.clone());
                pose = next;
            }
        }
    }
    // Near a change point the square root of the misfit appears, after several poses that nearly
    // fit. A drawing that is only singular by chance stops fitting at once.
    Ok(if stops_fitting && poses.len() < MIN_POSES { Vec::new() } else { poses })
}
