//! Errors of the search for a periodic motion.

use strum::{IntoStaticStr, VariantNames};
use thiserror::Error;

use crate::description::error::{Hint, rounded};
use crate::dynamics::flywheel::flywheel::Mean;
use crate::dynamics::run::error::RunError;
use crate::dynamics::tables::error::short;
use crate::query::failure::GroupName;

/// A mean as Python names it, with its definition.
fn mean_named(mean: Mean) -> &'static str {
    match mean {
        Mean::Extremes => "mean=\"extremes\", half the sum of the extreme speeds",
        Mean::Period => "mean=\"period\", the turn by its time",
    }
}

fn dead_point_of(group: Option<&GroupName>) -> String {
    match group {
        Some(group) => format!("there is a dead point of {group}"),
        None => "there is a dead point, or a load stops the machine,".into(),
    }
}

/// Why no periodic motion was found.
#[derive(Debug, Clone, PartialEq, Error, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "snake_case")]
#[non_exhaustive]
#[expect(missing_docs, reason = "the sentences say what the fields are")]
pub enum SteadyError<E> {
    /// The run over a period failed.
    #[error("{0}")]
    Run(RunError<E>),
    /// Neither motor nor loads set a speed.
    #[error("no initial speed follows from the motor or loads")]
    NeedsSpeed,
    /// The machine stalls within the period.
    #[error("the motor cannot carry the load: even at {} rad/s the machine stalls at q = {}", short(*from), short(*q))]
    Stops { q: f64, from: f64 },
    /// No speed is low enough for the motor to balance the loads.
    #[error("the motor cannot carry the load: no periodic motion was found below {} rad/s, where its moment never makes up for the loads", short(*from))]
    CannotCarry { from: f64 },
    /// The speed grows from period to period, or the work of a period is below the rounding of the
    /// kinetic energy.
    #[error(
        "no periodic motion was found up to {} rad/s: the machine runs away, or it has so much kinetic energy that the work of a period is lost in rounding",
        short(*speed)
    )]
    RunsAway { speed: f64 },
    /// Nothing depends on the speed, and motor and loads are not in balance.
    #[error("nothing depends on the speed, and over a period the motor's mean moment is {} N·m where {} N·m would be in balance: the machine speeds up or stops", short(*motor), short(*needed))]
    Unbalanced { motor: f64, needed: f64 },
    /// No motion has the mean speed.
    #[error(
        "no periodic motion with a mean speed of {} rad/s was found ({}): at this speed the machine stalls within the turn, or its variation is below rounding",
        short(*speed), mean_named(*mean)
    )]
    MeanNotReached { speed: f64, mean: Mean },
    /// A perturbation decays too slowly for the tolerance.
    #[error(
        "the steady speed is poorly determined: a perturbation decays by only {} of itself per period, which this tolerance (rtol) cannot resolve",
        rounded(*part, 2)
    )]
    PoorlyDetermined { part: f64 },
    /// The driver does not turn fully.
    #[error(
        "{} at q = {}: the driver does not turn fully",
        dead_point_of(group.as_ref()), short(*q)
    )]
    DeadPoint { q: f64, group: Option<GroupName> },
    /// Lengths that nearly, but not quite, agree for a change point.
    #[error("dyad {dyad:?} nearly has a change point near q = {}: its lengths miss one by {} m, and the motion turns too sharply there to be integrated", short(*q), rounded(*miss, 2))]
    NearChangePoint { dyad: String, miss: f64, q: f64 },
    /// The motor's table over its speed ends.
    #[error("the motor's table ends at {} rad/s (speed of the driver), which is reached at q = {}", short(*speed), short(*q))]
    MotorTableEnds { q: f64, speed: f64 },
    /// Two periods differ.
    #[error(
        "the motion differs from period to period: the machine is not periodic over this span, or a load depends on the time"
    )]
    NotPeriodic,
    /// The reduced inertia does not repeat after the period.
    #[error(
        "the machine is not periodic over this span: its reduced inertia is {} kg·m² at q = {}, but {} at q = {}",
        short(inertia[0]), short(q[0]), short(inertia[1]), short(q[1])
    )]
    InertiaNotPeriodic { q: [f64; 2], inertia: [f64; 2] },
    /// The machine needs no flywheel.
    #[error("the fluctuation is {} without a flywheel, not more than the {} wanted: none is needed", short(*without), short(*wanted))]
    AlreadyMet { without: f64, wanted: f64 },
    /// No flywheel gives the fluctuation.
    #[error("no flywheel gives a fluctuation of {}", short(*wanted))]
    NoFlywheel { wanted: f64 },
    /// The limit of steps.
    #[error("max_steps was reached at q = {}", short(*q))]
    TooManySteps { q: f64 },
    /// The limit of time.
    #[error("the time limit was reached at q = {} (max_seconds)", short(*q))]
    Cancelled { q: f64 },
    /// The tolerance cannot be met.
    #[error("the tolerance cannot be met with any step at q = {}", short(*q))]
    Stalled { q: f64 },
    /// The driver is a slide, or there are several.
    #[error("a periodic motion needs a single driver that turns")]
    NotRotary,
}

impl<E: std::fmt::Display> Hint for SteadyError<E> {
    fn hint(&self) -> Option<String> {
        let hint = match self {
            Self::Run(error) => return error.hint(),
            Self::NeedsSpeed => "pass speed= (the mean speed, or with dampers a first guess)",
            Self::RunsAway { .. } => {
                "choose a lower speed, a smaller flywheel or a greater fluctuation"
            }
            Self::Unbalanced { .. } => {
                "build the machine without a motor: the balancing moment is then found"
            }
            Self::MeanNotReached { .. } => "add flywheel=, or choose another speed",
            Self::NearChangePoint { .. } => "draw the change point exactly, or lengths clear of it",
            Self::MotorTableEnds { .. } => "extend the table",
            Self::TooManySteps { .. } => {
                "raise max_steps, or loosen rtol: beside change points it may be too tight, or the machine is stiff"
            }
            Self::Stalled { .. } => {
                "loosen rtol; where a load jumps, name the coordinate in breaks="
            }
            Self::InertiaNotPeriodic { .. } => {
                "a motion through change points may take two turns: turns=2"
            }
            _ => return None,
        };
        Some(hint.into())
    }
}
