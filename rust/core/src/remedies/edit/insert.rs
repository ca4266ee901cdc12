//! Inserts links.

use crate::math::vector::Vector;
use crate::remedies::remedy::{Remedy, RemedyKind};
use crate::remedies::sketch::{GROUND, Sketch};

/// Distance of the new joint of a parted link from its line, relative to the link's length: links in line
/// would be at a dead point.
const BESIDE: f64 = 0.25;
/// Length of a new rocker in parts of the link that it holds; they are drawn at a right angle.
const ROCKER: f64 = 0.8;

/// Parts a link from one of its joints and puts a link between them, drawn to either side.
pub(in crate::remedies) fn part(sketch: &Sketch<'_>, link: &str, joint: &str) -> Vec<Remedy> {
    let Some(neighbour) = sketch.nearest(link, joint) else { return Vec::new() };
    let (from, along) = (sketch.place(joint), sketch.between(joint, neighbour));
    let sides = [BESIDE, -BESIDE].map(|side| {
        let mut description = sketch.description.clone();
        let knee = sketch.unused_joint(joint);
        let at = from + along.scale(0.5) + along.left().scale(side);
        description.joints.push((knee.clone(), [at.x, at.y]));
        for (name, joints) in &mut description.links {
            for end in joints.iter_mut().filter(|end| name == link && *end == joint) {
                end.clone_from(&knee);
            }
        }
        for slide in &mut description.slides {
            if slide.on == link && slide.origin.as_deref() == Some(joint) {
                slide.origin = Some(knee.clone());
            }
        }
        description.links.push((sketch.unused(link), vec![joint.into(), knee]));
        Remedy {
            kind: RemedyKind::Part,
            names: vec![joint.into(), link.into()],
            text: format!("Add a link between {joint} and {link}"),
            detail: "two links in place of one".into(),
            description,
        }
    });
    sides.into()
}

/// A new link between two joints.
pub(in crate::remedies) fn join(sketch: &Sketch<'_>, joint: &str, far_joint: &str) -> Remedy {
    let mut description = sketch.description.clone();
    description.links.push((sketch.unused("link"), vec![joint.into(), far_joint.into()]));
    let detail = if sketch.links_at(far_joint).contains(&GROUND) {
        format!("it turns about {far_joint} on the ground")
    } else {
        format!("{joint} and {far_joint} keep their distance")
    };
    Remedy {
        kind: RemedyKind::Join,
        names: vec![joint.into(), far_joint.into()],
        text: format!("Add a link between {joint} and {far_joint}"),
        detail,
        description,
    }
}

/// A new link between a joint and a new joint of the ground, square to the link that it holds:
/// first to the side of the ground's other joints.
pub(in crate::remedies) fn join_ground(
    sketch: &Sketch<'_>,
    link: &str,
    joint: &str,
) -> Vec<Remedy> {
    let Some(neighbour) = sketch.nearest(link, joint) else { return Vec::new() };
    let across = sketch.between(joint, neighbour).left().scale(ROCKER);
    let toward = sketch.nearest(GROUND, joint).map_or(Vector::ONE, |g| sketch.between(joint, g));
    let first = if across.dot(toward) < 0.0 { across.scale(-1.0) } else { across };
    let sides = [first, first.scale(-1.0)].map(|arm| {
        let mut description = sketch.description.clone();
        let foot = sketch.unused_joint(joint);
        let at = sketch.place(joint) + arm;
        description.joints.push((foot.clone(), [at.x, at.y]));
        for (_, joints) in description.links.iter_mut().filter(|(name, _)| name == GROUND) {
            joints.push(foot.clone());
        }
        description.links.push((sketch.unused("link"), vec![joint.into(), foot.clone()]));
        Remedy {
            kind: RemedyKind::Join,
            names: vec![joint.into(), GROUND.into()],
            text: format!("Add a link between {joint} and the ground"),
            detail: format!("it turns about a new fixed joint {foot}"),
            description,
        }
    });
    sides.into()
}
