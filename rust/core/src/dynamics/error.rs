//! What can be wrong with a table or what is asked of a flywheel.

use thiserror::Error;

/// Why there is no flywheel.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the sentences say what the fields are")]
pub enum TableError {
    /// Too few rows.
    #[error("the table has {count} rows: at least {least} are needed")]
    TooShort { count: usize, least: usize },
    /// A number that is none.
    #[error("row {row} of the table: {quantity} is {value}, not a finite number")]
    NotFinite { row: usize, quantity: &'static str, value: f64 },
    /// Angles that do not grow.
    #[error("row {row} of the table: phi = {value} rad does not grow beyond {before} before it")]
    NotIncreasing { row: usize, value: f64, before: f64 },
    /// Ends that differ.
    #[error(
        "the table is not periodic: {quantity} is {first} in its first row and {last} in its last, one period on; they must agree"
    )]
    NotPeriodic { quantity: &'static str, first: f64, last: f64 },
    /// An inertia that is not positive.
    #[error(
        "the inertia is {value} kg·m² at phi = {at} rad (of the curve through the table), it must be positive everywhere"
    )]
    NotPositive { value: f64, at: f64 },
    /// A fluctuation beyond (0, 2).
    #[error(
        "fluctuation = {value}: it must be more than 0 and less than 2 (where the least speed is 0)"
    )]
    BadFluctuation { value: f64 },
    /// A speed that is not positive.
    #[error("{name} = {value} rad/s: it must be positive and finite")]
    BadSpeed { name: &'static str, value: f64 },
    /// A flywheel that takes inertia away.
    #[error("flywheel = {value} kg·m²: it must be 0 or more, and finite")]
    BadInertia { value: f64 },
    /// Nothing to be done.
    #[error(
        "the fluctuation is {without} without a flywheel, not more than the {wanted} asked for: none is needed"
    )]
    AlreadyMet { without: f64, wanted: f64 },
    /// It stops on the way.
    #[error(
        "at speed0 = {speed0} rad/s the energy does not suffice beyond phi = {at} rad: {missing} J are missing"
    )]
    Stalls { speed0: f64, at: f64, missing: f64 },
    /// The search for a mean speed did not end.
    #[error("no speed with mean {mean} rad/s was found: the fluctuation is too great for it")]
    NoMean { mean: f64 },
}
