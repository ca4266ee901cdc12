//! Errors of a run.

use thiserror::Error;

use crate::dynamics::tables::table::Table;

/// Why a run failed, as opposed to how it ended.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RunError<E> {
    /// The error of a callback.
    #[error("{0}")]
    Callback(E),
    /// The reduced inertia is not positive.
    #[error(
        "the reduced inertia is {value} at q = {q}: it must be positive everywhere (give masses to the links that turn with the driver)"
    )]
    NoInertia {
        /// Coordinate.
        q: f64,
        /// Inertia there, kg·m².
        value: f64,
    },
    /// The mechanism has no valid position at the initial coordinates.
    #[error("no valid position at the initial coordinate q = {q:?}")]
    NoInitialPosition {
        /// Initial coordinates.
        q: Vec<f64>,
    },
    /// A list of the wrong length.
    #[error("{given} {what} are given: {needed} are needed")]
    WrongCount {
        /// What the list contains.
        what: &'static str,
        /// Length needed.
        needed: usize,
        /// Length given.
        given: usize,
    },
    /// Too many knots of tables.
    #[error("the tables have more than {most:e} knots between q = {from} and {to}")]
    TooManyKnots {
        /// The limit.
        most: f64,
        /// Start of the interval.
        from: f64,
        /// End of the interval.
        to: f64,
    },
    /// A table does not cover the initial state.
    #[error("a {what} covers {from} to {to}: {q} is not in it")]
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
