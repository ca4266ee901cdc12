//! How a position came out, and what failed.

use crate::math::tolerance::SINGULAR_CONDITION;

/// Square of the sine of a dyad that cannot be told from a flat one.
pub(crate) const FLAT2: f64 = 1.0 / (SINGULAR_CONDITION * SINGULAR_CONDITION);

/// How a position came out; the codes are those of the arrays.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Status {
    /// Solved.
    Ok = 0,
    /// Solved; fewer than six digits of the analogues remain.
    NearSingular = 1,
    /// The position is given; its analogues are NaN, except at a change point.
    Singular = 2,
    /// This assembly does not exist at this coordinate.
    Unreachable = 3,
    /// The way from the drawing to here is not known: the signs of a driven angle do not
    /// return within 64 turns (or beyond a fold of a higher group).
    Lost = 4,
    /// The iteration of a higher group did not end.
    NotConverged = 5,
    /// A dimension of this design is no dimension.
    BadDimension = 6,
    /// The coordinate is no number, or with several drivers too far from the drawing.
    BadInput = 7,
}

/// Where and why a position failed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Fault {
    /// Dyad (step) whose triangle does not close, by this part of the size.
    NotClosed { step: usize, gap: f64 },
    /// Redundant link (step) that does not fit, by this part of the size.
    RedundantMisfit { step: usize, gap: f64 },
    /// Dyad or group (step) that is flat.
    Singular { step: usize },
    /// Group (step) whose iteration did not end.
    NotConverged { step: usize },
}

impl Fault {
    /// Index of the step of the plan that failed.
    #[must_use]
    pub(crate) fn step(self) -> usize {
        match self {
            Self::NotClosed { step, .. }
            | Self::RedundantMisfit { step, .. }
            | Self::Singular { step }
            | Self::NotConverged { step } => step,
        }
    }
}
