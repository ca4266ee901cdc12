//! Why a motion cannot go on.

use thiserror::Error;

use crate::dynamics::tables::table::Table;

/// Why a motion could not go on, other than by an end of its own.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RunError<E> {
    /// What a function from outside said.
    #[error("{0}")]
    Callback(E),
    /// There is nothing to be accelerated.
    #[error(
        "the reduced inertia is {value} at q = {q}: it must be positive everywhere (give masses to the links that turn with the driver)"
    )]
    NoInertia {
        /// Where.
        q: f64,
        /// What is there instead.
        value: f64,
    },
    /// There is no position, or no motion, where it begins.
    #[error("there is nothing to begin with at q = {q:?}")]
    NothingThere {
        /// Where.
        q: Vec<f64>,
    },
    /// Not as many numbers as needed.
    #[error("{given} {what} are given: {needed} are needed")]
    Malformed {
        /// Of what.
        what: &'static str,
        /// How many are needed.
        needed: usize,
        /// How many there are.
        given: usize,
    },
    /// Knots of tables without number.
    #[error("the tables have more than {most:e} knots between q = {from} and {to}")]
    ManyKnots {
        /// How many are too many.
        most: f64,
        /// From here.
        from: f64,
        /// To there.
        to: f64,
    },
    /// A table does not cover the beginning.
    #[error("a {what} covers {from} to {to}: {q} is not in it")]
    TableEnds {
        /// What it is a table of.
        what: &'static str,
        /// Its first row.
        from: f64,
        /// Its last.
        to: f64,
        /// What was asked of it.
        q: f64,
    },
}

/// A table does not go so far.
pub(crate) fn outside_table<E>(what: &'static str, table: &Table, q: f64) -> RunError<E> {
    let [from, to] = table.range();
    RunError::TableEnds { what, from, to, q }
}

/// Refuses what has not as many numbers as needed.
pub(crate) fn check_counts<E>(counts: &[(&'static str, usize, usize)]) -> Result<(), RunError<E>> {
    match counts.iter().find(|(_, needed, given)| needed != given) {
        Some(&(what, needed, given)) => Err(RunError::Malformed { what, needed, given }),
        None => Ok(()),
    }
}
