//! Adjusts drawings of linkages with redundant links so that these fit at every position.
//!
//! A linkage with redundant links moves only if some lengths agree, and typed coordinates agree
//! only to their digits. Along its motion such a linkage leaves a residual `r`; the self-stress `ω`
//! of the pose (`ωᵀ J = 0`) shows that no displacement removes the part `ωᵀ r`. To first order, a
//! change `δ` of the drawing removes it if `ωᵀ (r + ∂r/∂δ · δ) = 0` at all poses. The smallest such
//! change (minimum norm) is applied repeatedly until only rounding remains.

use std::sync::atomic::AtomicBool;

use nalgebra::{DMatrix, DVector};

use super::closure::{Closure, LeftOut, rotations};
use super::least_norm::least_norm;
use super::skeleton::Skeleton;
use super::system::{SkeletonPose, System};
use crate::description::Linkage;
use crate::description::error::StructureError;
use crate::math::tolerance::{NEARLY_REDUNDANT, REDUNDANT_CLOSURE, UNIT_ROUNDOFF};

/// Misfit, relative to the size, up to which a drawing is exact: the rounding of coordinates.
const EXACT: f64 = 16.0 * UNIT_ROUNDOFF;
/// Misfit, relative to the size, above which a pose is on another branch.
const OTHER_BRANCH: f64 = 100.0 * NEARLY_REDUNDANT;
/// Misfit allowed after an adjustment: with more, change points are missed.
const ACCEPTED: f64 = 64.0 * UNIT_ROUNDOFF;
/// Misfit below which further adjustment is useless.
const CONVERGED: f64 = 2.0 * UNIT_ROUNDOFF;
/// Length of a step along the motion (rad, or relative to the size), and number of steps in each
/// sense.
const STEP: f64 = 0.2;
const STEPS: usize = 16;
/// Number of nearly fitting poses from which on a drawing is taken as meant to fit, although it
/// stops fitting along its motion.
const MIN_POSES: usize = 4;
/// Directions to try if the drawing has several motions.
const DIRECTIONS: usize = 4;
/// Least share of poses with a self-stress for links to be redundant everywhere.
const MIN_STRESSED_SHARE: f64 = 0.75;
/// Limit of iterations: each squares the error of the one before.
const MAX_ITERATIONS: usize = 8;

/// Result of an adjustment.
#[derive(Debug)]
pub(crate) enum Adjusted {
    /// The drawing fits, or nothing is redundant.
    AsDrawn,
    /// A drawing that fits, and the greatest change of a coordinate of its joints, m.
    By(Box<Linkage>, f64),
    /// Lengths that should agree do not: the links concerned and their misfit, in m and relative
    /// to the size.
    TooFar { links: Vec<String>, gap: f64, part: f64 },
}

/// Adjusts a drawing so that its redundant links fit.
///
/// # Errors
///
/// [`StructureError::Interrupted`], and those of [`rotations`].
pub(crate) fn adjust(
    linkage: &Linkage,
    closure: &Closure,
    cancel: Option<&AtomicBool>,
) -> Result<Adjusted, StructureError> {
    let Some(initial) = FitConditions::of(linkage, closure, cancel)? else {
        return Ok(Adjusted::AsDrawn);
    };
    if initial.misfit() <= EXACT {
        return Ok(Adjusted::AsDrawn);
    }
    let (part, size) = (initial.misfit(), initial.size);
    let too_far = Adjusted::TooFar { links: initial.links.clone(), gap: part * size, part };
    let (mut best, mut conditions) = (linkage.clone(), initial);
    for _ in 0..MAX_ITERATIONS {
        let next = conditions.adjusted(&best);
        if max_change(linkage, &next) > REDUNDANT_CLOSURE * size {
            return Ok(too_far);
        }
        match FitConditions::of(&next, closure, cancel)? {
            Some(after) if after.misfit() < 0.5 * conditions.misfit() => {
                (best, conditions) = (next, after);
            }
            _ => break,
        }
        if conditions.misfit() <= CONVERGED {
            break;
        }
    }
    if conditions.misfit() > ACCEPTED {
        return Ok(too_far);
    }
    let change = max_change(linkage, &best);
    Ok(Adjusted::By(Box::new(best), change))
}

/// Greatest difference between coordinates of joints in two drawings.
fn max_change(one: &Linkage, other: &Linkage) -> f64 {
    let pairs = one.joints.iter().zip(&other.joints);
    pairs.flat_map(|(a, b)| [0, 1].map(|k| (a.at[k] - b.at[k]).abs())).fold(0.0, f64::max)
}

