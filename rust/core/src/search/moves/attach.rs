//! An end of a dyad's bar moved to another joint: its length becomes the mean distance, and the joints that were
//! rigid on the bar hang on the new one.

use crate::population::course::Course;
use crate::population::packed::{PackedLinkage, Placement};

/// The mean distance of two joints over the positions of a course.
pub(super) fn mean_distance(course: &Course, first: usize, second: usize) -> f64 {
    let count = course.positions();
    let distance = |t: usize| (course.point(first, t) - course.point(second, t)).norm();
    (0..count).map(distance).sum::<f64>() / count as f64
}

/// Moves the bar from dyad joint `joint` to its end `number` over to joint `to`, which comes before it. It is as long
/// as given.
pub(super) fn attach(
    linkage: &mut PackedLinkage,
    joint: usize,
    number: usize,
    (to, length): (usize, f64),
) {
    let Placement::Dyad { ends, .. } = &mut linkage.placements[joint] else { return };
    let from = std::mem::replace(&mut ends[number], to);
    linkage.numbers[joint][number] = length;
    for placement in &mut linkage.placements {
        if let Placement::Rigid { ends } = placement
            && ends.contains(&from)
            && ends.contains(&joint)
        {
            *ends = ends.map(|end| if end == from { to } else { end });
        }
    }
}
