//! Mobility by rank: ranks of the closure equations at the drawing and at
//! displaced, regular positions.
//!
//! A drawing can be singular by chance (a four-bar drawn collinear), and special
//! dimensions can make a counted structure move (a parallelogram with a third
//! bar). Moving the linkage distinguishes the two: a step from the drawing along
//! the null space, Gauss-Newton back onto the closure, and the rank there. A shaky
//! structure does not move: its mobility is 0.

use nalgebra::{DMatrix, DVector};

use super::rank;
use super::rank::Rank;
use super::skeleton::Skeleton;
use super::system::{ClosureUnknown, SkeletonPose, System};
use crate::description::error::{Interrupted, check_flag};
use crate::math::tolerance::{NEARLY_DEPENDENT, RANK, REGULAR_CLOSURE, TRUNCATED};

impl Skeleton<'_> {
    /// Rank, motions and self-stresses of a system in a pose.
    ///
    /// # Errors
    ///
    /// [`Interrupted`].
    pub(crate) fn rank(&self, system: &System, pose: &SkeletonPose) -> Result<Rank, Interrupted> {
        self.rank_above(RANK, system, pose)
    }

    /// [`Self::rank`], counting nearly dependent equations as dependent.
    ///
    /// # Errors
    ///
    /// [`Interrupted`].
    pub(crate) fn tolerant_rank(
        &self,
        system: &System,
        pose: &SkeletonPose,
    ) -> Result<Rank, Interrupted> {
        self.rank_above(NEARLY_DEPENDENT, system, pose)
    }

    fn rank_above(
        &self,
        threshold: f64,
        system: &System,
        pose: &SkeletonPose,
    ) -> Result<Rank, Interrupted> {
        self.check_cancelled()?;
        let (jacobian, unknowns) = (self.jacobian(system, pose), system.unknowns.len());
        rank::rank(jacobian, unknowns, threshold, || self.check_cancelled().is_err())
    }

    fn check_cancelled(&self) -> Result<(), Interrupted> {
        check_flag(self.cancel)
    }

    /// Poses displaced from the drawing along its null space in pseudo-random directions, in
    /// ascending order of mobility, so that the most regular come first. Empty if the linkage
    /// is rigid.
    ///
    /// # Errors
    ///
    /// [`Interrupted`].
    pub(crate) fn displaced_poses(
        &self,
        system: &System,
    ) -> Result<Vec<(SkeletonPose, Rank)>, Interrupted> {
        let initial = self.rank(system, self.drawing())?;
        if initial.mobility == 0 {
            return Ok(Vec::new());
        }
        let mut random = 0x9E37_79B9_7F4A_7C15_u64;
        let mut poses: Vec<(SkeletonPose, Rank)> = Vec::new();
        // Several directions, because several branches of motion meet in a singular drawing.
        for _ in 0..8 {
            for amplitude in [0.1, 0.03, -0.1, -0.03, 0.01, 0.003] {
                let weights =
                    DVector::from_fn(initial.motions.ncols(), |_, _| next_random(&mut random));
                let direction = &initial.motions * weights;
                let step = direction.scale(amplitude / direction.amax().max(f64::MIN_POSITIVE));
                if let Some(reached) = self.project(system, self.drawing(), &step)? {
                    let rank = self.rank(system, &reached)?;
                    poses.push((reached, rank));
                    break;
                }
            }
        }
        poses.sort_by_key(|(_, rank)| rank.mobility);
        Ok(poses)
    }

    /// Takes a step and returns onto the closure by Gauss-Newton. `None` if that fails or undoes
    /// most of the step.
    fn project(
        &self,
        system: &System,
        from: &SkeletonPose,
        step: &DVector<f64>,
    ) -> Result<Option<SkeletonPose>, Interrupted> {
        let mut pose = from.after_step(step, system);
        let mut total = step.clone();
        for _ in 0..30 {
            let residual = self.residual(system, &pose);
            if residual.amax() < REGULAR_CLOSURE {
                return Ok((total.amax() > 0.25 * step.amax()).then_some(pose));
            }
            let correction = self.gauss_newton_step(system, &pose, &residual, TRUNCATED)?;
            if !correction.amax().is_finite() || correction.amax() > 1.0 {
                return Ok(None);
            }
            total += &correction;
            pose = pose.after_step(&correction, system);
        }
        Ok(None)
    }

    /// [`Self::project`], ignoring nearly dependent equations, whose misfit is up to `nearly`. Also
    /// returns the greatest residual, which these equations leave.
    ///
    /// # Errors
    ///
    /// [`Interrupted`].
    pub(crate) fn project_tolerant(
        &self,
        system: &System,
        from: &SkeletonPose,
        step: &DVector<f64>,
        nearly: f64,
    ) -> Result<Option<(SkeletonPose, f64)>, Interrupted> {
        let mut pose = from.after_step(step, system);
        let mut total = step.clone();
        let mut previous = f64::INFINITY;
        for _ in 0..30 {
            let residual = self.residual(system, &pose);
            let correction = self.gauss_newton_step(system, &pose, &residual, NEARLY_DEPENDENT)?;
            let length = correction.amax();
            if !length.is_finite() || length > 1.0 {
                return Ok(None);
            }
            total += &correction;
            pose = pose.after_step(&correction, system);
            // The ignored equations may change from step to step. The steps then remain as
            // long as the residuals of these equations.
            let converged =
                length < REGULAR_CLOSURE || (length < nearly && length > 0.5 * previous);
            previous = length;
            if converged {
                let misfit = self.residual(system, &pose).amax();
                return Ok((total.amax() > 0.25 * step.amax()).then_some((pose, misfit)));
            }
        }
        Ok(None)
    }

    /// One step of Gauss-Newton.
    fn gauss_newton_step(
        &self,
        system: &System,
        pose: &SkeletonPose,
        residual: &DVector<f64>,
        threshold: f64,
    ) -> Result<DVector<f64>, Interrupted> {
        self.check_cancelled()?;
        let (jacobian, unknowns) = (self.jacobian(system, pose), system.unknowns.len());
        Ok(-rank::solve(jacobian, unknowns, threshold, residual, || {
            self.check_cancelled().is_err()
        })?)
    }

    /// Links that any of the motions (columns over the unknowns) moves.
    #[must_use]
    pub(crate) fn moving_links(&self, system: &System, motions: &DMatrix<f64>) -> Vec<usize> {
        let moves = |selected: &dyn Fn(ClosureUnknown) -> bool| {
            let rows = system.unknowns.iter().enumerate().filter(|(_, u)| selected(**u));
            rows.map(|(row, _)| motions.row(row).amax()).fold(0.0, f64::max)
                > 1e-6 * motions.amax().max(f64::MIN_POSITIVE)
        };
        (0..self.linkage.links.len())
            .filter(|&l| l != self.linkage.ground)
            .filter(|&l| {
                let (class, point) = (system.class_of[l], self.closure.reference[l]);
                moves(&|u| match u {
                    ClosureUnknown::Class(c) => c == class,
                    ClosureUnknown::Point { point: p, .. } => p == point,
                    ClosureUnknown::Slide(_) => false,
                })
            })
            .collect()
    }

    /// Names of the links and slides with equations in a self-stress.
    #[must_use]
    pub(crate) fn stressed_names(&self, system: &System, stresses: &DMatrix<f64>) -> Vec<String> {
        let (links, slides) = self.stressed_parts(system, stresses);
        let links = links.into_iter().map(|l| self.linkage.links[l].name.clone());
        links.chain(slides.into_iter().map(|s| self.linkage.slides[s].name.clone())).collect()
    }

    /// Indices of the moving links, and of the slides, with equations in a self-stress.
    #[must_use]
    pub(crate) fn stressed_parts(
        &self,
        system: &System,
        stresses: &DMatrix<f64>,
    ) -> (Vec<usize>, Vec<usize>) {
        let limit = 1e-6 * stresses.amax().max(f64::MIN_POSITIVE);
        let (mut links, mut slides) = (Vec::new(), Vec::new());
        for (row, &e) in system.edges.iter().enumerate() {
            if stresses.ncols() > 0 && stresses.rows(2 * row, 2).amax() > limit {
                links.push(self.closure.edges[e].link);
                if let Some(slide) = self.closure.edges[e].slide() {
                    links.push(self.linkage.slides[slide].link);
                    slides.push(slide);
                }
            }
        }
        links.sort_unstable();
        links.dedup();
        links.retain(|&l| l != self.linkage.ground);
        (links, slides)
    }
}

/// xorshift64* in (−1, 1) (Marsaglia 2003, Vigna 2016). The seed is fixed, so that
/// the same description always gives the same result.
fn next_random(state: &mut u64) -> f64 {
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    let bits = state.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
    // 53 bits are exact in a double.
    let unit = bits as f64 / (1_u64 << 53) as f64;
    2.0 * unit - 1.0
}
