//! What comes out of a run.

use super::dead_point::Tail;
use super::options::Variable;
use super::sample::{Sample, Samples};
use crate::ode::dense::DenseOutput;
use crate::ode::solution::Statistics;
use crate::state::status::Status;

/// How a run ended.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum StopReason {
    /// Where it was to end.
    Reached,
    /// At an event that ends it: which of the watches.
    Event(usize),
    /// At rest; along the coordinate it cannot go on.
    Rest,
    /// At a dead point, or where the way is not known: why there is nothing, and where that was.
    Edge(Status, Vec<f64>),
    /// Beside a change point that the lengths of a dyad (its inner joint or slide) miss by so much,
    /// m: where they are nearest, the motion turns within less than can be integrated.
    NearChangePoint {
        /// Inner joint or slide of the dyad.
        dyad: String,
        /// By how much its lengths miss, m.
        miss: f64,
        /// Where it is nearest to flat.
        q: f64,
    },
    /// Where a table over the coordinate ends: which.
    TableEnds(usize),
    /// Where the table of a motor ends: which motor.
    MotorTableEnds(usize),
    /// Where the tolerance could not be met with any step.
    Stalled,
    /// After as many steps as were allowed; whether they were held by stability.
    StepLimit(bool),
    /// When its time was over.
    Late,
    /// Because it was asked to.
    Cancelled,
}

/// An event on the way.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Debug, Clone, PartialEq)]
pub struct EventRecord {
    /// Which of the watches.
    pub event: usize,
    /// Time, s.
    pub t: f64,
    /// Coordinates.
    pub q: Vec<f64>,
    /// Speeds.
    pub speed: Vec<f64>,
}

/// A motion of a machine.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// The samples between steps.
    pub samples: Samples,
    /// Kinetic and potential energy there, J.
    pub energies: Vec<[f64; 2]>,
    /// What happened on the way.
    pub events: Vec<EventRecord>,
    /// How it ended.
    pub stop_reason: StopReason,
    /// What it cost.
    pub statistics: Statistics,
    pub(crate) along: Variable,
    pub(crate) sign: f64,
    pub(crate) path: DenseOutput,
    /// The rest of the way to a dead point.
    pub(crate) tail: Option<Tail>,
}

impl Run {
    /// The motion at a time (or a coordinate, if it went along that); none where it was not.
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
        // A run of no length is at its place.
        self.samples.get(0).filter(|sample| match self.along {
            Variable::Time => sample.t == x,
            Variable::Coordinate => sample.q.first() == Some(&x),
        })
    }
}

/// Reads a state and its rates.
pub(crate) fn sample_at(along: Variable, sign: f64, x: f64, y: &[f64], rates: &[f64]) -> Sample {
    let mut samples = Samples::default();
    samples.push_state(along, sign, x, y, rates);
    samples.last().unwrap_or_default()
}
