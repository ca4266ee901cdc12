//! Work space of friction: how fast pairs slide, how their reactions depend on friction, and the friction
//! found.

use crate::math::lanes::Real;
use crate::math::vector::Vector;

/// The speeds of pairs with friction, the dependence of their reactions on it, and the friction found.
#[derive(Debug, Clone, Default)]
pub(crate) struct FrictionWorkspace<R: Real> {
    /// Whether the static law holds; `None`: where all drivers rest.
    pub is_static: Option<bool>,
    /// Speed of every pair, and the same with the speeds that drivers at rest are about to have.
    pub speeds: Vec<[R; 2]>,
    /// Speeds below which a pair rests.
    pub still: Vec<R>,
    /// Greatest speed of every point over all drivers, with the speeds that drivers at rest are about to have.
    pub point_speeds: Vec<R>,
    /// Error with which the velocities along every edge may close their path.
    pub edge_errors: Vec<R>,
    /// Reactions without friction, and per unit of friction in every pair.
    pub base: Vec<Vector<R>>,
    pub slopes: Vec<Vec<Vector<R>>>,
    /// The greatest force without friction, and per unit of friction in every pair; moments are divided by
    /// `length`, the unit of length.
    pub force: R,
    pub forces_per_unit: Vec<R>,
    pub length: f64,
    /// Moments or forces of friction, with the viscous part.
    pub efforts: Vec<R>,
    /// Number of solutions.
    pub solutions: R,
    pub safety: R,
    /// Residual of the law of friction, relative to the greatest friction.
    pub residual: R,
}

impl<R: Real> FrictionWorkspace<R> {
    /// The power that friction dissipates in a pair.
    #[inline(always)]
    pub(crate) fn loss(&self, pair: usize) -> R {
        -(self.efforts[pair] * self.speeds[pair][0])
    }
}

impl FrictionWorkspace<f64> {
    /// Makes a pair slide in one sense, +1 or −1, independent of its speed; 0: rest.
    pub(crate) fn hold(&mut self, pair: usize, way: f64) {
        let speed = &mut self.speeds[pair][1];
        *speed = speed.abs().copysign(way);
        // No speed is below a negative bound.
        self.still[pair] = if way == 0.0 { f64::INFINITY } else { -1.0 };
    }
}
