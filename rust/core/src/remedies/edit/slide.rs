//! Lets joints and links slide.

use crate::description::{Description, SlideDescription};
use crate::math::vector::Vector;
use crate::remedies::remedy::{Remedy, RemedyKind};
use crate::remedies::sketch::{GROUND, Sketch};

/// Least cosine in the drawing between a guide and the link that moves the block on it: below, the link
/// presses nearly square to the guide.
const LEAST_COSINE: f64 = 0.5;

/// The two directions of a guide through a joint, the better first: the line to the nearest joint
/// of the link that carries it, and square to this.
fn directions(sketch: &Sketch<'_>, link: &str, joint: &str, host: &str) -> [f64; 2] {
    let unit = |from: &str, to: &str| {
        let line = sketch.between(from, to);
        line.scale(1.0 / line.norm())
    };
    let line = sketch.nearest(host, joint).map_or(Vector::ONE, |neighbour| unit(joint, neighbour));
    let arm = sketch.nearest(link, joint).map(|neighbour| unit(joint, neighbour));
    let square = line.left();
    let turned = arm.is_some_and(|arm| line.dot(arm).abs() < LEAST_COSINE);
    let ordered = if turned { [square, line] } else { [line, square] };
    // A guide has two ends: take the one to the right.
    ordered.map(|d| {
        let flip = d.x < 0.0 || (d.x == 0.0 && d.y < 0.0);
        (if flip { d.scale(-1.0) } else { d }).angle()
    })
}

/// Lets the joint of a link slide on the link to which it is pinned: a new block is pinned there and slides
/// along a guide. Other links at the joint stay where they are: the sliding one then gets its own joint. The
/// two remedies are the guide's directions, the better first.
pub(in crate::remedies) fn let_slide(
    sketch: &Sketch<'_>,
    link: &str,
    joint: &str,
    host: &str,
) -> [Remedy; 2] {
    let is_shared = sketch.links_at(joint).len() > 2;
    let where_ = if host == GROUND { "on the ground".into() } else { format!("along {host}") };
    let end = if host == GROUND { "foot" } else { "end" };
    directions(sketch, link, joint, host).map(|angle| {
        let mut description = sketch.description.clone();
        let new_joint = if is_shared { sketch.unused_joint(joint) } else { joint.into() };
        if is_shared {
            let at = sketch.place(joint);
            description.joints.push((new_joint.clone(), [at.x, at.y]));
        }
        let parted = if is_shared { link } else { host };
        for (_, joints) in description.links.iter_mut().filter(|(name, _)| name == parted) {
            if is_shared {
                joints
                    .iter_mut()
                    .filter(|end| *end == joint)
                    .for_each(|end| new_joint.clone_into(end));
            } else {
                joints.retain(|end| end != joint);
            }
        }
        // A value that was measured from the joint: from there or, where it is gone, the drawing.
        for slide in &mut description.slides {
            if slide.on == parted && slide.origin.as_deref() == Some(joint) {
                slide.origin = is_shared.then(|| new_joint.clone());
            }
        }
        add_block(sketch, &mut description, &new_joint, host, angle);
        let text = if is_shared {
            format!("Let {link} slide {where_} at {joint}")
        } else {
            format!("Let {joint} slide {where_}")
        };
        Remedy {
            kind: RemedyKind::LetSlide,
            names: vec![joint.into(), link.into()],
            text,
            detail: format!("{link} stays, its {end} follows"),
            description,
        }
    })
}

/// Lets the free end of a link slide on the ground.
pub(in crate::remedies) fn guide_end(sketch: &Sketch<'_>, link: &str, joint: &str) -> [Remedy; 2] {
    directions(sketch, link, joint, GROUND).map(|angle| {
        let mut description = sketch.description.clone();
        add_block(sketch, &mut description, joint, GROUND, angle);
        Remedy {
            kind: RemedyKind::LetSlide,
            names: vec![joint.into(), link.into()],
            text: format!("Let {joint} slide on the ground"),
            detail: format!("a block on a guide, pinned to {link}"),
            description,
        }
    })
}

/// Adds a block that is pinned to a joint and slides along a guide of the host.
fn add_block(
    sketch: &Sketch<'_>,
    description: &mut Description,
    joint: &str,
    host: &str,
    angle: f64,
) {
    let block = sketch.unused(&format!("{joint}_block"));
    description.links.push((block.clone(), vec![joint.into()]));
    description.slides.push(SlideDescription {
        name: sketch.unused(&format!("{joint}_slide")),
        link: block,
        on: host.into(),
        angle,
        origin: None,
        length: false,
    });
}

/// Lets a link with a single joint slide on the ground.
pub(in crate::remedies) fn guide_link(sketch: &Sketch<'_>, link: &str, joint: &str) -> Vec<Remedy> {
    let mover = sketch.links_at(joint).iter().copied().find(|&candidate| candidate != link);
    let angles = directions(sketch, mover.unwrap_or(link), joint, GROUND);
    let remedies = angles.map(|angle| {
        let mut description = sketch.description.clone();
        description.slides.push(SlideDescription {
            name: sketch.unused(&format!("{link}_slide")),
            link: link.into(),
            on: GROUND.into(),
            angle,
            origin: None,
            length: false,
        });
        Remedy {
            kind: RemedyKind::LetSlide,
            names: vec![link.into(), joint.into()],
            text: format!("Let {link} slide on the ground"),
            detail: format!("along a guide through {joint}"),
            description,
        }
    });
    remedies.into()
}
