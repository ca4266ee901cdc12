//! Remedies for an unfinished drawing: joints without a link, links without a connection, guides that do not
//! pass through a point.

use super::edit::hold::hold;
use super::edit::place::{fix_joint, guide_through, leave_out_joints};
use super::edit::take_out::take_out;
use super::search::Search;
use super::sketch::Sketch;
use crate::description::error::{Interrupted, StructureError};

/// Most joints that are held on the ground to connect links.
const HELD: usize = 3;

/// Finds remedies for parts that are not joined yet.
pub(super) fn finish(
    search: &mut Search<'_>,
    sketch: &Sketch<'_>,
    error: &StructureError,
) -> Result<(), Interrupted> {
    match error {
        StructureError::LooseJoint { joint } => place_joint(search, sketch, joint),
        StructureError::Unconnected { links } => connect(search, sketch, links),
        StructureError::GuideNowhere { slide, on, .. } => {
            for joint in sketch.joints_of(on) {
                search.attempt(guide_through(sketch, slide, joint))?;
            }
            Ok(())
        }
        StructureError::Unplaced { link } => {
            search.attempt_first(take_out(sketch, std::slice::from_ref(link)))?;
            Ok(())
        }
        _ => Ok(()),
    }
}

/// Fixes a joint without a link to the nearest link, or leaves out all such joints.
fn place_joint(
    search: &mut Search<'_>,
    sketch: &Sketch<'_>,
    joint: &str,
) -> Result<(), Interrupted> {
    let all = sketch.description.joints.iter().map(|(name, _)| name);
    let loose: Vec<String> = all.filter(|name| sketch.links_at(name).is_empty()).cloned().collect();
    if loose.len() == 1 {
        let mut links: Vec<(f64, &str)> = (sketch.moving_links())
            .filter_map(|link| {
                let nearest = sketch.nearest(link, joint)?;
                Some((sketch.between(joint, nearest).norm2(), link))
            })
            .collect();
        links.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, link) in links.into_iter().take(2) {
            search.attempt(fix_joint(sketch, joint, link))?;
        }
    }
    search.attempt(leave_out_joints(sketch, &loose))?;
    Ok(())
}

/// Holds on the ground the ends of links that are not connected to it, or takes these links out.
fn connect(
    search: &mut Search<'_>,
    sketch: &Sketch<'_>,
    links: &[String],
) -> Result<(), Interrupted> {
    let single = |joint: &&String| sketch.links_at(joint).len() == 1;
    let ends: Vec<String> =
        links.iter().flat_map(|link| sketch.joints_of(link)).filter(single).cloned().collect();
    if ends.len() <= HELD {
        search.attempt_first(hold(sketch, &ends))?;
    }
    for (i, first) in ends.iter().enumerate().take(HELD) {
        for second in ends.iter().skip(i + 1).take(HELD) {
            search.attempt_first(hold(sketch, &[first.clone(), second.clone()]))?;
        }
    }
    for end in ends.iter().take(HELD) {
        search.attempt_first(hold(sketch, std::slice::from_ref(end)))?;
    }
    search.attempt_first(take_out(sketch, links))?;
    Ok(())
}
