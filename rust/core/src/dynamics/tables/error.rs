//! Errors of tables and of flywheel sizing.

use strum::{IntoStaticStr, VariantNames};
use thiserror::Error;

use crate::description::error::{Hint, number, rounded};

/// Formats a number with six digits, for messages.
pub(crate) fn short(value: f64) -> String {
    rounded(value, 6)
}

/// Why a table is invalid or gives no flywheel.
#[derive(Debug, Clone, Copy, PartialEq, Error, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "snake_case")]
#[non_exhaustive]
#[expect(missing_docs, reason = "the sentences say what the fields are")]
pub enum TableError {
    /// Too few rows.
    #[error("the table has {count} row{}: at least {least} are needed", if *count == 1 { "" } else { "s" })]
    TooShort { count: usize, least: usize },
    /// Columns of different lengths.
    #[error("the table has {given} rows of {quantity} and {needed} of phi: as many are needed")]
    Unequal { quantity: &'static str, given: usize, needed: usize },
    /// A number that is not finite.
    #[error("row {row} of the table: {quantity} is {value}, not a finite number")]
    NotFinite { row: usize, quantity: &'static str, value: f64 },
    /// Coordinates that do not increase.
    #[error(
        "row {row} of the table: phi goes from {} to {} rad, but must increase", short(*before), short(*value)
    )]
    NotIncreasing { row: usize, value: f64, before: f64 },
    /// More than two values at one coordinate.
    #[error(
        "the table has {} three times: two rows there are a jump, from the value before to the one behind", number(*at)
    )]
    Tripled { at: f64 },
    /// A jump where nothing is on one side.
    #[error("the table jumps at its end, {}, and is not periodic: nothing is beyond", number(*at))]
    JumpAtEnd { at: f64 },
    /// A jump in a spline whose derivatives agree at its ends.
    #[error(
        "the table jumps at {}: spline=\"periodic\" is one curve without jumps", number(*at)
    )]
    PeriodicJump { at: f64 },
    /// Ends that differ in a periodic table.
    #[error(
        "the table is not periodic: {quantity} is {} in its first row and {} in its last, one period on; they must agree", number(*first), number(*last)
    )]
    NotPeriodic { quantity: &'static str, first: f64, last: f64 },
    /// An inertia with two values at one coordinate.
    #[error(
        "the inertia jumps from {} to {} kg·m² at phi = {} rad: only the moment may",
        short(*before), short(*behind), short(*at)
    )]
    InertiaJumps { at: f64, before: f64, behind: f64 },
    /// A negative inertia.
    #[error(
        "the inertia is {} kg·m² at phi = {} rad{}: it must not be negative",
        short(*value), short(*at), if *in_row { "" } else { ", on the curve between the rows" }
    )]
    Negative { value: f64, at: f64, in_row: bool },
    /// No positive inertia, even with the flywheel.
    #[error(
        "the inertia is {} kg·m² at phi = {} rad with a flywheel of {} kg·m²: it must be positive",
        short(*value), short(*at), short(*flywheel)
    )]
    NoInertia { flywheel: f64, value: f64, at: f64 },
    /// A fluctuation outside (0, 2).
    #[error(
        "fluctuation = {}: it must be more than 0 and less than 2 (where the least speed is 0)", number(*value)
    )]
    BadFluctuation { value: f64 },
    /// A speed that is not positive.
    #[error("{name} = {} rad/s: it must be positive and finite", number(*value))]
    BadSpeed { name: &'static str, value: f64 },
    /// A negative or infinite flywheel.
    #[error("flywheel = {} kg·m²: it must be 0 or more, and finite", number(*value))]
    BadInertia { value: f64 },
    /// The machine needs no flywheel.
    #[error(
        "the fluctuation is {} without a flywheel, not more than the {} wanted: none is needed",
        short(*without), number(*wanted)
    )]
    AlreadyMet { without: f64, wanted: f64 },
    /// The flywheel for the fluctuation is infinite.
    #[error("no finite flywheel gives a fluctuation of {}", number(*wanted))]
    NoFlywheel { wanted: f64 },
    /// The machine stops within the cycle.
    #[error(
        "at speed0 = {} rad/s the machine stalls at phi = {} rad: it lacks {} J",
        number(*speed0), short(*at), short(*missing)
    )]
    Stalls { speed0: f64, at: f64, missing: f64 },
    /// Energies beyond the range of numbers.
    #[error(
        "the energy of the turn is infinite at {name} = {} rad/s with a flywheel of {} kg·m²: one of them, an inertia or a moment is too great",
        short(*speed), short(*flywheel)
    )]
    Infinite { name: &'static str, speed: f64, flywheel: f64 },
    /// No speed has this mean.
    #[error(
        "no motion with a mean speed of {} rad/s was found: at low speeds the machine stalls within the turn, at very high ones its energy is infinite",
        short(*mean)
    )]
    NoMean { mean: f64 },
}

impl Hint for TableError {
    fn hint(&self) -> Option<String> {
        let hint = match self {
            Self::PeriodicJump { .. } => {
                "choose \"pchip\", \"linear\", \"not-a-knot\", \"natural\" or \"clamped\""
            }
            Self::InertiaJumps { .. } => "give both rows there one inertia",
            Self::JumpAtEnd { .. } => "leave one of the two rows out",
            Self::Negative { in_row: false, .. } => {
                "spline=\"pchip\" or spline=\"linear\" stays between the rows"
            }
            Self::NoInertia { .. } => "give the machine an inertia or a greater flywheel",
            Self::Stalls { .. } => "start faster, or add a flywheel",
            Self::NoMean { .. } => "choose another speed, or a greater flywheel",
            _ => return None,
        };
        Some(hint.into())
    }
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn six_digits() {
        let shown =
            [0.0, 80.0, 28.448_695_02, -0.000_123_456_78, 1.5e9, 2.0e-7, f64::NAN].map(short);
        assert_eq!(shown, ["0", "80", "28.4487", "-0.000123457", "1.5e9", "2e-7", "NaN"]);
    }
}
