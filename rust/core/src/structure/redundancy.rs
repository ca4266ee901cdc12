//! Redundant links and slides: those without which the linkage moves just the same.

use super::closure::{Closure, LeftOut, rotations};
use super::freedom::{Pose, Skeleton, System};
use super::rank::Rank;
use crate::description::error::StructureError;
use crate::description::{Driver, Linkage};

/// Leaves out links (the last listed first), then slides, until no equation is
/// dependent any more. Leaving one out must free nothing.
///
/// Returns what was left out and how many dependent equations remain.
///
/// # Errors
///
/// None of its own; those of [`rotations`].
pub(crate) fn leave_out(
    linkage: &Linkage,
    closure: &Closure,
    skeleton: &Skeleton<'_>,
    pose: &Pose,
    full: &Rank,
    start: LeftOut,
) -> Result<(LeftOut, usize), StructureError> {
    let mut left_out = start;
    let mut excess = full.excess;
    while excess > 0 {
        let mut found = None;
        for candidate in candidates(linkage, &left_out) {
            let (rotation, _) = rotations(linkage, &candidate, false)?;
            let system = System::new(linkage, closure, &candidate, &rotation, false);
            if !still_placed(linkage, closure, &candidate) {
                continue;
            }
            let rank = skeleton.rank(&system, pose)?;
            if rank.mobility == full.mobility && rank.excess < excess {
                found = Some((candidate, rank.excess));
                break;
            }
        }
        match found {
            Some((candidate, rest)) => (left_out, excess) = (candidate, rest),
            None => break,
        }
    }
    Ok((left_out, excess))
}

/// One more link or slide left out; drivers and the ground stay.
fn candidates<'a>(
    linkage: &'a Linkage,
    left_out: &'a LeftOut,
) -> impl Iterator<Item = LeftOut> + 'a {
    let needed = |link: usize| {
        link == linkage.ground
            || linkage.drivers.iter().any(|d| match *d {
                Driver::Angle { link: a, relative_to: b } => a == link || b == link,
                Driver::Slide(s) => linkage.slides[s].link == link || linkage.slides[s].on == link,
            })
    };
    let links = (0..linkage.links.len())
        .rev()
        .filter(move |&l| !needed(l) && !left_out.links.contains(&l))
        .map(|l| {
            let mut next = left_out.clone();
            next.links.push(l);
            next
        });
    let slides = (0..linkage.slides.len())
        .rev()
        .filter(|&s| {
            !left_out.has_slide(linkage, s) && !linkage.drivers.contains(&Driver::Slide(s))
        })
        .map(|s| {
            let mut next = left_out.clone();
            next.slides.push(s);
            next
        });
    links.chain(slides)
}

/// A link left out is placed again afterwards by two of its joints (or a joint
/// and a guide) that other, kept links carry.
fn still_placed(linkage: &Linkage, closure: &Closure, left_out: &LeftOut) -> bool {
    let Some(&link) = left_out.links.last() else { return true };
    let kept = |l: usize| l != link && !left_out.links.contains(&l);
    let joints = linkage.links[link]
        .joints
        .iter()
        .filter(|&&j| closure.fixed[j + 1] || linkage.links_at(j).any(kept))
        .count();
    let slides = linkage
        .slides
        .iter()
        .filter(|s| (s.link == link && kept(s.on)) || (s.on == link && kept(s.link)))
        .count();
    joints >= 2 || (joints >= 1 && slides >= 1)
}
