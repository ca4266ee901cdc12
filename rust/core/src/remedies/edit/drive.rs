//! Other drivers.

use crate::description::{Description, DriverDescription};
use crate::remedies::remedy::{Remedy, RemedyKind};
use crate::remedies::sketch::{GROUND, Sketch};
use crate::remedies::words::{in_words, listed};

fn named(name: &str) -> DriverDescription {
    DriverDescription::Named(name.into())
}

/// Name of a driver in a sentence.
pub(in crate::remedies) fn driver_name(driver: &DriverDescription) -> String {
    match driver {
        DriverDescription::Named(name) => name.clone(),
        DriverDescription::Relative { link, relative_to } if relative_to == GROUND => link.clone(),
        DriverDescription::Relative { link, relative_to } => {
            format!("{link} relative to {relative_to}")
        }
    }
}

fn with(sketch: &Sketch<'_>, drivers: Vec<DriverDescription>) -> Description {
    Description { drivers, ..sketch.description.clone() }
}

/// Drives links or slides besides those that drive already.
pub(in crate::remedies) fn drive_too(sketch: &Sketch<'_>, names: &[String]) -> Option<Remedy> {
    let mut drivers = sketch.description.drivers.clone();
    if names.is_empty() || names.iter().any(|name| drivers.contains(&named(name))) {
        return None;
    }
    drivers.extend(names.iter().map(|name| named(name)));
    let count = drivers.len();
    Some(Remedy {
        kind: RemedyKind::Drive,
        names: names.to_vec(),
        text: format!("Drive {} too", listed(names)),
        detail: format!("{} drivers for mobility {count}", in_words(count)),
        description: with(sketch, drivers),
    })
}

/// Drives a link or slide where nothing drives yet.
pub(in crate::remedies) fn drive(sketch: &Sketch<'_>, name: &str) -> Remedy {
    Remedy {
        kind: RemedyKind::Drive,
        names: vec![name.into()],
        text: format!("Drive {name}"),
        detail: "with it held, nothing moves".into(),
        description: with(sketch, vec![named(name)]),
    }
}

/// Drives a link or slide in place of one of the drivers.
pub(in crate::remedies) fn drive_instead(
    sketch: &Sketch<'_>,
    name: &str,
    index: usize,
) -> Option<Remedy> {
    let old = driver_name(sketch.description.drivers.get(index)?);
    let mut drivers = sketch.description.drivers.clone();
    if drivers.contains(&named(name)) {
        return None;
    }
    drivers[index] = named(name);
    Some(Remedy {
        kind: RemedyKind::Drive,
        names: vec![name.into()],
        text: format!("Drive {name} instead of {old}"),
        detail: "with what is driven held, nothing moves".into(),
        description: with(sketch, drivers),
    })
}

/// Leaves out drivers, by their indices.
pub(in crate::remedies) fn leave_undriven(
    sketch: &Sketch<'_>,
    indices: &[usize],
) -> Option<Remedy> {
    let old = &sketch.description.drivers;
    let chosen = |out: bool| {
        let all = old.iter().enumerate().filter(move |(i, _)| indices.contains(i) == out);
        all.map(|(_, driver)| driver.clone()).collect::<Vec<_>>()
    };
    let (out, left): (Vec<_>, Vec<_>) = (chosen(true), chosen(false));
    let names: Vec<String> = out.iter().map(driver_name).collect();
    let remaining: Vec<String> = left.iter().map(driver_name).collect();
    if names.is_empty() || remaining.is_empty() {
        return None;
    }
    let detail = match &remaining[..] {
        [name] => format!("{name} drives alone"),
        several => format!("{} drive", listed(several)),
    };
    Some(Remedy {
        kind: RemedyKind::LeaveUndriven,
        text: format!("Leave {} undriven", listed(&names)),
        names,
        detail,
        description: with(sketch, left),
    })
}
