//! Errors of the search for a periodic motion.

use thiserror::Error;

use crate::dynamics::flywheel::flywheel::Mean;
use crate::dynamics::run::error::RunError;
use crate::dynamics::tables::error::short;

/// A mean as Python names it, with its definition.
fn mean_named(mean: Mean) -> &'static str {
    match mean {
        Mean::Extremes => "mean=\"extremes\", half the sum of the extreme speeds",
        Mean::Period => "mean=\"period\", the turn by its time",
    }
}

/// Why no periodic motion was found.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the sentences say what the fields are")]
pub enum SteadyError<E> {
    #[error("{0}")]
    Run(RunError<E>),
    #[error(
        "no initial speed follows from the motor or loads: pass speed= (the mean speed, or with dampers a first guess)"
    )]
    NeedsSpeed,
    #[error("the motor cannot carry the load: from {} rad/s or less the machine stalls at q = {} rad", short(*from), short(*q))]
    Stops { q: f64, from: f64 },
    #[error("no periodic motion was found below {} rad/s: the motor's moment never makes up for the loads", short(*from))]
    CannotCarry { from: f64 },
    #[error("the machine runs away: the speed still grows over a period begun at {} rad/s", short(*speed))]
    RunsAway { speed: f64 },
    #[error("nothing depends on the speed, and over a period the motor's mean moment is {} N·m where {} N·m would be in balance: the machine speeds up or stops (without a motor the moment is found)", short(*motor), short(*needed))]
    Unbalanced { motor: f64, needed: f64 },
    #[error(
        "no periodic motion with a mean speed of {} rad/s was found ({}): at this speed the machine stalls within the turn (add flywheel=), or its variation is below rounding",
        short(*speed), mean_named(*mean)
    )]
    MeanNotReached { speed: f64, mean: Mean },
    #[error(
        "the steady speed is poorly determined: a perturbation decays by only {} per period, which this tolerance (rtol) cannot resolve",
        short(*part)
    )]
    PoorlyDetermined { part: f64 },
    #[error("there is a dead point at q = {}: the driver does not turn fully", short(*q))]
    DeadPoint { q: f64 },
    #[error("near q = {} the mechanism nearly has a change point: its lengths miss one by {} m at dyad {dyad:?}, and the motion turns there within less than can be integrated; draw the change point exactly, or lengths clear of it", short(*q), short(*miss))]
    NearChangePoint { dyad: String, miss: f64, q: f64 },
    #[error("the motor's table ends at {} rad/s of the driver, met at q = {}", short(*speed), short(*q))]
    MotorTableEnds { q: f64, speed: f64 },
    #[error(
        "the motion differs from period to period: the machine is not periodic over this span, or a load depends on the time"
    )]
    NotPeriodic,
    #[error(
        "the machine is not periodic over this span: its reduced inertia is {} kg·m² at q = {}, but {} at q = {} (a motion through change points may take two turns: turns=2)",
        short(inertia[0]), short(q[0]), short(inertia[1]), short(q[1])
    )]
    InertiaNotPeriodic { q: [f64; 2], inertia: [f64; 2] },
    #[error("the fluctuation is {} without a flywheel, not more than the {} asked for: none is needed", short(*without), short(*wanted))]
    AlreadyMet { without: f64, wanted: f64 },
    #[error("no flywheel gives a fluctuation of {}", short(*wanted))]
    NoFlywheel { wanted: f64 },
    #[error("max_steps was reached at q = {}: beside change points a tolerance may be too tight (rtol), or the machine is stiff", short(*q))]
    TooManySteps { q: f64 },
    #[error("the time limit was reached at q = {}", short(*q))]
    Cancelled { q: f64 },
    #[error("{0}")]
    Other(String),
}
