//! Errors of a run.

use std::fmt;

/// An error of a run; `E` is that of the system.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Error<E> {
    /// A state or a list of tolerances of the wrong length.
    Dimension {
        /// Number of equations.
        expected: usize,
        /// Length given.
        given: usize,
    },
    /// An interval that is not finite.
    Span {
        /// Its start.
        from: f64,
        /// Its end.
        to: f64,
    },
    /// A component of the initial state that is not finite.
    InitialState {
        /// The component.
        component: usize,
        /// Its value.
        value: f64,
    },
    /// Tolerances that are invalid or cannot be met.
    Tolerance {
        /// The component.
        component: usize,
        /// Relative tolerance.
        relative: f64,
        /// Absolute tolerance.
        absolute: f64,
    },
    /// A step width that is not positive.
    StepWidth {
        /// Its value.
        value: f64,
    },
    /// Breaks that do not ascend.
    Breaks {
        /// Index of the first one out of order.
        index: usize,
    },
    /// Output times that are out of order or outside the interval.
    OutputTimes {
        /// Index of the first one.
        index: usize,
    },
    /// Rates or a state that stay NaN or infinite for any step, however small.
    NotFinite {
        /// Where.
        t: f64,
        /// The component.
        component: usize,
    },
    /// The record of the run does not fit in memory.
    OutOfMemory {
        /// The steps that it has taken.
        steps: usize,
    },
    /// An error of the system.
    System(E),
}

impl<E: fmt::Display> fmt::Display for Error<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Dimension { expected, given } => {
                write!(f, "{given} numbers were given for {expected} equations")
            }
            Self::Span { from, to } => {
                write!(f, "the length of the run from {from:e} to {to:e} is not finite")
            }
            Self::InitialState { component, value } => {
                write!(f, "component {component} of the first state is {value}")
            }
            Self::Tolerance { component, relative, absolute } => write!(
                f,
                "tolerances {relative:e} (relative) and {absolute:e} (absolute) of component \
                 {component}: the relative one must be from {:.1e} to below 1, or zero with an \
                 absolute one above zero",
                super::options::LEAST_RELATIVE
            ),
            Self::StepWidth { value } => write!(f, "width {value:e} of a step is not positive"),
            Self::Breaks { index } => write!(f, "breaks do not ascend at entry {index}"),
            Self::OutputTimes { index } => {
                write!(f, "place of output {index} is out of order or outside of the interval")
            }
            Self::NotFinite { t, component } => {
                write!(f, "component {component} or its rate is NaN or infinite at t = {t:e}")
            }
            Self::OutOfMemory { steps } => {
                write!(f, "out of memory: the run has taken {steps} steps, and no more fit")
            }
            Self::System(error) => error.fmt(f),
        }
    }
}

impl<E: std::error::Error + 'static> std::error::Error for Error<E> {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::System(error) => error.source(),
            _ => None,
        }
    }
}
