//! What comes out of a run.

use std::fmt;

use super::dense::DenseOutput;

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum End {
    /// At the t asked for.
    Reached,
    /// At an event: the last one recorded.
    Event {
        /// Its number.
        index: usize,
        /// Where.
        t: f64,
    },
    /// There is nothing beyond this t, to the spacing of t: a dead point.
    DomainBoundary {
        /// The last t that was there.
        t: f64,
    },
    /// The tolerance cannot be met beyond this t with steps above the spacing of t: a singularity,
    /// a jump that is not among the breaks, or a tolerance that is too small. Or both sides of a
    /// border push towards it.
    Stalled {
        /// The last t.
        t: f64,
    },
    /// As many steps as allowed were tried.
    StepLimit {
        /// How far they came.
        t: f64,
        /// Whether most of them were held by stability and not by accuracy.
        stiff: bool,
    },
    /// The system asked for it.
    Cancelled {
        /// How far the run came.
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

/// What a run cost.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Statistics {
    /// Steps taken.
    pub steps: u64,
    /// Steps tried in vain: too large an error, or something on the way not there.
    pub rejected: u64,
    /// Evaluations of the right-hand side.
    pub evaluations: u64,
    /// Breaks met and restarts after events.
    pub restarts: u64,
    /// Steps held by stability and not by accuracy.
    pub stiff: u64,
    /// Width of the smallest step, but those cut by a break, by the end or by an event.
    pub smallest: Option<f64>,
    /// Width of the largest step.
    pub largest: Option<f64>,
}

impl Statistics {
    /// Counts a step that was taken; `cut` if something else than its error made it so narrow.
    pub(super) fn count(&mut self, width: f64, cut: bool, stiff: bool) {
        self.steps += 1;
        self.stiff += u64::from(stiff);
        self.largest = Some(self.largest.map_or(width, |w| w.max(width)));
        if !cut {
            self.smallest = Some(self.smallest.map_or(width, |w| w.min(width)));
        }
    }
}

/// An event that happened.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// Its number.
    pub index: usize,
    /// Where.
    pub t: f64,
}

/// A run.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// Where it ended.
    pub t: f64,
    /// The state there, after what an event that restarts has changed.
    pub y: Vec<f64>,
    /// Why it ended.
    pub end: End,
    /// What happened on the way, in order.
    pub events: Vec<Event>,
    /// The states at the events (before anything was changed), one after another.
    pub event_states: Vec<f64>,
    /// The states at the places asked for, as far as the run came, one after another.
    pub samples: Vec<f64>,
    /// All steps, if asked for.
    pub path: DenseOutput,
    /// What it cost.
    pub statistics: Statistics,
}

impl Solution {
    /// The state at the event of this position in the list.
    pub fn event_state(&self, position: usize) -> Option<&[f64]> {
        self.event_states.chunks_exact(self.y.len()).nth(position)
    }
}
