//! What is asked of a periodic motion.

use std::time::Instant;

use crate::dynamics::flywheel::flywheel::Mean;
use crate::ode::options::Method;

/// What is asked for.
#[derive(Debug, Clone, Copy)]
pub struct SteadyOptions<'a> {
    /// Where the period begins.
    pub q: f64,
    /// Its length, negative if the driver turns backward.
    pub span: f64,
    /// The mean speed, where motors and loads tell none; else a first guess.
    pub speed: Option<f64>,
    /// What that mean is.
    pub mean: Mean,
    /// The pair of formulas.
    pub method: Method,
    /// Relative tolerance.
    pub relative: f64,
    /// How many steps a period may have.
    pub max_steps: u64,
    /// When it must be over.
    pub deadline: Option<Instant>,
    /// Where functions from outside are not smooth, ascending.
    pub breaks: &'a [f64],
    /// Inertia added to the driver's.
    pub flywheel: f64,
}
