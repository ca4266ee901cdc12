//! A request for the terms of the equations of motion.

use crate::batch::request::Coordinates;
use crate::dynamics::variation::Variation;

/// A term of the equations of motion of n drivers; rows over designs and positions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Term {
    /// The mass matrix, n × n: kg·m², kg·m or kg by the drivers' coordinates.
    MassMatrix,
    /// Its derivatives, n × n × n, the last axis that of the coordinate.
    MassRates,
    /// What the drivers give without accelerations, n: N·m or N.
    Bias,
    /// The part of it that holds the weights, n.
    Gravity,
    /// What the drivers give with the request's accelerations, n.
    Effort,
    /// The accelerations under the request's efforts, n.
    Acceleration,
    /// First derivatives of a joint's position, 2 × n.
    Jacobian(usize),
}

impl Term {
    /// Numbers per position of n drivers.
    #[must_use]
    pub fn width(self, n: usize) -> usize {
        match self {
            Self::MassMatrix => n * n,
            Self::MassRates => n * n * n,
            Self::Bias | Self::Gravity | Self::Effort | Self::Acceleration => n,
            Self::Jacobian(_) => 2 * n,
        }
    }
}

/// Designs at positions whose equations of motion are requested.
#[derive(Debug, Clone, Copy)]
pub struct EquationRequest<'a> {
    /// Dimensions: the first of every design, then the second of every design, and so on.
    pub dimensions: &'a [f64],
    /// Coordinates of the drivers, rad or m.
    pub coordinates: Coordinates<'a>,
    /// Assembly signs, +1 or −1 for every dyad with two solutions.
    pub signs: &'a [i8],
    /// Speeds of the drivers, rad/s or m/s: designs × positions × drivers, or one for all.
    pub speed: &'a [f64],
    /// Accelerations for [`Term::Effort`], in the same layout.
    pub acceleration: &'a [f64],
    /// Efforts for [`Term::Acceleration`], N·m or N, in the same layout.
    pub effort: &'a [f64],
    /// Whether the motors act, too.
    pub has_motors: bool,
    /// Values of the callbacks of loads and motors: designs × positions × callbacks.
    pub external: &'a [f64],
    /// Sense in which each driver is about to move where all rest, +1 or −1. May be empty.
    pub sense: &'a [f64],
    /// Numbers of bodies, loads and motors that differ from machine to machine. May be empty.
    pub variations: &'a [Variation<'a>],
    /// The requested terms.
    pub terms: &'a [Term],
}

/// A direction in which terms are differentiated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// The coordinate of a driver.
    Coordinate(usize),
    /// Its speed.
    Speed(usize),
    /// Its acceleration, which [`Term::Effort`] reads.
    Acceleration(usize),
    /// Its effort, which [`Term::Acceleration`] reads.
    Effort(usize),
    /// A dimension, in the order of [`crate::Mechanism::dimensions`].
    Dimension(usize),
}
