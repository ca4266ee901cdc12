//! Upper bound of the computation that friction may need at a position.

use super::solutions::MAX_PATHS;
use crate::dynamics::machine::Machine;
use crate::dynamics::pair_friction::Friction;
use crate::plan::mechanism::Mechanism;

impl Machine {
    /// The greatest number of paths to solutions at one position, reached where every pair with friction
    /// depends on every other; each path takes a tenth of a millisecond. 0 without friction.
    #[must_use]
    pub fn friction_paths(&self, mechanism: &Mechanism) -> usize {
        if self.friction.is_empty() {
            return 0;
        }
        let doublings = |friction: &Friction| match *friction {
            // In every link except the one in which the pin is fast.
            Friction::Joint { joint, .. } => {
                mechanism.linkage().links_at(joint).count().saturating_sub(1)
            }
            Friction::Slide { .. } => 2,
        };
        let all: usize = self.friction.iter().map(doublings).sum();
        1 << all.min(MAX_PATHS)
    }
}
