//! Whether a dyad of two links on a crank and the ground misses a position, from the dimensions alone:
//! most designs of a random design space do not go through a turn, and need no other constants.

use super::crank_dyad::{CrankDyad, chord_misses};
use crate::plan::constants::{DimensionMap, EdgeSource, read_two};
use crate::plan::dyad::Dyad;
use crate::plan::lengths::Slot;

/// Where the lengths stand in the list of dimensions.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CrankLengths {
    crank: [Slot; 2],
    /// The crank's pivot, and the dyad's fixed point.
    frame: [[Slot; 2]; 2],
    legs: [[Slot; 2]; 2],
}

impl CrankLengths {
    /// The lengths, if each is that of one vector from joint to joint.
    pub(super) fn of(crank: &CrankDyad, dyad: &Dyad, slots: &DimensionMap) -> Option<Self> {
        if crank.has_guide() {
            return None;
        }
        let vector = |edge: usize| match slots.edges[edge] {
            EdgeSource::Joint(slots) => Some(slots),
            EdgeSource::Guide(_) => None,
        };
        let fixed = |point: usize| {
            slots.ground.iter().find_map(|&(joint, at)| (joint + 1 == point).then_some(at))
        };
        let leg = |unknown| {
            let mut edges = dyad.path.iter().filter(|term| term.turns == Some(unknown));
            let only = edges.next().filter(|_| edges.next().is_none())?;
            vector(only.edge)
        };
        Some(Self {
            crank: vector(crank.crank)?,
            frame: [fixed(crank.pivot)?, fixed(crank.ground)?],
            legs: [leg(0)?, leg(1)?],
        })
    }

    /// See [`CrankDyad::misses_position`]; lengths whose squares leave the range of numbers miss nothing.
    pub(super) fn miss_position(&self, dimensions: &[f64], step: f64) -> bool {
        let read = |slots| read_two(dimensions, slots);
        let frame = (read(self.frame[1]) - read(self.frame[0])).norm();
        let legs = self.legs.map(|leg| read(leg).norm());
        chord_misses(read(self.crank).norm(), frame, legs, step)
    }
}
