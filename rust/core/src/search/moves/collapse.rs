//! A joint taken out: what hung on it hangs on one of its ends.

use super::attach::{attach, mean_distance};
use crate::math::random::Random;
use crate::population::course::Course;
use crate::population::packed::{PackedLinkage, Placement};

/// A linkage without one of its joints, if what is left is one that moves; `course` are its positions before.
pub(crate) fn collapse(
    linkage: &PackedLinkage,
    course: &Course,
    random: &mut Random,
) -> Option<PackedLinkage> {
    let last = linkage.len() - 1;
    let removable: Vec<usize> =
        (2..last).filter(|&joint| !matches!(linkage.placements[joint], Placement::Pivot)).collect();
    if removable.is_empty() {
        return None;
    }
    let removed = removable[random.index(removable.len())];
    let to = linkage.placements[removed].ends()[random.index(2)];
    let mut smaller = linkage.clone();
    for joint in removed + 1..smaller.len() {
        for number in 0..2 {
            if smaller.placements[joint].ends().get(number) != Some(&removed) {
                continue;
            }
            if let Placement::Dyad { .. } = smaller.placements[joint] {
                attach(&mut smaller, joint, number, (to, mean_distance(course, to, joint)));
            } else {
                smaller.placements[joint].renumber(|end| if end == removed { to } else { end });
            }
        }
    }
    (smaller.prune() && smaller.links().is_some()).then_some(smaller)
}
