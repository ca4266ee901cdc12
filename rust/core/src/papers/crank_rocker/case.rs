//! A run's case and its result.

use std::fmt::Display;

use strum::{IntoStaticStr, VariantNames};
use thiserror::Error;

use crate::description::error::{Hint, number, rounded};

/// Side on which C jams.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// γ₂₃ near π: D slides inward.
    Outer,
    /// γ₂₃ near 0: D slides outward.
    Inner,
}

impl Side {
    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Outer => "outer",
            Self::Inner => "inner",
        }
    }
}

/// Kind of an event.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// C jams, so that D slides.
    Jam,
    /// D is back at its position, so that the rocker swings again.
    Return,
    /// The rod just reaches the line of centres: the run ends.
    DeadPoint,
    /// The run ends while D has been sliding for more than a turn.
    NoReturn,
}

/// An event of the run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// Its kind.
    pub kind: Kind,
    /// The side that jams.
    pub side: Side,
    /// Time, s.
    pub t: f64,
    /// Crank angle, rad.
    pub phi1: f64,
    /// Distance of D from A, m.
    pub l4: f64,
    /// Prescribed ground at that time, m.
    pub ground: f64,
    /// dl₄/dt before and after, m/s; NaN at the end of a run.
    pub ground_speed: [f64; 2],
    /// Angular velocity of the rocker or rod before and after, rad/s; NaN at the end of a run.
    pub rod_speed: [f64; 2],
}

/// One position of the run. A is the origin, D lies on the negative x-axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Time, s.
    pub t: f64,
    /// Distance of D from A, m.
    pub l4: f64,
    /// Transmission angle, rad.
    pub gamma: f64,
    /// Whether D slides.
    pub sliding: bool,
    /// Positions of B and C, m.
    pub positions: [[f64; 2]; 2],
}

/// Why a run cannot start or go on.
#[derive(Debug, Clone, PartialEq, Error, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "snake_case")]
pub enum JammingError<E> {
    /// Blocked at the start.
    #[error(
        "the start at phi0 = {} is blocked ({}): its transmission angle {} rad is not above gamma_min",
        number(*phi0), side.name(), rounded(*gamma, 6)
    )]
    Blocked {
        /// The side that jams.
        side: Side,
        /// The transmission angle, rad.
        gamma: f64,
        /// Crank angle at the start, rad.
        phi0: f64,
    },
    /// The coupler does not reach the rocker at the start.
    #[error(
        "the coupler does not reach the rocker at the start, phi0 = {}: BD is {} m, not in {} … {} m",
        number(*phi0), rounded(*distance, 9), number(range[0]), number(range[1])
    )]
    OutOfReach {
        /// BD, m.
        distance: f64,
        /// Least and greatest BD of coupler and rocker, m.
        range: [f64; 2],
        /// Crank angle at the start, rad.
        phi0: f64,
    },
    /// An error of the ground's function.
    #[error("{0}")]
    Ground(E),
}

impl<E: Display> Hint for JammingError<E> {
    fn hint(&self) -> Option<String> {
        match self {
            Self::Blocked { .. } => Some("begin outside the blocked zone".into()),
            Self::OutOfReach { .. } => Some("begin elsewhere, or with another ground".into()),
            Self::Ground(_) => None,
        }
    }
}

/// A run to compute.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Case {
    /// Crank, coupler and rocker, m.
    pub lengths: [f64; 3],
    /// Least transmission angles on the outer and the inner side, rad, above 0.
    pub gamma_min: [f64; 2],
    /// Speed of the crank, rad/s, not 0.
    pub speed: f64,
    /// Crank angle at the time 0, rad.
    pub phi0: f64,
    /// Turns of the crank, above 0.
    pub turns: f64,
}