/// Linear conditions on a change of the drawing for its redundant links to fit: a row for each
/// pose and self-stress.
struct FitConditions {
    size: f64,
    /// Names of the links and slides in a self-stress.
    links: Vec<String>,
    /// Derivatives by the coordinates of all joints (relative to the size), then by the angles of
    /// guides.
    rows: DMatrix<f64>,
    /// Misfits relative to the size.
    misfits: DVector<f64>,
}

impl FitConditions {
    /// `None` if nothing is redundant, or if it does not nearly fit along the motion.
    fn of(
        linkage: &Linkage,
        closure: &Closure,
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
        let others = (0..linkage.links.len())
            .filter(|l| *l != linkage.ground && !stressed.contains(l))
            .collect();
        // Other links are left out: they could only limit the motion.
        let left_out = LeftOut { links: others, slides: Vec::new() };
        let (free, classes) = rotations(linkage, &left_out, false)?;
        let part = Skeleton::new(linkage, closure, &free, classes, cancel);
        let part_system = System::new(linkage, closure, &left_out, &free, false);
        let found = match Self::along_motion(&part, &part_system)? {
            Some(found) => Some(found),
            // The stressed part by itself may have other motions, along which it does not fit.
            None => Self::along_motion(&skeleton, &system)?,
        };
        let links = skeleton.stressed_names(&system, &rank.stresses);
        Ok(found.map(|found| Self { links, ..found }))
    }

    /// The conditions along the motions of a system; `None` if it does not nearly fit there.
    fn along_motion(
        skeleton: &Skeleton<'_>,
        system: &System,
    ) -> Result<Option<Self>, StructureError> {
        let (mut rows, mut misfits) = (Vec::new(), Vec::new());
        let (mut poses, mut with_stress) = (0, 0);
        for pose in poses_along_motion(skeleton, system)? {
            let rank = skeleton.tolerant_rank(system, &pose)?;
            poses += 1;
            with_stress += usize::from(rank.excess > 0);
            let residual = skeleton.residual(system, &pose);
            for stress in rank.stresses.column_iter() {
                misfits.push(stress.dot(&residual));
                rows.push(skeleton.drawing_gradient(system, &pose, &stress.into_owned()));
            }
        }
        if poses == 0 || (with_stress as f64) < MIN_STRESSED_SHARE * f64::from(poses) {
            return Ok(None);
        }
        Ok(Some(Self {
            size: skeleton.size(),
            links: Vec::new(),
            rows: DMatrix::from_fn(rows.len(), rows[0].len(), |i, j| rows[i][j]),
            misfits: DVector::from_vec(misfits),
        }))
    }

    fn misfit(&self) -> f64 {
        self.misfits.amax()
    }

    /// The drawing after the smallest change that meets the conditions.
    fn adjusted(&self, linkage: &Linkage) -> Linkage {
        let change = least_norm(self.rows.clone(), &self.misfits);
        let mut next = linkage.clone();
        for (j, joint) in next.joints.iter_mut().enumerate() {
            for (k, at) in joint.at.iter_mut().enumerate() {
                *at += self.size * change[2 * j + k];
            }
        }
        for (s, slide) in next.slides.iter_mut().enumerate() {
            slide.angle += change[2 * linkage.joints.len() + s];
        }
        next
    }
}

/// Poses along the motion, in both senses from the drawing, while the linkage nearly fits. Empty
/// if it stops fitting after fewer than [`MIN_POSES`] poses.
fn poses_along_motion(
    skeleton: &Skeleton<'_>,
    system: &System,
) -> Result<Vec<SkeletonPose>, StructureError> {
    let start = skeleton.tolerant_rank(system, skeleton.drawing())?;
    let (mut found, mut stops_fitting) = (Vec::new(), false);
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
                let Some((next, misfit)) = skeleton.project_tolerant(system, &pose, &step)? else {
                    break;
                };
                if misfit > OTHER_BRANCH {
                    break;
                }
                if misfit > NEARLY_REDUNDANT {
                    stops_fitting = true;
                    break;
                }
                let motions = skeleton.tolerant_rank(system, &next)?.motions;
                // Continue in the direction closest to the previous one.
                let Some(gram) = motions.tr_mul(&motions).cholesky() else { break };
                tangent = &motions * gram.solve(&motions.tr_mul(&tangent));
                found.push(next.clone());
                pose = next;
            }
        }
    }
    // Near a change point the square root of the misfit appears, after several poses that nearly
    // fit. A drawing that is only singular by chance stops fitting at once.
    Ok(if stops_fitting && found.len() < MIN_POSES { Vec::new() } else { found })
}
