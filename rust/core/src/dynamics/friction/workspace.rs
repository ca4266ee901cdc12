//! Work space of friction: how fast pairs slide, how their reactions depend on friction, and the friction
//! found.

use crate::math::lanes::Real;
use crate::math::vector::Vector;

/// How fast pairs with friction slide, how their reactions depend on it, and the friction found.
#[derive(Debug, Clone, Default)]
pub(crate) struct FrictionWorkspace<R: Real> {
    /// Whether the static law holds; if not said, where all drivers rest.
    pub is_static: Option<bool>,
    /// Speed of every pair, as it is, and as it is or is about to be.
    pub speeds: Vec<[R; 2]>,
    /// Below these a pair rests.
    pub still: Vec<R>,
    /// How fast every point moves as it is or is about to be: at most, of all drivers.
    pub point_speeds: Vec<R>,
    /// By how much the velocities along every edge may miss their closed path.
    pub edge_errors: Vec<R>,
    /// Reactions without friction, and per unit of friction in every pair.
    pub base: Vec<Vector<R>>,
    pub slopes: Vec<Vec<Vector<R>>>,
    /// Moments or forces of friction, with the viscous part.
    pub efforts: Vec<R>,
    /// Number of solutions.
    pub solutions: R,
    pub safety: R,
    /// By how much the law of friction is missed, in parts of the greatest friction.
    pub residual: R,
}

impl<R: Real> FrictionWorkspace<R> {
    /// The power that friction takes in a pair.
    #[inline(always)]
    pub(crate) fn loss(&self, pair: usize) -> R {
        -(self.efforts[pair] * self.speeds[pair][0])
    }
}

impl FrictionWorkspace<f64> {
    /// Lets a pair slide one way, +1 or −1, whatever its speed; or, with 0, rest.
    pub(crate) fn hold(&mut self, pair: usize, way: f64) {
        let speed = &mut self.speeds[pair][1];
        *speed = speed.abs().copysign(way);
        // No speed is below a negative one.
        self.still[pair] = if way == 0.0 { f64::INFINITY } else { -1.0 };
    }
}
