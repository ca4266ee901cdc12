//! Random linkages that turn fully, within about a unit square.

use std::f64::consts::TAU;

use super::course::{Angles, Course, sweep};
use super::packed::{PackedLinkage, Placement};
use crate::batch::dispatch::Entry;
use crate::math::lanes::LANES;
use crate::math::random::Random;

/// Positions at which a dyad must close.
const POSITIONS: usize = 12 * LANES;
/// Dyads that are tried in one place.
const TRIES: usize = 12;
/// Shares of ground pivots and of further joints of links among new joints.
const PIVOTS: f64 = 0.14;
const RIGID: f64 = 0.16;

/// What random linkages are like.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RandomLinkages {
    /// The least and greatest number of joints.
    pub joints: [usize; 2],
    /// The greatest absolute cosine of the apex angle of dyads.
    pub most_cosine: f64,
}

impl RandomLinkages {
    /// A random linkage, with its positions; joints are added until no dyad closes or there are enough.
    pub(crate) fn make<L: Entry>(&self, random: &mut Random, course: &mut Course) -> PackedLinkage {
        let mut angles = Angles::default();
        angles.set::<L>(TAU, true, (POSITIONS, 0));
        let place = |random: &mut Random| [random.unit(), random.unit()];
        let radius = random.log_between(0.03, 0.3);
        let phase = random.direction();
        let mut linkage = PackedLinkage {
            placements: vec![Placement::Pivot, Placement::Crank, Placement::Pivot],
            numbers: vec![place(random), phase.map(|x| radius * x), place(random)],
            sense: 1.0,
        };
        sweep::<L>(&linkage, &angles, (0, self.most_cosine), course);
        let [least, most] = self.joints;
        let count = least + random.index(most - least + 1);
        while linkage.len() < count {
            let is_added = if random.happens(PIVOTS) {
                linkage.push(Placement::Pivot, place(random));
                true
            } else if random.happens(RIGID / (1.0 - PIVOTS)) {
                add_rigid(&mut linkage, random)
            } else {
                self.add_dyad::<L>(&mut linkage, random, &angles, course)
            };
            if !is_added {
                break;
            }
            let last = linkage.len() - 1;
            sweep::<L>(&linkage, &angles, (last, self.most_cosine), course);
        }
        linkage
    }

    /// Adds a dyad that closes all the way round, if one is found.
    fn add_dyad<L: Entry>(
        &self,
        linkage: &mut PackedLinkage,
        random: &mut Random,
        angles: &Angles,
        course: &mut Course,
    ) -> bool {
        for _ in 0..TRIES {
            let last = linkage.len() - 1;
            let first = if random.happens(0.5) { last } else { random.index(last + 1) };
            let ends = [first, random.index(last + 1)];
            let is_pivot = |end: usize| matches!(linkage.placements[end], Placement::Pivot);
            if ends[0] == ends[1] || ends.iter().all(|&end| is_pivot(end)) {
                continue;
            }
            let (placement, lengths) = random_dyad(random, ends, course, angles.len());
            let mut longer = linkage.clone();
            let joint = longer.push(placement, lengths);
            let closes = longer.links().is_some()
                && sweep::<L>(&longer, angles, (joint, self.most_cosine), course);
            if closes {
                *linkage = longer;
                return true;
            }
        }
        false
    }
}

/// Adds a joint to a random link other than the ground.
fn add_rigid(linkage: &mut PackedLinkage, random: &mut Random) -> bool {
    let Some(links) = linkage.links() else { return false };
    let link = &links[1 + random.index(links.len() - 1)];
    let first = random.index(link.len());
    let second = (first + 1 + random.index(link.len() - 1)) % link.len();
    let ratio = random.log_between(0.2, 1.5);
    let ends = [link[first], link[second]];
    linkage.push(Placement::Rigid { ends }, random.direction().map(|x| ratio * x));
    true
}

/// A dyad on two joints whose positions are known, with lengths for which it should close.
pub(crate) fn random_dyad(
    random: &mut Random,
    ends: [usize; 2],
    course: &Course,
    positions: usize,
) -> (Placement, [f64; 2]) {
    let squares =
        (0..positions).map(|t| (course.point(ends[1], t) - course.point(ends[0], t)).norm2());
    let range = |[low, high]: [f64; 2], square: f64| [low.min(square), high.max(square)];
    let [least, most] = squares.fold([f64::INFINITY, 0.0], range).map(f64::sqrt);
    let a = most * random.log_between(0.25, 1.6);
    let b = random.between((a - least).max(most - a), a + least);
    let side = if random.happens(0.5) { 1.0 } else { -1.0 };
    (Placement::Dyad { ends, side }, [a, b])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::population::packed::GROUND;
    use crate::state::kernel::baseline::Baseline;

    #[test]
    fn random_linkages_are_linkages_of_all_sizes() {
        let wanted = RandomLinkages { joints: [5, 13], most_cosine: 0.97 };
        let mut course = Course::default();
        let mut counts = [0; 14];
        for index in 0..300 {
            let linkage = wanted.make::<Baseline>(&mut Random::new(7, index), &mut course);
            let links = linkage.links().expect("a linkage");
            assert!(links[GROUND].len() >= 2);
            counts[linkage.len()] += 1;
        }
        assert!(counts[5..].iter().all(|&count| count > 5), "{counts:?}");
    }
}
