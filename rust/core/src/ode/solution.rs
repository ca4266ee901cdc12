//! Result of a run.

use std::fmt;

use super::pair::dense::DenseOutput;

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum End {
    /// At the requested t.
    Reached,
    /// At an event: the last one recorded.
    Event {
        /// Its number.
        index: usize,
        /// Where.
        t: f64,
    },
    /// At the boundary of the domain, to the spacing of t: a dead point.
    DomainBoundary {
        /// The last t inside the domain.
        t: f64,
    },
    /// No step above the spacing of t meets the tolerance beyond this t: a singularity, a jump that
    /// is not among the breaks, or too small a tolerance. Also where both sides of a boundary push
    /// towards it.
    Stalled {
        /// The last t.
        t: f64,
    },
    /// At the limit of attempted steps.
    StepLimit {
        /// Where.
        t: f64,
        /// Whether stability, not accuracy, limited most steps.
        stiff: bool,
    },
    /// The system cancelled the run.
    Cancelled {
        /// Where.
        t: f64,
    },
}

impl fmt::Display for End {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Reached => f.write_str("the end was reached"),
            Self::Event { index, t } => write!(f, "event {index} ended the run at t = {t:e}"),
            Self::DomainBoundary { t } => write!(f, "nothing is there beyond t = {t:e}"),
            Self::Stalled { t } => {
                write!(f, "the tolerance cannot be met beyond t = {t:e} with any step")
            }
            Self::StepLimit { t, stiff: false } => {
                write!(f, "the limit of steps was met at t = {t:e}")
            }
            Self::StepLimit { t, stiff: true } => {
                write!(f, "the limit of steps was met at t = {t:e}: the problem is stiff")
            }
            Self::Cancelled { t } => write!(f, "the run was cancelled at t = {t:e}"),
        }
    }
}

/// Cost of a run.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Statistics {
    /// Steps accepted.
    pub steps: u64,
    /// Steps rejected: too large an error, a state outside the domain, or NaN.
    pub rejected: u64,
    /// Evaluations of the right-hand side.
    pub evaluations: u64,
    /// Restarts at breaks and after events.
    pub restarts: u64,
    /// Steps limited by stability, not by accuracy.
    pub stiff: u64,
    /// Width of the smallest step, not counting steps cut by a break, by the end or by an event.
    pub smallest: Option<f64>,
    /// Width of the largest step.
    pub largest: Option<f64>,
}

impl Statistics {
    /// Counts an accepted step; `cut` if something other than its error limited its width.
    pub(super) fn add_step(&mut self, width: f64, cut: bool, stiff: bool) {
        self.steps += 1;
        self.stiff += u64::from(stiff);
        self.largest = Some(self.largest.map_or(width, |w| w.max(width)));
        if !cut {
            self.smallest = Some(self.smallest.map_or(width, |w| w.min(width)));
        }
    }
}

/// An event that occurred.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// Its number.
    pub index: usize,
    /// Where.
    pub t: f64,
}

/// Result of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// Where it ended.
    pub t: f64,
    /// The state there, including any change by an event that restarts.
    pub y: Vec<f64>,
    /// Why it ended.
    pub end: End,
    /// The events, in order.
    pub events: Vec<Event>,
    /// The states at the events, before they changed anything, one after another.
    pub event_states: Vec<f64>,
    /// The states at the requested t that the run reached, one after another.
    pub samples: Vec<f64>,
    /// Dense output, if requested.
    pub dense: DenseOutput,
    /// Cost of the run.
    pub statistics: Statistics,
}

impl Solution {
    /// The state at the event with this index in [`Solution::events`].
    pub fn event_state(&self, position: usize) -> Option<&[f64]> {
        self.event_states.chunks_exact(self.y.len()).nth(position)
    }
}
