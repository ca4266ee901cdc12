//! Tries remedies: what is offered was built and accepted as any mechanism is.

use std::sync::atomic::AtomicBool;

use super::remedy::Remedy;
use super::sketch::Sketch;
use crate::description::Description;
use crate::description::error::{Interrupted, Named, StructureError};
use crate::plan::mechanism::Mechanism;

/// Remedies that are offered at most.
const OFFERED: usize = 3;
/// Descriptions that are built at most.
const TRIES: usize = 64;
/// The same times the square of the links, with which the time to build one grows: a fraction of a
/// second for 200 links. With more than 565 links nothing is tried.
const WORK: usize = 320_000;
/// Edits of one kind that are combined at most.
pub(super) const COMBINED: usize = 3;

/// What became of an edit.
pub(super) enum Tried {
    /// It is a mechanism, and offered.
    Accepted,
    /// It is none, or drawn at a dead point.
    Refused(Option<StructureError>),
}

impl Tried {
    pub(super) fn is_accepted(&self) -> bool {
        matches!(self, Self::Accepted)
    }
}

/// The remedies found so far.
pub(super) struct Search<'a> {
    pub(super) found: Vec<Remedy>,
    tries: usize,
    pub(super) cancel: Option<&'a AtomicBool>,
}

impl<'a> Search<'a> {
    pub(super) fn new(description: &Description, cancel: Option<&'a AtomicBool>) -> Self {
        let links = description.links.len().max(1);
        let tries = TRIES.min(WORK / links.saturating_mul(links));
        Self { found: Vec::new(), tries, cancel }
    }

    /// Whether there are as many as are offered, or enough was tried.
    pub(super) fn is_over(&self) -> bool {
        self.found.len() >= OFFERED || self.tries == 0
    }

    /// Builds an edited description, and keeps it if it is a mechanism with as many drivers as
    /// freedoms in a position that is solved.
    pub(super) fn attempt(&mut self, mut remedy: Remedy) -> Result<Tried, Interrupted> {
        if self.is_over() || self.found.iter().any(|own| own.text == remedy.text) {
            return Ok(Tried::Refused(None));
        }
        self.tries -= 1;
        loop {
            return match Mechanism::new_unless(&remedy.description, self.cancel) {
                Ok(mechanism) if is_well_drawn(&mechanism) => {
                    self.found.push(remedy);
                    Ok(Tried::Accepted)
                }
                Ok(_) => Ok(Tried::Refused(None)),
                Err(StructureError::Interrupted) => Err(Interrupted),
                // A sign of a dyad that the edit resolved.
                Err(StructureError::Unknown { kind: Named::Dyad, name, .. })
                    if remedy.description.assembly.iter().any(|(own, _)| *own == name) =>
                {
                    remedy.description.assembly.retain(|(own, _)| *own != name);
                    continue;
                }
                Err(error) => Ok(Tried::Refused(Some(error))),
            };
        }
    }

    /// The first of several that is accepted.
    pub(super) fn attempt_first(
        &mut self,
        remedies: impl IntoIterator<Item = Remedy>,
    ) -> Result<bool, Interrupted> {
        for remedy in remedies {
            if self.is_over() {
                break;
            }
            if self.attempt(remedy)?.is_accepted() {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Edits one thing after another until the whole is accepted. `build` makes the edit of all that
    /// are named, `next` names one more from the error that is left.
    pub(super) fn combine(
        &mut self,
        sketch: &Sketch<'_>,
        error: &StructureError,
        build: impl Fn(&Sketch<'_>, &[String]) -> Option<Remedy>,
        next: impl Fn(&StructureError, &[String]) -> Option<String>,
    ) -> Result<bool, Interrupted> {
        let (mut names, mut error) = (Vec::new(), error.clone());
        while names.len() < COMBINED {
            let Some(name) = next(&error, &names) else { break };
            names.push(name);
            let Some(remedy) = build(sketch, &names) else { break };
            match self.attempt(remedy)? {
                Tried::Accepted => return Ok(true),
                Tried::Refused(Some(left)) => error = left,
                Tried::Refused(None) => break,
            }
        }
        Ok(false)
    }
}

/// Whether the drawing moves as freely as it is driven, and is no dead point.
fn is_well_drawn(mechanism: &Mechanism) -> bool {
    let (structure, q0) = (mechanism.structure(), mechanism.q0());
    if structure.mobility != q0.len() || structure.mobility_at_drawing != q0.len() {
        return false;
    }
    let found = mechanism.diagnose(mechanism.drawing(), q0, mechanism.signs());
    found.is_ok_and(|all| all.iter().all(|one| one.failure.is_none()))
}
