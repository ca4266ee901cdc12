//! What comes out of a run.

use super::tail::Tail;
use super::task::Along;
use crate::motion::Status;
use crate::ode::{Path, Statistics};

/// How a run ended.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Ending {
    /// Where it was to end.
    Reached,
    /// At an event that ends it: which of the watches.
    Event(usize),
    /// At rest; along the coordinate it cannot go on.
    Rest,
    /// At a dead point, or where the way is not known: why there is nothing, and where that was.
    Edge(Status, Vec<f64>),
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
#[derive(Debug, Clone, PartialEq)]
pub struct Happened {
    /// Which of the watches.
    pub watch: usize,
    /// Time, s.
    pub t: f64,
    /// Coordinates.
    pub q: Vec<f64>,
    /// Speeds.
    pub speed: Vec<f64>,
}

/// One moment of a motion.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Moment {
    /// Time, s.
    pub t: f64,
    /// Coordinates.
    pub q: Vec<f64>,
    /// Speeds.
    pub speed: Vec<f64>,
    /// Accelerations.
    pub acceleration: Vec<f64>,
    /// Work done so far by all that is not told by the potential energy, J.
    pub work: f64,
}

/// A motion of a machine.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// The moments between steps.
    pub moments: Vec<Moment>,
    /// Kinetic and potential energy there, J.
    pub energies: Vec<[f64; 2]>,
    /// What happened on the way.
    pub events: Vec<Happened>,
    /// How it ended.
    pub ending: Ending,
    /// What it cost.
    pub statistics: Statistics,
    pub(super) along: Along,
    pub(super) sign: f64,
    pub(super) path: Path,
    /// The rest of the way to a dead point.
    pub(super) tail: Option<Tail>,
}

impl Run {
    /// The motion at a time (or a coordinate, if it went along that); none where it was not.
    #[must_use]
    pub fn at(&self, x: f64) -> Option<Moment> {
        let drivers = self.moments.first()?.q.len();
        let len = 2 * drivers + 1;
        let (mut y, mut rates) = (vec![0.0; len], vec![0.0; len]);
        let there = self.path.at(x, &mut y) && self.path.slope(x, &mut rates);
        if there {
            return Some(moment(self.along, self.sign, x, &y, &rates));
        }
        self.tail.as_ref().and_then(|tail| tail.at(self.along, x))
    }
}

/// Reads a state and its rates.
pub(super) fn moment(along: Along, sign: f64, x: f64, y: &[f64], rates: &[f64]) -> Moment {
    let n = y.len() / 2;
    match along {
        Along::Time => Moment {
            t: x,
            q: y[..n].to_vec(),
            speed: y[n..2 * n].to_vec(),
            acceleration: rates[n..2 * n].to_vec(),
            work: y[2 * n],
        },
        Along::Coordinate => Moment {
            t: y[1],
            q: vec![x],
            speed: vec![sign * y[0].max(0.0).sqrt()],
            acceleration: vec![0.5 * rates[0]],
            work: y[2],
        },
    }
}
