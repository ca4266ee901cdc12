//! Places joints that are not on a link, and guides that do not pass through a point.

use crate::remedies::remedy::{Remedy, RemedyKind};
use crate::remedies::sketch::Sketch;
use crate::remedies::words::listed;

/// Leaves out joints that are not on a link.
pub(in crate::remedies) fn leave_out_joints(sketch: &Sketch<'_>, joints: &[String]) -> Remedy {
    let mut description = sketch.description.clone();
    description.joints.retain(|(name, _)| !joints.contains(name));
    let (verb, pronoun) = if joints.len() == 1 { ("is", "it") } else { ("are", "they") };
    Remedy {
        kind: RemedyKind::TakeOut,
        names: joints.to_vec(),
        text: format!("Take out {}", listed(joints)),
        detail: format!("{pronoun} {verb} on no link"),
        description,
    }
}

/// Fixes a joint to a link: a point of it.
pub(in crate::remedies) fn fix_joint(sketch: &Sketch<'_>, joint: &str, link: &str) -> Remedy {
    let mut description = sketch.description.clone();
    for (_, joints) in description.links.iter_mut().filter(|(name, _)| name == link) {
        joints.push(joint.into());
    }
    Remedy {
        kind: RemedyKind::Place,
        names: vec![joint.into(), link.into()],
        text: format!("Fix {joint} to {link}"),
        detail: "it moves with the link, as a point of it".into(),
        description,
    }
}

/// Lets a guide pass through a joint of the link that carries it.
pub(in crate::remedies) fn guide_through(sketch: &Sketch<'_>, slide: &str, joint: &str) -> Remedy {
    let mut description = sketch.description.clone();
    for guide in description.slides.iter_mut().filter(|guide| guide.name == slide) {
        guide.origin = Some(joint.into());
    }
    Remedy {
        kind: RemedyKind::Place,
        names: vec![slide.into(), joint.into()],
        text: format!("Let the guide of {slide} pass through {joint}"),
        detail: format!("its value is measured from {joint}"),
        description,
    }
}
