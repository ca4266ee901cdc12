//! The options that runs have in common.

use std::time::{Duration, Instant};

use assur::dynamics::{RunOptions, Variable};
use assur::ode::Method;

/// The relative tolerance, and absolute ones.
pub(crate) type Tolerances = (f64, Option<[f64; 2]>);

/// The options of a run from a time, over the time or with `along_q` over the coordinate, still without
/// its states, end, events and deadline. `limits`: the widest step, and the most steps.
pub(crate) fn options(
    along_q: bool,
    t: f64,
    method: Method,
    (relative, absolute): Tolerances,
    (max_step, max_steps): (f64, u64),
    breaks: &[f64],
) -> RunOptions<'_> {
    RunOptions {
        along: if along_q { Variable::Coordinate } else { Variable::Time },
        t,
        q: &[],
        speed: &[],
        end: 0.0,
        method,
        relative,
        absolute,
        max_step,
        max_steps,
        deadline: None,
        breaks,
        events: &[],
        flywheel: 0.0,
    }
}

/// When a number of seconds from now is over; `None` for no limit, or none that a clock can tell.
pub(crate) fn deadline(seconds: Option<f64>) -> Option<Instant> {
    let duration = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok())?;
    Instant::now().checked_add(duration)
}
