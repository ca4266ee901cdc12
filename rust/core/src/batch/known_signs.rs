//! The designs of a batch with constant signs: found by one call, used by later ones.

use std::collections::TryReserveError;
use std::sync::atomic::{AtomicBool, Ordering};

/// For every design of a batch, whether its signs are known to be the same everywhere. Joints and
/// slides of such a design need no tracing.
///
/// It is valid for the dimensions and the assembly of one batch only. It repeats what tracing would
/// find, so results do not depend on it, and several calls may share it.
#[derive(Debug, Default)]
pub struct KnownSigns(Vec<AtomicBool>);

impl KnownSigns {
    /// For a batch whose signs are not known yet.
    ///
    /// # Errors
    ///
    /// [`TryReserveError`] if memory has no room for one byte per design.
    pub fn new(designs: usize) -> Result<Self, TryReserveError> {
        let mut flags = Vec::new();
        flags.try_reserve_exact(designs)?;
        flags.resize_with(designs, AtomicBool::default);
        Ok(Self(flags))
    }

    pub(super) fn are_constant(&self, design: usize) -> bool {
        self.0.get(design).is_some_and(|flag| flag.load(Ordering::Relaxed))
    }

    pub(super) fn set_constant(&self, design: usize) {
        if let Some(flag) = self.0.get(design) {
            flag.store(true, Ordering::Relaxed);
        }
    }
}
