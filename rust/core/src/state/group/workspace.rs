//! Work space of the kernel for groups of binary links.

use crate::math::derivatives::ONE_DRIVER;
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::binary_links::MAX_UNKNOWNS;

/// Greatest number of entries of a jet.
pub(crate) const ENTRIES: usize = ONE_DRIVER.len();
/// Jet of a vector.
pub(crate) type VectorJet<R> = [Vector<R>; ENTRIES];

/// Work space for the lanes of one lane group (or one position).
#[derive(Debug, Clone)]
pub(crate) struct GroupWorkspace<R: Real> {
    /// Unknown rotations.
    pub(crate) units: [Vector<R>; MAX_UNKNOWNS],
    /// Jets of the known part of every loop: from its start to its end point.
    pub(crate) known: [VectorJet<R>; MAX_UNKNOWNS],
    /// Jets of the turned spans, by loop and unknown.
    pub(crate) spans: [[VectorJet<R>; MAX_UNKNOWNS]; MAX_UNKNOWNS],
    /// Jets of the loops' chords.
    pub(crate) chords: [VectorJet<R>; MAX_UNKNOWNS],
    /// Analogues of the unknowns.
    pub(crate) rates: [[R; ENTRIES]; MAX_UNKNOWNS],
    /// Analogues of the bars' rotations.
    pub(crate) bar_rates: [[R; ENTRIES]; MAX_UNKNOWNS],
    /// The matrix, with its inverse beside it.
    pub(crate) matrix: [[R; 1]; 2 * MAX_UNKNOWNS * MAX_UNKNOWNS],
    /// Residuals of the chords' lengths.
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
