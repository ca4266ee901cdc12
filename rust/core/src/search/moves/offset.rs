//! Growth: an end of a link, or the traced joint, moves off its place by a joint that is rigid there.
//!
//! The new joint F = P + c d is on a link at P, d the vector from P to another joint of this link, or on a new
//! link that a dyad leads. At c = 0 nothing would change: so a design that works keeps working, and has new numbers.

use super::attach::{attach, mean_distance};
use crate::math::random::Random;
use crate::population::course::Course;
use crate::population::packed::{GROUND, PackedLinkage, Placement};
use crate::population::random::random_dyad;

/// Least and greatest distance of the new joint from the old one, in radii of the target.
const OFFSETS: [f64; 2] = [0.002, 0.2];
/// How often the offset is on a new link.
const NEW_LINKS: f64 = 0.5;

/// A linkage with an offset at a random place; `course` are its positions before. It may be no linkage, or not
/// close.
pub(crate) fn offset(
    linkage: &PackedLinkage,
    course: &Course,
    random: &mut Random,
    most_joints: usize,
) -> Option<PackedLinkage> {
    let mut grown = linkage.clone();
    let last = grown.len() - 1;
    // A bar's end, or the traced joint.
    let mut places = vec![(last, None)];
    for (joint, placement) in grown.placements.iter().enumerate() {
        if let Placement::Dyad { ends, .. } = placement {
            places.extend([(ends[0], Some((joint, 0))), (ends[1], Some((joint, 1)))]);
        }
    }
    let (place, bar) = places[random.index(places.len())];
    // New joints come before the one that hangs on them.
    let before = bar.map_or(last + 1, |(joint, _)| joint);
    let is_new = grown.len() + 2 <= most_joints && random.happens(NEW_LINKS);
    let partner = if is_new {
        let other = random.index(before);
        let (placement, lengths) = random_dyad(random, [place, other], course, course.positions());
        grown.insert(before, placement, lengths);
        before
    } else {
        partner(&grown, place, before, random)?
    };
    let reach =
        if is_new { grown.numbers[partner][0] } else { mean_distance(course, place, partner) };
    let off = random.log_between(OFFSETS[0], OFFSETS[1]) / reach;
    let ratio = random.direction().map(|x| x * off);
    let new = before + usize::from(is_new);
    grown.insert(new, Placement::Rigid { ends: [place, partner] }, ratio);
    if let Some((joint, number)) = bar {
        let length = grown.numbers[new + 1][number];
        debug_assert!(joint <= new, "new joints come before");
        attach(&mut grown, new + 1, number, (new, length));
    }
    Some(grown)
}

/// A random joint that shares a moving link with `place`, among those before `before`.
fn partner(
    linkage: &PackedLinkage,
    place: usize,
    before: usize,
    random: &mut Random,
) -> Option<usize> {
    let links = linkage.links()?;
    let mut partners: Vec<usize> = vec![];
    for link in links.iter().skip(GROUND + 1).filter(|link| link.contains(&place)) {
        partners.extend(link.iter().filter(|&&joint| joint != place && joint < before));
    }
    (!partners.is_empty()).then(|| partners[random.index(partners.len())])
}
