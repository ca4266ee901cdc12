//! Errors of a run.

use strum::{IntoStaticStr, VariantNames};
use thiserror::Error;

use crate::description::error::{Hint, coordinate_text, number};
use crate::dynamics::run::variable::Variable;
use crate::dynamics::tables::error::short;
use crate::dynamics::tables::table::Table;
use crate::ode::error::Error as IntegratorError;
use crate::query::failure::Failure;

/// Why a run failed, as opposed to how it ended.
#[derive(Debug, Clone, PartialEq, Error, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "snake_case")]
pub enum RunError<E> {
    /// The error of a callback.
    #[error("{0}")]
    Callback(E),
    /// Friction locks the machine where it is to start.
    #[error(
        "friction locks the machine at q = {}: no acceleration agrees with it",
        number(*q)
    )]
    Locked {
        /// The coordinate.
        q: f64,
    },
    /// The reduced inertia is not positive.
    #[error(
        "the reduced inertia is {} kg·m² at q = {}: it must be positive everywhere",
        short(*value), coordinate_text(q)
    )]
    NoInertia {
        /// Coordinates.
        q: Vec<f64>,
        /// Inertia there, kg·m².
        value: f64,
        /// The driver that it belongs to, of a mechanism.
        driver: Option<String>,
    },
    /// The mechanism has no valid position at the initial coordinates.
    #[error("the motion cannot start at q0: {0}")]
    NoInitialPosition(Failure),
    /// Accelerations become infinite or NaN.
    #[error(
        "the motion is not finite at {} = {}: a load, a speed or a mass is too great there, or a damper or spring has length zero",
        along.symbol(), number(*at)
    )]
    NotFinite {
        /// The variable of `at`.
        along: Variable,
        /// Time, s, or coordinate.
        at: f64,
    },
    /// Options that the integrator refuses.
    #[error("{0}")]
    Options(String),
    /// A list of the wrong length.
    #[error("wrong number of {what}: {given} given, {needed} needed")]
    WrongCount {
        /// The contents of the list.
        what: &'static str,
        /// Length needed.
        needed: usize,
        /// Length given.
        given: usize,
    },
    /// Too many knots of tables.
    #[error(
        "the tables have more than {most:e} knots between q = {} and {}, or these are too far from 0 to tell knots apart",
        number(*from), number(*to)
    )]
    TooManyKnots {
        /// The limit.
        most: f64,
        /// Start of the interval.
        from: f64,
        /// End of the interval.
        to: f64,
    },
    /// The record of the run does not fit in memory.
    #[error("out of memory: the run has taken {steps} steps, and no more fit")]
    OutOfMemory {
        /// The steps that it has taken.
        steps: usize,
    },
    /// A table does not cover the initial state.
    #[error("a {what} covers {} to {}: {} is not in it", number(*from), number(*to), number(*q))]
    TableEnds {
        /// The kind of table.
        what: &'static str,
        /// Its first row.
        from: f64,
        /// Its last row.
        to: f64,
        /// The initial coordinate or speed.
        q: f64,
    },
}

impl<E: std::fmt::Display> Hint for RunError<E> {
    fn hint(&self) -> Option<String> {
        match self {
            Self::NoInertia { driver: Some(driver), .. } => Some(format!(
                "give {driver:?}, or the links that move with it, a Body with a mass or an inertia"
            )),
            Self::NoInitialPosition(failure) => failure.hint(),
            Self::Locked { .. } => Some("start elsewhere, or with less friction".into()),
            Self::OutOfMemory { .. } => Some("run for a shorter time, in parts".into()),
            Self::TableEnds { .. } => Some("extend the table, or start within it".into()),
            _ => None,
        }
    }
}

impl<E: std::fmt::Display> RunError<E> {
    /// The error of an integration along the time or the coordinate from a value of it.
    pub(crate) fn of_integrator(error: IntegratorError<Self>, along: Variable, from: f64) -> Self {
        match error {
            IntegratorError::System(error) => error,
            IntegratorError::NotFinite { t, .. } => Self::NotFinite { along, at: t },
            IntegratorError::OutOfMemory { steps } => Self::OutOfMemory { steps },
            IntegratorError::InitialState { .. } => Self::NotFinite { along, at: from },
            other => Self::Options(other.to_string()),
        }
    }
}

/// The error for `q` outside a table.
pub(crate) fn outside_table<E>(what: &'static str, table: &Table, q: f64) -> RunError<E> {
    let [from, to] = table.range();
    RunError::TableEnds { what, from, to, q }
}

/// Checks lengths: (name, needed, given) each.
pub(crate) fn check_counts<E>(counts: &[(&'static str, usize, usize)]) -> Result<(), RunError<E>> {
    match counts.iter().find(|(_, needed, given)| needed != given) {
        Some(&(what, needed, given)) => Err(RunError::WrongCount { what, needed, given }),
        None => Ok(()),
    }
}
