//! Remedies for links that hold each other: one of them slides, is taken out, or becomes two.

use super::edit::insert::part;
use super::edit::slide::let_slide;
use super::edit::take_out::take_out;
use super::remedy::Remedy;
use super::search::Search;
use super::sketch::{GROUND, Sketch};
use crate::description::Linkage;
use crate::description::error::{Interrupted, StructureError};
use crate::structure::holding_drivers;

/// Finds remedies for links that cannot move. Where links are redundant, the last drawn is the first suspect:
/// a link without which the rest moves.
pub(super) fn free(
    search: &mut Search<'_>,
    sketch: &Sketch<'_>,
    error: &StructureError,
) -> Result<(), Interrupted> {
    let mut suspects = suspects(error);
    if matches!(error, StructureError::Immovable { .. }) {
        keep_holding(&mut suspects, sketch, search)?;
    }
    let links: Vec<&str> = (sketch.moving_links().rev())
        .filter(|link| suspects.iter().any(|name| name == link))
        .collect();
    let slides = suspects.iter().rev().filter(|name| sketch.is_slide(name));
    let mut kept = Vec::new();
    for &link in &links {
        if search.is_over() {
            return Ok(());
        }
        let Some(out) = take_out(sketch, &[link.into()]) else {
            kept.push(link);
            continue;
        };
        let at = search.remedies.len();
        if !search.attempt(out)?.is_accepted() {
            kept.push(link);
            continue;
        }
        // A link that slides is kept: this comes first.
        if search.attempt_first(slidings(sketch, link))? {
            search.remedies.swap(at, at + 1);
        }
        search.attempt_first(partings(sketch, link))?;
    }
    for slide in slides {
        search.attempt_first(take_out(sketch, std::slice::from_ref(slide)))?;
    }
    for link in kept {
        if search.is_over() {
            return Ok(());
        }
        search.attempt_first(slidings(sketch, link))?;
        search.attempt_first(partings(sketch, link))?;
    }
    if search.remedies.is_empty() {
        let last = |error: &StructureError, taken: &[String]| {
            let suspects = self::suspects(error);
            let free = |name: &&str| !sketch.is_driven(name) && !taken.iter().any(|t| t == name);
            let named = |name: &&str| suspects.iter().any(|suspect| suspect == name);
            sketch.moving_links().rev().filter(named).find(free).map(String::from)
        };
        search.combine(sketch, error, take_out, last)?;
    }
    Ok(())
}

/// The links and slides one of which is redundant.
fn suspects(error: &StructureError) -> Vec<String> {
    match error {
        StructureError::Immovable { overconstraint: Some(over), .. } => over.links.clone(),
        StructureError::Immovable { links, .. }
        | StructureError::OverConstrained { links, .. }
        | StructureError::AlmostFits { links, .. } => links.clone(),
        StructureError::SlidesOnly { slides } => slides.clone(),
        _ => Vec::new(),
    }
}

/// Keeps those that hold the drivers, if they are known: without another one nothing would be driven.
fn keep_holding(
    suspects: &mut Vec<String>,
    sketch: &Sketch<'_>,
    search: &Search<'_>,
) -> Result<(), Interrupted> {
    let Ok(linkage) = Linkage::new(sketch.description) else { return Ok(()) };
    let holding = match holding_drivers(&linkage, search.cancel) {
        Ok(holding) => holding,
        Err(StructureError::Interrupted) => return Err(Interrupted),
        Err(_) => return Ok(()),
    };
    if suspects.iter().any(|name| holding.contains(name)) {
        suspects.retain(|name| holding.contains(name));
    }
    Ok(())
}

/// Lets a link's joints slide: those on the ground first, then those on other links.
fn slidings(sketch: &Sketch<'_>, link: &str) -> impl Iterator<Item = Remedy> {
    let pairs = |on_ground: bool| {
        let joints = sketch.joints_of(link).iter();
        joints.rev().filter_map(move |joint| {
            let other_links = || sketch.links_at(joint).iter().filter(|&&carrier| carrier != link);
            let host = other_links().find(|&&carrier| (carrier == GROUND) == on_ground)?;
            let is_ground_joint = sketch.links_at(joint).contains(&GROUND);
            (is_ground_joint == on_ground).then(|| let_slide(sketch, link, joint, host))
        })
    };
    pairs(true).chain(pairs(false)).flatten().collect::<Vec<_>>().into_iter()
}

/// Parts a link from a joint: from those on moving links first.
fn partings(sketch: &Sketch<'_>, link: &str) -> impl Iterator<Item = Remedy> {
    let mut joints = sketch.paired(link);
    joints.sort_by_key(|joint| sketch.links_at(joint).contains(&GROUND));
    joints.into_iter().flat_map(|joint| part(sketch, link, joint)).collect::<Vec<_>>().into_iter()
}
