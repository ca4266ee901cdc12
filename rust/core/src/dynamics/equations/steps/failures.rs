//! What ends the steps of an environment.

use crate::state::status::Status;

/// Greatest way of a driver from the start of a step to any stage (rad, or in sizes): a longer one skips
/// what is between.
const LONGEST: f64 = 1.0;
/// The status where a load has no finite value, or no inertia resists a driver: `assur.Status.NO_VALUE`.
pub(super) const NO_VALUE: u8 = 8;

/// The greatest way of a driver in a step, for a design of some size.
#[inline(always)]
pub(super) fn longest_way(driven_links: &[Option<usize>], driver: usize, size: f64) -> f64 {
    if driven_links[driver].is_some() { LONGEST } else { LONGEST * size }
}

/// Why a driver has no acceleration at a position of some status.
pub(super) fn without_acceleration(position: u8) -> u8 {
    if position == Status::Singular as u8 { position } else { NO_VALUE }
}

pub(super) fn has_failed(status: u8) -> bool {
    status > Status::NearSingular as u8
}

/// Whether an environment has failed.
pub(super) fn some_failed(status: &[u8]) -> bool {
    // No search that stops at the first: this reads them by vectors.
    status.iter().fold(false, |failed, &status| failed | has_failed(status))
}

/// Keeps the worst status; of failures the first, which causes the others.
pub(super) fn note(status: &mut u8, now: u8) {
    if *status <= Status::NearSingular as u8 {
        *status = now.max(*status);
    }
}

/// Notes the statuses of solved positions. At a change point there is a motion through it.
pub(super) fn note_positions(status: &mut [u8], positions: &[u8]) {
    for (status, &now) in status.iter_mut().zip(positions) {
        if now != Status::Singular as u8 {
            note(status, now);
        }
    }
}
