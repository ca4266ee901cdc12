//! Status of a position, and the step that failed.

use crate::math::tolerance::SINGULAR_CONDITION;

/// Square of the sine below which rounding cannot distinguish a dyad from a flat one.
pub(crate) const FLAT2: f64 = 1.0 / (SINGULAR_CONDITION * SINGULAR_CONDITION);

/// Status of a position; its value is the code in the arrays of results.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Status {
    /// Solved.
    Ok = 0,
    /// Solved, but the analogues keep fewer than six digits.
    NearSingular = 1,
    /// Solved, but the analogues are NaN, except at a change point; where a length is 0, only its own.
    Singular = 2,
    /// The assembly does not exist at this coordinate, or a length would be negative.
    Unreachable = 3,
    /// The branch cannot be followed from the drawing to this coordinate: the signs of a driven
    /// angle do not return within 64 turns, or it is beyond a fold of a group above class II.
    Lost = 4,
    /// The iteration of a group above class II did not converge.
    NotConverged = 5,
    /// The design has an invalid dimension.
    BadDimension = 6,
    /// The coordinate is not finite, or with several drivers too far from the drawing.
    BadInput = 7,
}

/// The step at which a position failed, and why.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Fault {
    /// The dyad of this step does not close; the gap is relative to the scale.
    NotClosed { step: usize, gap: f64 },
    /// The redundant link of this step does not fit; the gap is relative to the scale.
    RedundantMisfit { step: usize, gap: f64 },
    /// The dyad or group of this step is flat.
    Singular { step: usize },
    /// The iteration of the group of this step did not converge.
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

/// Why the solver rejected a position, in enough detail to explain it without solving again.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Rejection {
    /// The position, or its analogues, could not be computed.
    Failed { status: Status, fault: Option<Fault> },
    /// Next to a dead point; `step`: the dyad that folds there, if known.
    DeadPoint { step: Option<usize> },
    /// Next to a near miss of a change point, where the motion turns too sharply to be integrated.
    NearMiss { step: usize },
    /// Where a slide whose value is a length is so short that its direction is hardly determined.
    /// `step`: its dyad, or the check of a driven one.
    ZeroLength { step: usize },
}

impl Rejection {
    /// Status of the position.
    #[must_use]
    pub(crate) fn status(self) -> Status {
        match self {
            Self::Failed { status, .. } => status,
            Self::DeadPoint { .. } => Status::Singular,
            Self::NearMiss { .. } | Self::ZeroLength { .. } => Status::NearSingular,
        }
    }
}
