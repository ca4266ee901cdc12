//! Options of the search for a periodic motion.

use std::time::Instant;

use crate::dynamics::flywheel::flywheel::Mean;
use crate::ode::options::Method;

/// Options of the search for a periodic motion.
#[derive(Debug, Clone, Copy)]
pub struct SteadyOptions<'a> {
    /// Coordinate at the start of the period, rad.
    pub q: f64,
    /// Length of the period, rad; negative if the driver turns backward.
    pub span: f64,
    /// The mean speed, if motors and loads leave it open; otherwise a first guess.
    pub speed: Option<f64>,
    /// Definition of the mean speed.
    pub mean: Mean,
    /// Runge-Kutta method.
    pub method: Method,
    /// Relative tolerance.
    pub relative: f64,
    /// Largest number of steps in a period.
    pub max_steps: u64,
    /// Time limit.
    pub deadline: Option<Instant>,
    /// Coordinates where callbacks are not smooth, ascending.
    pub breaks: &'a [f64],
    /// Inertia added to the driver's.
    pub flywheel: f64,
}
