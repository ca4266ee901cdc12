//! Another joint traced: the apex of a new dyad.

use crate::math::random::Random;
use crate::population::course::Course;
use crate::population::packed::PackedLinkage;
use crate::population::random::random_dyad;

/// How often an end of the new dyad is the joint that was traced.
const AT_TRACED: f64 = 0.5;

/// A linkage with a random dyad at its end; `course` are its positions before.
pub(crate) fn new_traced(
    linkage: &PackedLinkage,
    course: &Course,
    random: &mut Random,
) -> Option<PackedLinkage> {
    let last = linkage.len() - 1;
    let first = if random.happens(AT_TRACED) { last } else { random.index(last + 1) };
    let ends = [first, random.index(last + 1)];
    let (placement, lengths) = random_dyad(random, ends, course, course.positions());
    let mut longer = linkage.clone();
    longer.push(placement, lengths);
    (longer.links().is_some() && longer.prune()).then_some(longer)
}
