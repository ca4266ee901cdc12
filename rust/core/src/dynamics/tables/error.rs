//! Errors of tables and of flywheel sizing.

use strum::{IntoStaticStr, VariantNames};
use thiserror::Error;

/// Formats a number with six digits, for messages.
pub(crate) fn short(value: f64) -> String {
    if value == 0.0 || !(1e-4..1e6).contains(&value.abs()) {
        return if value == 0.0 { "0".into() } else { format!("{value:.5e}") };
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 9")]
    let places = (5.0 - libm::log10(value.abs()).floor()).max(0.0) as usize;
    let text = format!("{value:.places$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
}

/// Formats a number with all its digits, but not with long runs of zeros.
fn full(value: f64) -> String {
    if value == 0.0 || (1e-6..1e16).contains(&value.abs()) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

/// Why a table is invalid or gives no flywheel.
#[derive(Debug, Clone, Copy, PartialEq, Error, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "snake_case")]
#[non_exhaustive]
#[expect(missing_docs, reason = "the sentences say what the fields are")]
pub enum TableError {
    /// Too few rows.
    #[error("the table has {count} rows: at least {least} are needed")]
    TooShort { count: usize, least: usize },
    /// Columns of different lengths.
    #[error("the table has {given} rows of {quantity} and {needed} of phi: as many are needed")]
    Unequal { quantity: &'static str, given: usize, needed: usize },
    /// A number that is not finite.
    #[error("row {row} of the table: {quantity} is {value}, not a finite number")]
    NotFinite { row: usize, quantity: &'static str, value: f64 },
    /// Coordinates that do not increase.
    #[error("row {row} of the table: phi = {value} rad does not grow beyond {before} before it")]
    NotIncreasing { row: usize, value: f64, before: f64 },
    /// Ends that differ in a periodic table.
    #[error(
        "the table is not periodic: {quantity} is {} in its first row and {} in its last, one period on; they must agree", full(*first), full(*last)
    )]
    NotPeriodic { quantity: &'static str, first: f64, last: f64 },
    /// A negative inertia.
    #[error(
        "the inertia is {value} kg·m² at phi = {at} rad (of the curve through the table), it must not be negative: between rows of zero only spline=\"linear\" keeps it so"
    )]
    Negative { value: f64, at: f64 },
    /// No positive inertia, even with the flywheel.
    #[error(
        "the inertia is {} kg·m² at phi = {at} rad with a flywheel of {flywheel} kg·m²: it must be positive, so give the machine an inertia or a greater flywheel", short(*value)
    )]
    NoInertia { flywheel: f64, value: f64, at: f64 },
    /// A fluctuation outside (0, 2).
    #[error(
        "fluctuation = {value}: it must be more than 0 and less than 2 (where the least speed is 0)"
    )]
    BadFluctuation { value: f64 },
    /// A speed that is not positive.
    #[error("{name} = {value} rad/s: it must be positive and finite")]
    BadSpeed { name: &'static str, value: f64 },
    /// A negative or infinite flywheel.
    #[error("flywheel = {value} kg·m²: it must be 0 or more, and finite")]
    BadInertia { value: f64 },
    /// The machine needs no flywheel.
    #[error(
        "the fluctuation is {} without a flywheel, not more than the {wanted} asked for: none is needed", short(*without)
    )]
    AlreadyMet { without: f64, wanted: f64 },
    /// The machine stops within the cycle.
    #[error(
        "at speed0 = {speed0} rad/s the machine stalls at phi = {at} rad: it lacks {missing} J"
    )]
    Stalls { speed0: f64, at: f64, missing: f64 },
    /// Energies beyond the range of numbers.
    #[error(
        "the energy of the turn is infinite at {name} = {} rad/s with a flywheel of {} kg·m²: one of them, an inertia or a moment is too great", short(*speed), short(*flywheel)
    )]
    Infinite { name: &'static str, speed: f64, flywheel: f64 },
    /// No speed has this mean.
    #[error("no speed with mean {} rad/s was found: the fluctuation is too great for it, or the mean itself is", short(*mean))]
    NoMean { mean: f64 },
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn six_digits() {
        let shown =
            [0.0, 80.0, 28.448_695_02, -0.000_123_456_78, 1.5e9, 2.0e-7, f64::NAN].map(short);
        assert_eq!(shown, ["0", "80", "28.4487", "-0.000123457", "1.50000e9", "2.00000e-7", "NaN"]);
    }
}
