//! Takes out links and slides, with the joints that are then unused.

use crate::description::Description;
use crate::remedies::remedy::{Remedy, RemedyKind};
use crate::remedies::sketch::{GROUND, Sketch};
use crate::remedies::words::{listed, remaining};

/// Takes out links and slides that are not driven.
pub(in crate::remedies) fn take_out(sketch: &Sketch<'_>, names: &[String]) -> Option<Remedy> {
    let old = sketch.description;
    let out = |name: &String| names.contains(name);
    let driven = |name: &String| sketch.is_driven(name);
    if names.is_empty() || names.iter().any(|name| name == GROUND || driven(name)) {
        return None;
    }
    let mut description = old.clone();
    description.links.retain(|(name, _)| !out(name));
    description.slides.retain(|s| !out(&s.name) && !out(&s.link) && !out(&s.on));
    let is_kept = |name: &String| description.slides.iter().any(|slide| slide.name == *name);
    if old.slides.iter().any(|slide| !is_kept(&slide.name) && driven(&slide.name)) {
        return None;
    }
    forget_joints(sketch, &mut description, names);
    let slide = old.slides.iter().find(|slide| names == [slide.name.clone()]);
    let detail = match slide {
        Some(slide) if slide.on == GROUND => {
            format!("{} no longer slides on the ground", slide.link)
        }
        Some(slide) => format!("{} no longer slides on {}", slide.link, slide.on),
        None => remaining(&moving(&description)),
    };
    Some(Remedy {
        kind: RemedyKind::TakeOut,
        names: names.to_vec(),
        text: format!("Take out {}", listed(names)),
        detail,
        description,
    })
}

/// Leaves out joints of the removed links that no moving link has, unless a guide begins there.
fn forget_joints(sketch: &Sketch<'_>, description: &mut Description, links: &[String]) {
    let origins: Vec<String> =
        description.slides.iter().filter_map(|slide| slide.origin.clone()).collect();
    let has = |joint: &String| {
        let mut moving = description.links.iter().filter(|(name, _)| name != GROUND);
        moving.any(|(_, on)| on.contains(joint)) || origins.contains(joint)
    };
    let concerned = links.iter().flat_map(|link| sketch.joints_of(link));
    let forgotten: Vec<&String> = concerned.filter(|joint| !has(joint)).collect();
    description.joints.retain(|(name, _)| !forgotten.contains(&name));
    for (_, on) in &mut description.links {
        on.retain(|joint| !forgotten.contains(&joint));
    }
    let gone = |name: &String| {
        forgotten.contains(&name)
            || (sketch.is_slide(name) && description.slides.iter().all(|s| s.name != *name))
    };
    description.assembly.retain(|(name, _)| !gone(name));
}

fn moving(description: &Description) -> Vec<String> {
    let names = description.links.iter().map(|(name, _)| name);
    names.filter(|&name| name != GROUND).cloned().collect()
}
