//! Remedies for a missing driver, or one that cannot drive.

use super::edit::drive::{drive, drive_instead, driver_name, leave_undriven};
use super::search::{Search, Tried};
use super::sketch::{GROUND, Sketch};
use crate::description::error::{DriverFault, Interrupted, StructureError};

/// Finds another driver in place of the ones that cannot drive.
pub(super) fn replace(
    search: &mut Search<'_>,
    sketch: &Sketch<'_>,
    error: &StructureError,
) -> Result<(), Interrupted> {
    let (faulty, preferred) = match error {
        StructureError::CannotDrive { drivers, fault } => (
            drivers.clone(),
            match fault {
                DriverFault::LeavesFree { links } => links.clone(),
                _ => Vec::new(),
            },
        ),
        StructureError::GroundDriven { driver } => (vec![driver.clone()], Vec::new()),
        StructureError::Unknown { name, .. } => (vec![name.clone()], Vec::new()),
        _ => return Ok(()),
    };
    let drivers = &sketch.description.drivers;
    // If drivers leave something free, any of them may be redundant: the last is changed first.
    let concerned = |index: &usize| {
        if !preferred.is_empty() {
            return true;
        }
        let name = driver_name(&drivers[*index]).replace(" relative to ", "/");
        faulty.contains(&name)
    };
    let mut able = candidates(sketch);
    able.sort_by_key(|name| !preferred.iter().any(|first| first == name));
    for index in (0..drivers.len()).rev().filter(concerned) {
        for name in &able {
            search.attempt_first(drive_instead(sketch, name, index))?;
            if search.is_over() {
                return Ok(());
            }
        }
    }
    Ok(())
}

/// Finds drivers where none is given. If nothing can drive, returns the first link or slide for which the
/// reason lies elsewhere, with this reason.
pub(super) fn choose(
    search: &mut Search<'_>,
    sketch: &Sketch<'_>,
) -> Result<Option<(String, StructureError)>, Interrupted> {
    let mut elsewhere = None;
    for name in candidates(sketch) {
        if search.is_over() {
            break;
        }
        let Tried::Refused(Some(error)) = search.attempt(drive(sketch, name))? else { continue };
        if matches!(error, StructureError::CannotDrive { .. }) {
            continue;
        }
        let is_any = is_of_any_driver(&error);
        elsewhere.get_or_insert((name.to_owned(), error));
        if is_any {
            break;
        }
    }
    Ok(elsewhere.filter(|_| search.remedies.is_empty()))
}

/// Whether an error is the same for every driver.
fn is_of_any_driver(error: &StructureError) -> bool {
    matches!(
        error,
        StructureError::Immovable { .. }
            | StructureError::Mobility { .. }
            | StructureError::Unconnected { .. }
            | StructureError::LooseJoint { .. }
            | StructureError::GuideNowhere { .. }
            | StructureError::Unplaced { .. }
    )
}

/// Leaves out a driver that is given twice.
pub(super) fn give_once(
    search: &mut Search<'_>,
    sketch: &Sketch<'_>,
    twice: &str,
) -> Result<(), Interrupted> {
    let drivers = &sketch.description.drivers;
    let last = drivers.iter().rposition(|driver| driver_name(driver) == twice);
    search.attempt_first(last.and_then(|index| leave_undriven(sketch, &[index])))?;
    Ok(())
}

/// Candidates for a driver, the likeliest first: links on the ground, slides on it, other slides and links.
fn candidates<'a>(sketch: &Sketch<'a>) -> Vec<&'a str> {
    let slides = || sketch.description.slides.iter();
    let on_ground = |name: &&str| sketch.is_on_ground(name);
    let mut names: Vec<&str> = sketch.moving_links().filter(on_ground).collect();
    names.extend(slides().filter(|s| s.on == GROUND).map(|s| &s.name[..]));
    names.extend(slides().filter(|s| s.on != GROUND).map(|s| &s.name[..]));
    names.extend(sketch.moving_links().filter(|name| !on_ground(name)));
    names
}
