//! Tries remedies: every offered one was built and accepted like any mechanism.

use std::sync::atomic::AtomicBool;

use super::remedy::Remedy;
use super::sketch::Sketch;
use crate::description::Description;
use crate::description::error::{Interrupted, Named, StructureError};
use crate::plan::mechanism::Mechanism;

/// Most remedies that are offered.
const OFFERED: usize = 3;
/// Most descriptions that are built.
const TRIES: usize = 64;
/// The same times the square of the number of links, with which the time to build one grows: a fraction of a
/// second for 200 links. With more than 565 links nothing is tried.
const WORK: usize = 320_000;
/// Most edits of one kind that are combined.
pub(super) const COMBINED: usize = 3;

/// Result of trying an edit.
pub(super) enum Tried {
    /// The edited description is a mechanism, and offered.
    Accepted,
    /// It is not a mechanism, or is drawn at a dead point.
    Refused(Option<StructureError>),
}

impl Tried {
    pub(super) fn is_accepted(&self) -> bool {
        matches!(self, Self::Accepted)
    }
}

/// The remedies found so far.
pub(super) struct Search<'a> {
    pub(super) remedies: Vec<Remedy>,
    tries: usize,
    pub(super) cancel: Option<&'a AtomicBool>,
}

impl<'a> Search<'a> {
    pub(super) fn new(description: &Description, cancel: Option<&'a AtomicBool>) -> Self {
        let links = description.links.len().max(1);
        let tries = TRIES.min(WORK / links.saturating_mul(links));
        Self { remedies: Vec::new(), tries, cancel }
    }

    /// Whether enough remedies were found or tried.
    pub(super) fn is_over(&self) -> bool {
        self.remedies.len() >= OFFERED || self.tries == 0
    }

    /// Builds an edited description, and keeps it if it is a mechanism with as many drivers as
    /// freedoms in a position that is solved.
    pub(super) fn attempt(&mut self, mut remedy: Remedy) -> Result<Tried, Interrupted> {
        if self.is_over() || self.remedies.iter().any(|earlier| earlier.text == remedy.text) {
            return Ok(Tried::Refused(None));
        }
        self.tries -= 1;
        loop {
            return match Mechanism::new_unless(&remedy.description, self.cancel) {
                Ok(mechanism) if is_well_drawn(&mechanism) => {
                    self.remedies.push(remedy);
                    Ok(Tried::Accepted)
                }
                Ok(_) => Ok(Tried::Refused(None)),
                Err(StructureError::Interrupted) => Err(Interrupted),
                // A sign of a dyad that the edit resolved.
                Err(StructureError::Unknown { kind: Named::Dyad, name, .. })
                    if remedy.description.assembly.iter().any(|(dyad, _)| *dyad == name) =>
                {
                    remedy.description.assembly.retain(|(dyad, _)| *dyad != name);
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

    /// Edits one part after another until the whole is accepted. `build` edits all named parts, `next` names
    /// one more from the remaining error.
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

/// Whether the drawing moves as freely as it is driven, and is not a dead point.
fn is_well_drawn(mechanism: &Mechanism) -> bool {
    let (structure, q0) = (mechanism.structure(), mechanism.q0());
    if structure.mobility != q0.len() || structure.mobility_at_drawing != q0.len() {
        return false;
    }
    let diagnoses = mechanism.diagnose(mechanism.drawing(), q0, mechanism.signs());
    diagnoses.is_ok_and(|all| all.iter().all(|diagnosis| diagnosis.failure.is_none()))
}
