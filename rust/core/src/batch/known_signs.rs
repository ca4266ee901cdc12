//! What solving a batch has found out about its designs, for later calls.

use std::collections::TryReserveError;
use std::sync::atomic::{AtomicBool, Ordering};

/// For every design of a batch, whether its signs are known to be the same everywhere: joints and
/// slides need no tracing then.
///
/// It belongs to the dimensions and the assembly of one batch. It says only what tracing finds again,
/// so several calls may use it at once, and results do not depend on it.
#[derive(Debug, Default)]
pub struct KnownSigns(Vec<AtomicBool>);

impl KnownSigns {
    /// Nothing is known yet.
    ///
    /// # Errors
    ///
    /// [`TryReserveError`] if one byte a design does not fit in memory.
    pub fn new(designs: usize) -> Result<Self, TryReserveError> {
        let mut known = Vec::new();
        known.try_reserve_exact(designs)?;
        known.resize_with(designs, AtomicBool::default);
        Ok(Self(known))
    }

    pub(super) fn are_constant(&self, design: usize) -> bool {
        self.0.get(design).is_some_and(|known| known.load(Ordering::Relaxed))
    }

    pub(super) fn set_constant(&self, design: usize) {
        if let Some(known) = self.0.get(design) {
            known.store(true, Ordering::Relaxed);
        }
    }
}
