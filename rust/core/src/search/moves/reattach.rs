//! A bar of a dyad moved to another joint.

use super::attach::{attach, mean_distance};
use crate::math::random::Random;
use crate::population::course::Course;
use crate::population::packed::{PackedLinkage, Placement};

/// A linkage with an end of a bar elsewhere, if it is one that moves; `course` are its positions before.
pub(crate) fn reattach(
    linkage: &PackedLinkage,
    course: &Course,
    random: &mut Random,
) -> Option<PackedLinkage> {
    let is_dyad = |joint: &usize| matches!(linkage.placements[*joint], Placement::Dyad { .. });
    let dyads: Vec<usize> = (2..linkage.len()).filter(is_dyad).collect();
    if dyads.is_empty() {
        return None;
    }
    let joint = dyads[random.index(dyads.len())];
    let number = random.index(2);
    let to = random.index(joint);
    if to == linkage.placements[joint].ends()[number] {
        return None;
    }
    let mut changed = linkage.clone();
    attach(&mut changed, joint, number, (to, mean_distance(course, to, joint)));
    (changed.prune() && changed.links().is_some()).then_some(changed)
}
