//! The pairs that rest while others move: the rounding of a computed relative speed.

use super::workspace::FrictionWorkspace;
use crate::dynamics::reactions::force_plan::{ForceEdge, ForcePlan};
use crate::dynamics::reactions::scene::Scene;
use crate::dynamics::reactions::steps::Transposed;
use crate::math::lanes::Real;
use crate::math::tolerance::{CLOSURE_PER_CONDITION, UNIT_ROUNDOFF};

/// A relative speed below this part of the drivers' speed is rounding: then a pair rests.
pub(crate) const AT_REST: f64 = 1.0e-12;
/// Rounding of a relative speed, relative to the speeds that add up to it: each is good to some u. The
/// greatest value at 8000 positions of pairs whose links move as one body was 15 u.
pub(crate) const RATE_ROUNDING: f64 = 64.0 * UNIT_ROUNDOFF;

// Loops: closures would not be compiled with the level's instructions.
impl<R: Real> FrictionWorkspace<R> {
    /// A bound of the rounding in the relative speed of the pair in which a unit of friction acts.
    ///
    /// The power of that unit is the relative speed. By virtual power it equals that of the forces that
    /// balance it: to first order, an error of a closed path's velocities counts times the force that
    /// closes the path. These forces grow with the condition of every group on which the pair depends.
    #[inline(always)]
    pub(crate) fn rate_rounding(&self, scene: &Scene<R>) -> R {
        let mut power = R::ZERO;
        for (force, &error) in scene.edge_force.iter().zip(&self.edge_errors) {
            power += force.size() * error;
        }
        power
    }

    /// Finds the errors with which the velocities along every edge close their path: their own rounding and
    /// that of the position, which grows with the condition of its dyad.
    #[inline(always)]
    pub(crate) fn find_edge_errors(&mut self, scene: &Scene<R>, plan: &ForcePlan) {
        let speeds = &self.point_speeds;
        let mut errors = std::mem::take(&mut self.edge_errors);
        errors.clear();
        for edge in &plan.edges {
            errors.push((speeds[edge.from] + speeds[edge.to]) * R::splat(RATE_ROUNDING));
        }
        for step in &plan.steps {
            let Transposed::Close { closures, .. } = step else { continue };
            let ([path], &[first, second]) = (&closures.paths[..], &closures.unknowns[..]) else {
                // The iteration of a group above class II ends where its paths close to rounding.
                continue;
            };
            let (a, b) = (scene.column(plan, path, first), scene.column(plan, path, second));
            let condition = a.norm() * b.norm() / a.cross(b).abs();
            for &(edge, _) in &path.edges {
                let ForceEdge { from, to, .. } = plan.edges[edge];
                errors[edge] +=
                    (speeds[from] + speeds[to]) * condition * R::splat(CLOSURE_PER_CONDITION);
            }
        }
        self.edge_errors = errors;
    }
}
