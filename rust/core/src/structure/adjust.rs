//! Drawings of linkages with redundant links: adjusted until these fit at every position.
//!
//! Redundant links move only if some lengths agree, and typed coordinates agree to the digits they
//! have. Moved along its motion, such a linkage misses its closure by `r`; the self-stress `ω` of
//! the pose (`ωᵀ J = 0`) says that no displacement makes up for the part `ωᵀ r`. To first order a
//! change `δ` of the drawing does where `ωᵀ (r + ∂r/∂δ · δ) = 0` at all poses: the least such
//! change is found (minimum norm), and that again until nothing but rounding is left.

use std::sync::atomic::AtomicBool;

use nalgebra::{DMatrix, DVector};

use super::closure::{Closure, LeftOut, list, rotations};
use super::freedom::{Pose, Skeleton, System};
use super::least_norm::least_norm;
use crate::description::Linkage;
use crate::description::error::StructureError;
use crate::math::tolerance::{NEARLY_REDUNDANT, REDUNDANT_CLOSURE, UNIT_ROUNDOFF};

/// A misfit that is nothing but the rounding of coordinates, of the size.
const EXACT: f64 = 16.0 * UNIT_ROUNDOFF;
/// Misfit of a pose that is on another branch, of the size.
const FAR_OFF: f64 = 100.0 * NEARLY_REDUNDANT;
/// What may be left after an adjustment: change points are missed by more.
const FITS: f64 = 64.0 * UNIT_ROUNDOFF;
/// Where nothing is left to be adjusted.
const DONE: f64 = 2.0 * UNIT_ROUNDOFF;
/// Length of a step along the motion (rad, or of the size), and steps each way.
const STEP: f64 = 0.2;
const STEPS: usize = 16;
/// Poses that nearly fit before one that does not, for a drawing to be one that should.
const LEAST_POSES: usize = 4;
/// Directions that are tried where the drawing does not show which way it moves.
const DIRECTIONS: usize = 4;
/// Part of the poses at which a link must be redundant to be so everywhere.
const MOSTLY: f64 = 0.75;
/// Rounds, at most: each leaves the square of what the one before left.
const ROUNDS: usize = 8;

/// A drawing that was looked at.
#[derive(Debug)]
pub(crate) enum Adjusted {
    /// It fits, or nothing is redundant.
    AsDrawn,
    /// Another drawing that fits, and how far its joints were moved at most, m.
    By(Box<Linkage>, f64),
    /// Lengths that should agree do not: the links concerned, by how much they miss (m), and what
    /// part of the size that is.
    TooFar { links: String, gap: f64, part: f64 },
}

/// Adjusts a drawing.
///
/// # Errors
///
/// [`StructureError::Interrupted`], and those of [`rotations`].
pub(crate) fn adjust(
    linkage: &Linkage,
    closure: &Closure,
    cancel: Option<&AtomicBool>,
) -> Result<Adjusted, StructureError> {
    let Some(first) = Conditions::of(linkage, closure, cancel)? else {
        return Ok(Adjusted::AsDrawn);
    };
    if first.misfit() <= EXACT {
        return Ok(Adjusted::AsDrawn);
    }
    let (part, size) = (first.misfit(), first.size);
    let too_far = Adjusted::TooFar { links: first.links.clone(), gap: part * size, part };
    let (mut best, mut conditions) = (linkage.clone(), first);
    for _ in 0..ROUNDS {
        let next = conditions.met(&best);
        if moved(linkage, &next) > REDUNDANT_CLOSURE * size {
            return Ok(too_far);
        }
        match Conditions::of(&next, closure, cancel)? {
            Some(after) if after.misfit() < 0.5 * conditions.misfit() => {
                (best, conditions) = (next, after);
            }
            _ => break,
        }
        if conditions.misfit() <= DONE {
            break;
        }
    }
    if conditions.misfit() > FITS {
        return Ok(too_far);
    }
    let by = moved(linkage, &best);
    Ok(Adjusted::By(Box::new(best), by))
}

/// How far the joints of one drawing are from those of another, at most.
fn moved(one: &Linkage, other: &Linkage) -> f64 {
    let pairs = one.joints.iter().zip(&other.joints);
    pairs.flat_map(|(a, b)| [0, 1].map(|k| (a.at[k] - b.at[k]).abs())).fold(0.0, f64::max)
}

/// What a drawing must meet for its redundant links to fit: a row for every pose and self-stress.
struct Conditions {
    size: f64,
    /// Names of links and slides that are under stress.
    links: String,
    /// Derivatives by the coordinates of all joints (of the size), then by the angles of guides.
    rows: DMatrix<f64>,
    /// Misfits, of the size.
    misfits: DVector<f64>,
}

