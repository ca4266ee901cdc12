//! The pairs without load: the rounding of a computed reaction.

use super::pairs::{FrictionPair, PairKind};
use super::workspace::FrictionWorkspace;
use crate::dynamics::reactions::scene::Scene;
use crate::math::lanes::Real;
use crate::math::tolerance::UNIT_ROUNDOFF;
use crate::math::vector::Vector;

/// A reaction below this part of the greatest force is rounding. Moments that pass through links without
/// loads leave some u.
const FORCE_ROUNDING: f64 = 64.0 * UNIT_ROUNDOFF;

// Loops: closures would not be compiled with the level's instructions.
impl<R: Real> Scene<R> {
    /// The greatest force of a load or between links; moments are divided by a length.
    #[inline(always)]
    pub(crate) fn greatest_force(&self, length: f64) -> R {
        let mut greatest = R::ZERO;
        for force in self.edge_force.iter().chain(&self.link_force) {
            greatest = greatest.max(force.size());
        }
        for &moment in &self.link_moment {
            greatest = greatest.max(moment.abs() * R::splat(1.0 / length));
        }
        greatest
    }
}

impl<R: Real> FrictionWorkspace<R> {
    /// The pairs of a list that have a load in a lane: their reactions are more than rounding, or depend on
    /// the friction of such pairs. Rounding alone would decide whether the others lock.
    pub(super) fn loaded(
        &self,
        mut sliding: Vec<usize>,
        pairs: &[FrictionPair],
        lane: usize,
    ) -> Vec<usize> {
        let is_rounding = |pair: usize, reaction: Vector<R>, greatest: R| {
            let least = FORCE_ROUNDING * greatest.lane(lane);
            let of_second = match pairs[pair].kind {
                PairKind::Journal { .. } => 1.0,
                PairKind::Guide { .. } => self.length,
            };
            reaction.x.lane(lane).abs() <= least && reaction.y.lane(lane).abs() <= least * of_second
        };
        let mut unloaded = sliding.clone();
        unloaded.retain(|&pair| is_rounding(pair, self.base[pair], self.force));
        loop {
            let earlier = unloaded.clone();
            unloaded.retain(|&pair| {
                sliding.iter().all(|&on| {
                    earlier.contains(&on)
                        || is_rounding(pair, self.slopes[on][pair], self.forces_per_unit[on])
                })
            });
            if unloaded.len() == earlier.len() {
                break;
            }
        }
        sliding.retain(|pair| !unloaded.contains(pair));
        sliding
    }
}
