//! Remedies for more freedoms than drivers: ends are joined, guided or held, or more parts driven.

use super::edit::drive::{drive_too, leave_undriven};
use super::edit::hold::{hold, unite};
use super::edit::insert::{join, join_ground};
use super::edit::slide::{guide_end, guide_link};
use super::edit::take_out::take_out;
use super::remedy::Remedy;
use super::search::Search;
use super::sketch::{GROUND, Sketch};
use crate::description::error::{Interrupted, StructureError};

/// Most pairs of joints that are tried for a new link.
const PAIRS: usize = 6;

/// Finds remedies for links that still move while all drivers are held, or for too many drivers.
pub(super) fn bind(
    search: &mut Search<'_>,
    sketch: &Sketch<'_>,
    error: &StructureError,
) -> Result<(), Interrupted> {
    let StructureError::Mobility { mobility, drivers, .. } = error else { return Ok(()) };
    if drivers > mobility {
        return leave_out(search, sketch, drivers - mobility);
    }
    let free = free_links(error);
    let hanging = free.iter().rev().filter_map(|link| Some((&link[..], sketch.hangs_by(link)?)));
    let mut hangs = false;
    for (link, joint) in hanging {
        hangs = true;
        if search.is_over() {
            return Ok(());
        }
        match sketch.free_end(link, joint) {
            Some(end) => {
                search.attempt_first(joinings(sketch, link, end))?;
                search.attempt_first(guide_end(sketch, link, end))?;
                search.attempt_first(hold(sketch, &[end.into()]))?;
            }
            None => {
                search.attempt_first(guide_link(sketch, link, joint))?;
            }
        }
    }
    drive(search, sketch, error)?;
    if hangs {
        let last = |error: &StructureError, taken: &[String]| {
            free_links(error).into_iter().rev().find(|link| !taken.contains(link))
        };
        search.combine(sketch, error, take_out, last)?;
    }
    for link in free.iter().rev() {
        let moving = |joint: &&String| !sketch.links_at(joint).contains(&GROUND);
        for joint in sketch.joints_of(link).iter().filter(moving) {
            if search.is_over() {
                return Ok(());
            }
            search.attempt_first(join_ground(sketch, link, joint))?;
        }
    }
    join_two(search, sketch, &free)?;
    make_one(search, sketch, &free)
}

fn free_links(error: &StructureError) -> Vec<String> {
    match error {
        StructureError::Mobility { free, .. } => free.clone(),
        _ => Vec::new(),
    }
}

/// Joins an end: with joints of the ground that no moving link has yet, else with a new one.
fn joinings(sketch: &Sketch<'_>, link: &str, end: &str) -> Vec<Remedy> {
    let feet = sketch.waiting_feet().take(PAIRS);
    feet.map(|foot| join(sketch, end, foot)).chain(join_ground(sketch, link, end)).collect()
}

/// Drives further links or slides: those on the ground first.
fn drive(
    search: &mut Search<'_>,
    sketch: &Sketch<'_>,
    error: &StructureError,
) -> Result<(), Interrupted> {
    let next = |error: &StructureError, taken: &[String]| {
        let mut free = free_links(error);
        free.sort_by_key(|link| !sketch.is_on_ground(link));
        free.into_iter().find(|link| !taken.contains(link))
    };
    search.combine(sketch, error, drive_too, next)?;
    Ok(())
}

/// New links between joints of free links and others.
fn join_two(
    search: &mut Search<'_>,
    sketch: &Sketch<'_>,
    free: &[String],
) -> Result<(), Interrupted> {
    let mut tried = 0;
    for link in free {
        let apart = |from: &str, to: &str| {
            let shared = sketch.links_at(from).iter().any(|l| sketch.links_at(to).contains(l));
            !shared && sketch.between(from, to).norm2() > 0.0
        };
        for joint in sketch.joints_of(link) {
            for (partner, _) in &sketch.description.joints {
                if search.is_over() || tried == PAIRS {
                    return Ok(());
                }
                if apart(joint, partner) {
                    tried += 1;
                    if search.attempt(join(sketch, joint, partner))?.is_accepted() {
                        return Ok(());
                    }
                }
            }
        }
    }
    Ok(())
}

/// Unites two free links that meet.
fn make_one(
    search: &mut Search<'_>,
    sketch: &Sketch<'_>,
    free: &[String],
) -> Result<(), Interrupted> {
    for link in free {
        for joint in sketch.joints_of(link) {
            let later =
                sketch.links_at(joint).iter().skip_while(|partner| *partner != link).skip(1);
            for &partner in
                later.filter(|&&partner| free.iter().any(|free_link| free_link == partner))
            {
                if search.is_over() {
                    return Ok(());
                }
                search.attempt_first(unite(sketch, link, partner, joint))?;
            }
        }
    }
    Ok(())
}

/// Leaves out surplus drivers, the last first.
fn leave_out(
    search: &mut Search<'_>,
    sketch: &Sketch<'_>,
    surplus: usize,
) -> Result<(), Interrupted> {
    let count = sketch.description.drivers.len();
    for start in (0..=count.saturating_sub(surplus)).rev() {
        if search.is_over() {
            return Ok(());
        }
        let indices: Vec<usize> = (start..start + surplus).collect();
        search.attempt_first(leave_undriven(sketch, &indices))?;
    }
    Ok(())
}
