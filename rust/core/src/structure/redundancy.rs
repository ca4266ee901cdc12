//! Redundant links and slides: the linkage moves in the same way without them.

use super::closure::{Closure, LeftOut, rotations};
use super::rank::Rank;
use super::skeleton::Skeleton;
use super::system::{SkeletonPose, System};
use crate::description::error::StructureError;
use crate::description::{Driver, Linkage};

/// Leaves out links (last listed first), then slides, until no equation depends on others.
/// Leaving them out must not change the mobility.
///
/// Returns the parts left out and the number of dependent equations that remain.
///
/// # Errors
///
/// Those of [`rotations`], and [`StructureError::Interrupted`].
pub(crate) fn find_redundant(
    linkage: &Linkage,
    closure: &Closure,
    skeleton: &Skeleton<'_>,
    pose: &SkeletonPose,
    full: &Rank,
    start: LeftOut,
) -> Result<(LeftOut, usize), StructureError> {
    let mut left_out = start;
    let mut excess = full.excess;
    while excess > 0 {
        let mut removable = None;
        for candidate in candidates(linkage, &left_out) {
            let (rotation, _) = rotations(linkage, &candidate, false)?;
            let system = System::new(linkage, closure, &candidate, &rotation, false);
            if !position_is_known(linkage, closure, &candidate) {
                continue;
            }
            let rank = skeleton.rank(&system, pose)?;
            if rank.mobility == full.mobility && rank.excess < excess {
                removable = Some((candidate, rank.excess));
                break;
            }
        }
        match removable {
            Some((candidate, remaining)) => (left_out, excess) = (candidate, remaining),
            None => break,
        }
    }
    Ok((left_out, excess))
}

/// `left_out` with one more link or slide. Drivers, driven links and the ground stay.
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

/// Whether the position of the link left out last still follows from the kept links: from two of
/// its joints, or a joint and a guide.
fn position_is_known(linkage: &Linkage, closure: &Closure, left_out: &LeftOut) -> bool {
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
