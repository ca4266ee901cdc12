//! What is asked of a run.

use super::dop853::DORMAND_PRINCE_853;
use super::system::Crossing;
use super::tableau::{DORMAND_PRINCE_54, Tableau};

/// The pair of formulas.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// Dormand & Prince's of order 5(4): 6 evaluations a step, for tolerances above 1e-6 or so.
    DormandPrince54,
    /// Order 8(5, 3) of Dormand, Prince and Hairer: 12 evaluations a step, 15 with its continuous
    /// output. For tight tolerances.
    #[default]
    DormandPrince853,
}

impl Method {
    pub(super) fn tableau(self) -> &'static Tableau {
        match self {
            Self::DormandPrince54 => &DORMAND_PRINCE_54,
            Self::DormandPrince853 => &DORMAND_PRINCE_853,
        }
    }
}

/// What is kept of a run beside its last state and its events.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Output<'a> {
    /// Nothing.
    #[default]
    End,
    /// The states at these t, in the direction of the run. Memory does not grow with the steps.
    At(&'a [f64]),
    /// All steps with their continuous output: the state at any t.
    Path,
}

/// How a run is made.
#[derive(Debug, Clone, Copy)]
pub struct Options<'a> {
    /// Relative tolerances r of the error of a step, |eᵢ| ≲ aᵢ + rᵢ|yᵢ| in the mean square: one for
    /// each component, or one for all. Zero for an angle that counts turns: its size says nothing.
    pub relative: &'a [f64],
    /// Absolute tolerances a: one for each component, or one for all. Infinity leaves a component
    /// out of the control.
    pub absolute: &'a [f64],
    /// Width of the first step; found by itself if not given.
    pub first_step: Option<f64>,
    /// The widest step that may be taken (one hundredth more where a stretch ends).
    pub max_step: f64,
    /// By how much each of the first components may change in a step; of those after them as much as
    /// they like. For events that the state is too smooth to show.
    pub max_change: &'a [f64],
    /// How many steps may be tried.
    pub max_steps: u64,
    /// Where the right-hand side is not smooth in t, ascending. Steps end there.
    pub breaks: &'a [f64],
    /// When each event function makes an event.
    pub events: &'a [Crossing],
    /// What is kept.
    pub keep: Output<'a>,
}

impl Default for Options<'_> {
    fn default() -> Self {
        Self {
            relative: &[1e-10],
            absolute: &[1e-12],
            first_step: None,
            max_step: f64::INFINITY,
            max_change: &[],
            max_steps: 1_000_000,
            breaks: &[],
            events: &[],
            keep: Output::End,
        }
    }
}

/// The least relative tolerance: an estimate of the error cannot be told from rounding below, as
/// it is a sum of a dozen terms of the size of a step.
pub const LEAST_RELATIVE: f64 = 10.0 * f64::EPSILON;
