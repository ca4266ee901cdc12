//! How much work friction may make at a position.

use super::solutions::MAX_PATHS;
use crate::dynamics::machine::Machine;
use crate::dynamics::pair_friction::Friction;
use crate::plan::mechanism::Mechanism;

impl Machine {
    /// The greatest number of paths to solutions that are followed at one position, where every pair
    /// with friction depends on every other: of a tenth of a millisecond each. 0 without friction.
    #[must_use]
    pub fn friction_paths(&self, mechanism: &Mechanism) -> usize {
        if self.friction.is_empty() {
            return 0;
        }
        let doublings = |friction: &Friction| match *friction {
            // In every link but the one in which the pin is fast.
            Friction::Joint { joint, .. } => {
                mechanism.linkage().links_at(joint).count().saturating_sub(1)
            }
            Friction::Slide { .. } => 2,
        };
        let all: usize = self.friction.iter().map(doublings).sum();
        1 << all.min(MAX_PATHS)
    }
}