impl Conditions {
    /// None if nothing is redundant.
    fn of(
        linkage: &Linkage,
        closure: &Closure,
        cancel: Option<&AtomicBool>,
    ) -> Result<Option<Self>, StructureError> {
        let everything = LeftOut::default();
        let (free, classes) = rotations(linkage, &everything, false)?;
        let skeleton = Skeleton::new(linkage, closure, &free, classes, cancel);
        let system = System::new(linkage, closure, &everything, &free, false);
        let here = skeleton.nearly_rank(&system, skeleton.drawing())?;
        if here.excess == 0 || here.mobility == 0 {
            return Ok(None);
        }
        let (under_stress, _) = skeleton.under_stress(&system, &here.stresses);
        let others = (0..linkage.links.len())
            .filter(|l| *l != linkage.ground && !under_stress.contains(l))
            .collect();
        // What is not under stress would only end the walk sooner.
        let rest = LeftOut { links: others, slides: Vec::new() };
        let (free, classes) = rotations(linkage, &rest, false)?;
        let part = Skeleton::new(linkage, closure, &free, classes, cancel);
        let of_part = System::new(linkage, closure, &rest, &free, false);
        let found = match Self::along(&part, &of_part)? {
            Some(found) => Some(found),
            // Alone it may have other motions, along which it does not fit.
            None => Self::along(&skeleton, &system)?,
        };
        let links = skeleton.stressed(&system, &here.stresses);
        let links = list(links.iter().map(String::as_str));
        Ok(found.map(|found| Self { links, ..found }))
    }

    /// Those along the motions of a system; none if it does not nearly fit there.
    fn along(skeleton: &Skeleton<'_>, system: &System) -> Result<Option<Self>, StructureError> {
        let (mut rows, mut misfits) = (Vec::new(), Vec::new());
        let (mut poses, mut stressed) = (0, 0);
        for pose in walk(skeleton, system)? {
            let rank = skeleton.nearly_rank(system, &pose)?;
            poses += 1;
            stressed += usize::from(rank.excess > 0);
            let residual = skeleton.residual(system, &pose);
            for stress in rank.stresses.column_iter() {
                misfits.push(stress.dot(&residual));
                rows.push(skeleton.by_drawing(system, &pose, &stress.into_owned()));
            }
        }
        if poses == 0 || (stressed as f64) < MOSTLY * f64::from(poses) {
            return Ok(None);
        }
        Ok(Some(Self {
            size: skeleton.size(),
            links: String::new(),
            rows: DMatrix::from_fn(rows.len(), rows[0].len(), |i, j| rows[i][j]),
            misfits: DVector::from_vec(misfits),
        }))
    }

    fn misfit(&self) -> f64 {
        self.misfits.amax()
    }

    /// The drawing with the least change that meets them.
    fn met(&self, linkage: &Linkage) -> Linkage {
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

/// Poses along the motion, both ways from the drawing, as far as it nearly fits; none if it does not at
/// more than a few.
fn walk(skeleton: &Skeleton<'_>, system: &System) -> Result<Vec<Pose>, StructureError> {
    let start = skeleton.nearly_rank(system, skeleton.drawing())?;
    let (mut found, mut ends) = (Vec::new(), false);
    let directions = if start.mobility == 1 { 1 } else { DIRECTIONS };
    for direction in 0..directions {
        // Any mixture; the same one in every run.
        let weights = DVector::from_fn(start.motions.ncols(), |k, _| {
            (1.0 + 2.3 * (k + 3 * direction) as f64) % 1.7 - 0.83
        });
        for way in [1.0, -1.0] {
            let mut pose = skeleton.drawing().clone();
            let mut along = (&start.motions * &weights).scale(way);
            for _ in 0..STEPS {
                let step = along.scale(STEP / along.amax().max(f64::MIN_POSITIVE));
                let Some((next, misfit)) = skeleton.project_nearly(system, &pose, &step)? else {
                    break;
                };
                if misfit > FAR_OFF {
                    // Another branch, where they do not fit at all.
                    break;
                }
                if misfit > NEARLY_REDUNDANT {
                    ends = true;
                    break;
                }
                let motions = skeleton.nearly_rank(system, &next)?.motions;
                // The motion there that goes on as before.
                let Some(gram) = motions.tr_mul(&motions).cholesky() else { break };
                along = &motions * gram.solve(&motions.tr_mul(&along));
                found.push(next.clone());
                pose = next;
            }
        }
    }
    // Beside a change point the root of what they miss by shows; beside a drawing that is singular by
    // chance they miss at once.
    Ok(if ends && found.len() < LEAST_POSES { Vec::new() } else { found })
}
