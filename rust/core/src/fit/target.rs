//! Targets: numbers that a motion is to have at positions of the driver.

use std::f64::consts::TAU;

use crate::batch::request::Quantity;

/// One number of a motion, and what it is to be at each position.
#[derive(Debug, Clone, PartialEq)]
pub struct TargetNumber {
    /// Where it is read.
    pub quantity: Quantity,
    /// For a joint, 0 for x and 1 for y.
    pub axis: usize,
    /// Its residual counts so many times: metres per radian for an angle beside lengths.
    pub weight: f64,
    /// What it is to be, m or rad.
    pub wanted: Vec<f64>,
    /// Whether whole turns do not matter.
    pub is_angle: bool,
}

/// At which coordinates of the driver a motion meets its target.
#[derive(Debug, Clone, PartialEq)]
pub enum Timing {
    /// At these, rad or m.
    Fixed(Vec<f64>),
    /// At these and a phase that is free.
    Phase(Vec<f64>),
    /// Anywhere: each point has a coordinate of its own.
    Free {
        /// Whether these have the order of the points.
        is_ordered: bool,
        /// Whether the path leads back from the last point to the first.
        is_closed: bool,
    },
}

/// What of a target's own frame is free.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Freedom {
    /// Nothing.
    None,
    /// Place and direction of the mechanism.
    Place,
    /// Place, direction and size.
    Similarity,
    /// A constant of the third number: the angle at which a body is fixed to its link.
    Turned,
    /// Scale and offset of a number: wanted + residual = scale × number + offset.
    Line {
        /// Whether the scale is free.
        scale: bool,
        /// Whether the offset is free.
        offset: bool,
    },
}

impl Freedom {
    /// How many numbers it is.
    pub(super) fn numbers(self) -> usize {
        match self {
            Self::None => 0,
            Self::Turned => 1,
            Self::Place => 3,
            Self::Similarity => 4,
            Self::Line { scale, offset } => usize::from(scale) + usize::from(offset),
        }
    }
}

/// What a motion is to do.
#[derive(Debug, Clone, PartialEq)]
pub struct FitTarget {
    /// The numbers; all have as many wanted values.
    pub numbers: Vec<TargetNumber>,
    /// How much each position counts.
    pub weights: Vec<f64>,
    /// When.
    pub timing: Timing,
    /// In which frame.
    pub freedom: Freedom,
}

impl FitTarget {
    /// Number of positions.
    #[must_use]
    pub fn len(&self) -> usize {
        self.weights.len()
    }

    /// Whether there are no positions.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.weights.is_empty()
    }

    /// The sum of squares of what is wanted, from its mean.
    pub(super) fn size(&self) -> f64 {
        let of = |number: &TargetNumber| -> f64 {
            let mean = number.wanted.iter().sum::<f64>() / number.wanted.len() as f64;
            let square = |(wanted, weight): (&f64, &f64)| {
                let off = number.weight * weight * (wanted - mean);
                off * off
            };
            number.wanted.iter().zip(&self.weights).map(square).sum()
        };
        self.numbers.iter().map(of).sum()
    }

    /// The points of a path; `None` if it is something else.
    pub(super) fn points(&self) -> Option<Vec<[f64; 2]>> {
        let [x, y, ..] = self.numbers.as_slice() else { return None };
        let is_point = matches!(x.quantity, Quantity::Joint(_) | Quantity::Origin(_))
            && x.quantity == y.quantity
            && (x.axis, y.axis) == (0, 1);
        is_point.then(|| x.wanted.iter().zip(&y.wanted).map(|(&x, &y)| [x, y]).collect())
    }

    /// Numbers beside the dimensions that a fit chooses for this target alone: the phase, then those of its freedom.
    pub(super) fn extra(&self) -> usize {
        usize::from(matches!(self.timing, Timing::Phase(_))) + self.freedom.numbers()
    }

    /// What these numbers are where nothing is known.
    pub(super) fn neutral(&self) -> Vec<f64> {
        let mut numbers = vec![];
        if matches!(self.timing, Timing::Phase(_)) {
            numbers.push(0.0);
        }
        match self.freedom {
            Freedom::None => {}
            Freedom::Turned => numbers.push(0.0),
            Freedom::Place => numbers.extend([0.0; 3]),
            Freedom::Similarity => numbers.extend([1.0, 0.0, 0.0, 0.0]),
            Freedom::Line { scale, offset } => {
                numbers.extend(scale.then_some(1.0));
                numbers.extend(offset.then_some(0.0));
            }
        }
        numbers
    }
}

/// Numbers of a quantity at a position.
pub(super) fn width(quantity: Quantity) -> usize {
    match quantity {
        Quantity::Joint(_) | Quantity::Origin(_) | Quantity::Direction(_) => 2,
        Quantity::Slide(_) | Quantity::Angle(_) => 1,
    }
}

/// An angle less whole turns, in [−π, π].
pub(super) fn within_half_turn(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}
