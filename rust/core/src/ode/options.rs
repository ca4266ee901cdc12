//! Options of a run.

use super::pair::dop853::DORMAND_PRINCE_853;
use super::pair::tableau::{DORMAND_PRINCE_54, Tableau};
use super::system::Crossing;

/// The Runge-Kutta pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// Order 5(4) of Dormand and Prince: 6 evaluations per step. For tolerances above about 1e-6.
    DormandPrince54,
    /// Order 8(5, 3) of Dormand, Prince and Hairer: 12 evaluations per step, 15 with dense output.
    /// For tight tolerances.
    #[default]
    DormandPrince853,
}

impl Method {
    pub(crate) fn tableau(self) -> &'static Tableau {
        match self {
            Self::DormandPrince54 => &DORMAND_PRINCE_54,
            Self::DormandPrince853 => &DORMAND_PRINCE_853,
        }
    }
}

/// The output of a run besides its last state and its events.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Output<'a> {
    /// Nothing.
    #[default]
    End,
    /// The states at these t, ordered in the direction of the run. Memory does not grow with the
    /// number of steps.
    At(&'a [f64]),
    /// All steps with their dense output: the state at any t.
    Dense,
}

/// Options of a run.
#[derive(Debug, Clone, Copy)]
pub struct Options<'a> {
    /// Relative tolerances r of the error of a step, |eᵢ| ≲ aᵢ + rᵢ|yᵢ| in the mean square: one for
    /// each component, or one for all. Use zero for an angle that counts turns: its magnitude has
    /// no meaning.
    pub relative: &'a [f64],
    /// Absolute tolerances a: one for each component, or one for all. Infinity excludes a component
    /// from error control.
    pub absolute: &'a [f64],
    /// Width of the first step; chosen automatically if `None`.
    pub first_step: Option<f64>,
    /// Greatest width of a step (1 % more at the end of a smooth interval).
    pub max_step: f64,
    /// Greatest change of each of the first components in a step; the other components are not
    /// limited. For events that a wide step would miss.
    pub max_change: &'a [f64],
    /// Limit of attempted steps.
    pub max_steps: u64,
    /// Where the right-hand side is not smooth in t, ascending. Steps end there.
    pub breaks: &'a [f64],
    /// The sign changes of each event function that are events.
    pub events: &'a [Crossing],
    /// The output to store.
    pub output: Output<'a>,
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
            output: Output::End,
        }
    }
}

/// Least relative tolerance. The error estimate is a sum of a dozen terms of the size of a step, so
/// below this it is rounding.
pub const LEAST_RELATIVE: f64 = 10.0 * f64::EPSILON;
