//! Random changes of a linkage's numbers.

use crate::math::random::Random;
use crate::population::packed::{PackedLinkage, Placement};

/// Least and greatest standard deviation, in radii of the target or as a part of a length.
const SPREAD: [f64; 2] = [0.003, 0.15];
/// Share of the numbers that change where not all do.
const SOME: f64 = 0.3;

/// Changes all numbers of a linkage, or some of them.
pub(crate) fn perturb(linkage: &mut PackedLinkage, random: &mut Random) {
    let spread = random.log_between(SPREAD[0], SPREAD[1]);
    let share = if random.happens(0.5) { 1.0 } else { SOME };
    for (placement, numbers) in linkage.placements.iter().zip(&mut linkage.numbers) {
        let size = match placement {
            Placement::Pivot => [1.0; 2],
            Placement::Dyad { .. } => *numbers,
            Placement::Crank | Placement::Rigid { .. } => {
                [(numbers[0] * numbers[0] + numbers[1] * numbers[1]).sqrt(); 2]
            }
        };
        for (number, size) in numbers.iter_mut().zip(size) {
            if random.happens(share) {
                *number += spread * size * random.normal();
            }
        }
    }
}
