//! Work space of groups of binary links.

use crate::math::derivatives::ONE_DRIVER;
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::binary_links::MAX_UNKNOWNS;

/// Entries of a jet, at most.
pub(crate) const ENTRIES: usize = ONE_DRIVER.len();
/// Jet of a vector.
pub(crate) type VectorJet<R> = [Vector<R>; ENTRIES];

/// Work space for eight positions (or one).
#[derive(Debug, Clone)]
pub(crate) struct GroupWorkspace<R: Real> {
    /// The unknown rotations.
    pub(crate) units: [Vector<R>; MAX_UNKNOWNS],
    /// What the loops have from before the group.
    pub(crate) known: [VectorJet<R>; MAX_UNKNOWNS],
    /// The spans, turned: of every loop and unknown.
    pub(crate) spans: [[VectorJet<R>; MAX_UNKNOWNS]; MAX_UNKNOWNS],
    /// The vectors of the loops' chords.
    pub(crate) chords: [VectorJet<R>; MAX_UNKNOWNS],
    /// Analogues of the unknowns, and of the binary links.
    pub(crate) rates: [[R; ENTRIES]; MAX_UNKNOWNS],
    pub(crate) bar_rates: [[R; ENTRIES]; MAX_UNKNOWNS],
    /// The matrix, with its inverse beside it, and what the lengths miss.
    pub(crate) matrix: [[R; 1]; 2 * MAX_UNKNOWNS * MAX_UNKNOWNS],
    pub(crate) residual: [R; MAX_UNKNOWNS],
}

impl<R: Real> Default for GroupWorkspace<R> {
    fn default() -> Self {
        Self {
            units: [Vector::ONE; MAX_UNKNOWNS],
            known: [[Vector::ZERO; ENTRIES]; MAX_UNKNOWNS],
            spans: [[[Vector::ZERO; ENTRIES]; MAX_UNKNOWNS]; MAX_UNKNOWNS],
            chords: [[Vector::ZERO; ENTRIES]; MAX_UNKNOWNS],
            rates: [[R::ZERO; ENTRIES]; MAX_UNKNOWNS],
            bar_rates: [[R::ZERO; ENTRIES]; MAX_UNKNOWNS],
            matrix: [[R::ZERO; 1]; 2 * MAX_UNKNOWNS * MAX_UNKNOWNS],
            residual: [R::ZERO; MAX_UNKNOWNS],
        }
    }
}
