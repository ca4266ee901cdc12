//! The result of a run.

use super::dead_point::Tail;
use super::sample::{Sample, Samples};
use super::variable::Variable;
use crate::ode::pair::dense::DenseOutput;
use crate::ode::solution::Statistics;

/// Why a run ended.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum StopReason {
    /// It reached its end.
    Reached,
    /// At an event that stops it: index of the event.
    Event(usize),
    /// At rest; a run along the coordinate cannot go on.
    Rest,
    /// At a dead point: the assembly has no motion beyond it.
    DeadPoint,
    /// Where friction locks the machine while it moves.
    Locked,
    /// Where the branch cannot be tracked: the reason.
    Lost(String),
    /// Beside a near miss of a change point: the lengths of a dyad miss one by `miss`, and the
    /// motion turns there within less than can be integrated.
    NearChangePoint {
        /// Inner joint or slide of the dyad.
        dyad: String,
        /// The amount by which its lengths miss the change point, m.
        miss: f64,
        /// Coordinate where the dyad is nearest to collinear.
        q: f64,
    },
    /// Where a slide whose value is a length is nearly 0: its name.
    ZeroLength(String),
    /// At the end of a table over the coordinate: its index.
    TableEnds(usize),
    /// At the end of a motor's table: index of the motor.
    MotorTableEnds(usize),
    /// The tolerance could not be met at any step size.
    Stalled,
    /// At the step limit; true if stability limited the steps (the machine is stiff).
    StepLimit(bool),
    /// At the time limit.
    TimeLimit,
    /// Cancelled by a callback.
    Cancelled,
}

/// An event that occurred.
#[derive(Debug, Clone, PartialEq)]
pub struct EventRecord {
    /// Index of its `EventSpec`.
    pub event: usize,
    /// Time, s.
    pub t: f64,
    /// Coordinates.
    pub q: Vec<f64>,
    /// Speeds.
    pub speed: Vec<f64>,
}

/// A motion of a machine.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// The samples at the ends of the steps.
    pub samples: Samples,
    /// Kinetic and potential energy of each sample, J.
    pub energies: Vec<[f64; 2]>,
    /// The events that occurred.
    pub events: Vec<EventRecord>,
    /// Why it ended.
    pub stop_reason: StopReason,
    /// Steps and evaluations.
    pub statistics: Statistics,
    pub(crate) along: Variable,
    pub(crate) sign: f64,
    pub(crate) path: DenseOutput,
    /// The last part before a dead point.
    pub(crate) tail: Option<Tail>,
}

impl Run {
    /// The motion at a time (or a coordinate, in a run along it); `None` outside the run.
    #[must_use]
    pub fn at(&self, x: f64) -> Option<Sample> {
        let len = 2 * self.samples.drivers() + 1;
        let (mut y, mut rates) = (vec![0.0; len], vec![0.0; len]);
        if self.path.at(x, &mut y) && self.path.slope(x, &mut rates) {
            return Some(sample_at(self.along, self.sign, x, &y, &rates));
        }
        if let Some(tail) = &self.tail {
            return tail.at(self.along, x);
        }
        // A run of zero length has one sample.
        self.samples.get(0).filter(|sample| match self.along {
            Variable::Time => sample.t == x,
            Variable::Coordinate => sample.q.first() == Some(&x),
        })
    }
}

impl Run {
    /// Keeps the last sample and the events alone.
    pub fn keep_end(&mut self) {
        let mut end = Samples::default();
        if let Some(last) = self.samples.last() {
            end.push(&last);
        }
        self.energies.drain(..self.energies.len().saturating_sub(1));
        (self.samples, self.path, self.tail) = (end, DenseOutput::default(), None);
        self.shrink();
    }

    /// Gives back the memory that it does not need.
    pub fn shrink(&mut self) {
        self.samples.shrink();
        self.energies.shrink_to_fit();
        self.path.shrink();
    }
}

/// The sample of a state and its rates.
pub(crate) fn sample_at(along: Variable, sign: f64, x: f64, y: &[f64], rates: &[f64]) -> Sample {
    let mut samples = Samples::default();
    samples.push_state(along, sign, x, y, rates);
    samples.last().unwrap_or_default()
}
