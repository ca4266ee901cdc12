//! Edits that turn a refused description into a mechanism.
//!
//! Each kind of error has its edits (`stuck`, `loose`, `driving`, `unfinished`), the likeliest
//! first. `search` builds the edited descriptions and offers those that the structure and the solver accept.

mod driving;
mod edit;
mod loose;
mod remedy;
mod search;
mod sketch;
mod stuck;
mod unfinished;
mod words;

#[cfg(test)]
mod tests;

pub use remedy::{Remedy, RemedyKind};

use std::sync::atomic::AtomicBool;

use self::search::Search;
use self::sketch::Sketch;
use crate::description::error::{Interrupted, Item, StructureError};
use crate::description::{Description, DriverDescription};
use crate::plan::mechanism::Mechanism;

/// Up to three edits after which a refused description is a mechanism, the likeliest first; empty if it
/// already is one, or if no edit was found. Stops once `cancel` is true.
///
/// # Errors
///
/// [`StructureError::Interrupted`].
///
/// # Examples
///
/// ```
/// use assur::{Description, Mechanism, remedies};
///
/// let braced = Description::new()
///     .joint("A", [0.0, 0.0])
///     .joint("B", [1.0, 2.0])
///     .joint("C", [5.0, 3.0])
///     .joint("D", [6.0, 0.0])
///     .link("ground", ["A", "D"])
///     .link("crank", ["A", "B"])
///     .link("coupler", ["B", "C"])
///     .link("rocker", ["C", "D"])
///     .link("brace", ["A", "C"])
///     .driver("crank");
/// let offers = remedies(&braced, None)?;
/// assert_eq!(offers[1].text, "Take out brace");
/// assert!(Mechanism::new(&offers[1].description).is_ok());
/// # Ok::<(), assur::StructureError>(())
/// ```
pub fn remedies(
    description: &Description,
    cancel: Option<&AtomicBool>,
) -> Result<Vec<Remedy>, StructureError> {
    let mut search = Search::new(description, cancel);
    match Mechanism::new_unless(description, cancel) {
        Ok(_) => {}
        Err(StructureError::Interrupted) => return Err(StructureError::Interrupted),
        Err(error) => propose(&mut search, description, &error)?,
    }
    Ok(search.remedies)
}

fn propose(
    search: &mut Search<'_>,
    description: &Description,
    error: &StructureError,
) -> Result<(), Interrupted> {
    let sketch = Sketch::new(description);
    match error {
        StructureError::NoDriver => {
            let Some((name, reason)) = driving::choose(search, &sketch)? else { return Ok(()) };
            let drivers = vec![DriverDescription::Named(name)];
            let driven = Description { drivers, ..description.clone() };
            repair(search, &Sketch::new(&driven), &reason)
        }
        error => repair(search, &sketch, error),
    }
}

fn repair(
    search: &mut Search<'_>,
    sketch: &Sketch<'_>,
    error: &StructureError,
) -> Result<(), Interrupted> {
    use StructureError as E;
    match error {
        E::Immovable { .. }
        | E::OverConstrained { .. }
        | E::AlmostFits { .. }
        | E::SlidesOnly { .. } => stuck::free(search, sketch, error),
        E::Mobility { .. } => loose::bind(search, sketch, error),
        E::CannotDrive { .. } | E::GroundDriven { .. } | E::Unknown { item: Item::Driver, .. } => {
            driving::replace(search, sketch, error)
        }
        E::DoubledDriver { driver } => driving::give_once(search, sketch, driver),
        error => unfinished::finish(search, sketch, error),
    }
}
