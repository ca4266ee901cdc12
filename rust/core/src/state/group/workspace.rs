//! Work space of groups of binary links.

use crate::math::derivatives::ONE_DRIVER;
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::binary_links::MOST;

/// Entries of a jet, at most.
pub(crate) const ENTRIES: usize = ONE_DRIVER.len();
/// Jet of a vector.
pub(crate) type VectorJet<R> = [Vector<R>; ENTRIES];

/// Work space for eight positions (or one).
#[derive(Debug, Clone)]
pub(crate) struct GroupWorkspace<R: Real> {
    /// The unknown rotations.
    pub(crate) units: [Vector<R>; MOST],
    /// What the loops have from before the group.
    pub(crate) known: [VectorJet<R>; MOST],
    /// The spans, turned: of every loop and unknown.
    pub(crate) spans: [[VectorJet<R>; MOST]; MOST],
    /// The vectors of the loops' chords.
    pub(crate) chords: [VectorJet<R>; MOST],
    /// Analogues of the unknowns, and of the binary links.
    pub(crate) rates: [[R; ENTRIES]; MOST],
    pub(crate) taken: [[R; ENTRIES]; MOST],
    /// The matrix, with its inverse beside it, and what the lengths miss.
    pub(crate) matrix: [[R; 1]; 2 * MOST * MOST],
    pub(crate) missing: [R; MOST],
}

impl<R: Real> Default for GroupWorkspace<R> {
    fn default() -> Self {
        Self {
            units: [Vector::ONE; MOST],
            known: [[Vector::ZERO; ENTRIES]; MOST],
            spans: [[[Vector::ZERO; ENTRIES]; MOST]; MOST],
            chords: [[Vector::ZERO; ENTRIES]; MOST],
            rates: [[R::ZERO; ENTRIES]; MOST],
            taken: [[R::ZERO; ENTRIES]; MOST],
            matrix: [[R::ZERO; 1]; 2 * MOST * MOST],
            missing: [R::ZERO; MOST],
        }
    }
}
