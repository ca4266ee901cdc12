//! Holds joints on the ground, and unites two links.

use crate::remedies::remedy::{Remedy, RemedyKind};
use crate::remedies::sketch::{GROUND, Sketch};
use crate::remedies::words::listed;

/// Holds joints on the ground.
pub(in crate::remedies) fn hold(sketch: &Sketch<'_>, joints: &[String]) -> Option<Remedy> {
    if joints.is_empty() || joints.iter().any(|joint| sketch.links_at(joint).contains(&GROUND)) {
        return None;
    }
    // With two joints held a link would be a part of the ground.
    let is_held =
        |joint: &&String| joints.contains(joint) || sketch.links_at(joint).contains(&GROUND);
    let twice = |link: &&str| sketch.joints_of(link).iter().filter(is_held).nth(1).is_some();
    if joints.iter().flat_map(|joint| sketch.links_at(joint)).any(twice) {
        return None;
    }
    let mut description = sketch.description.clone();
    for (_, ground_joints) in description.links.iter_mut().filter(|(name, _)| name == GROUND) {
        ground_joints.extend(joints.iter().cloned());
    }
    let mut links: Vec<String> = Vec::new();
    for &link in joints.iter().flat_map(|joint| sketch.links_at(joint)) {
        if !links.iter().any(|listed| listed == link) {
            links.push(link.into());
        }
    }
    let verb = if links.len() == 1 { "turns" } else { "turn" };
    let about = if joints.len() == 1 { "it" } else { "them" };
    Some(Remedy {
        kind: RemedyKind::Hold,
        names: joints.to_vec(),
        text: format!("Hold {} on the ground", listed(joints)),
        detail: format!("{} {verb} about {about}", listed(&links)),
        description,
    })
}

/// Unites two links that meet at a joint.
pub(in crate::remedies) fn unite(
    sketch: &Sketch<'_>,
    link: &str,
    absorbed: &str,
    joint: &str,
) -> Option<Remedy> {
    if [link, absorbed].iter().any(|&name| name == GROUND || sketch.is_driven(name)) {
        return None;
    }
    let mut description = sketch.description.clone();
    description.links.retain(|(name, _)| name != absorbed);
    for (_, joints) in description.links.iter_mut().filter(|(name, _)| name == link) {
        let more = sketch.joints_of(absorbed).iter().filter(|name| *name != joint);
        joints.extend(more.cloned());
    }
    for slide in &mut description.slides {
        for end in [&mut slide.link, &mut slide.on] {
            if end == absorbed {
                *end = link.into();
            }
        }
    }
    Some(Remedy {
        kind: RemedyKind::Unite,
        names: vec![link.into(), absorbed.into()],
        text: format!("Make {link} and {absorbed} one link"),
        detail: format!("they no longer turn at {joint}"),
        description,
    })
}
