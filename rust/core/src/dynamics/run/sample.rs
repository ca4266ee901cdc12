//! A motion at one time, and at many.

use super::options::Variable;
/// One moment of a motion.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sample {
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

/// Many of them, one after another (of several drivers the drivers fastest).
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Samples {
    /// Times, s.
    pub t: Vec<f64>,
    /// Coordinates.
    pub q: Vec<f64>,
    /// Speeds.
    pub speed: Vec<f64>,
    /// Accelerations.
    pub acceleration: Vec<f64>,
    /// Work done, J.
    pub work: Vec<f64>,
}

impl Samples {
    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.t.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.t.is_empty()
    }

    /// How many drivers there are.
    pub(crate) fn drivers(&self) -> usize {
        self.q.len().checked_div(self.len()).unwrap_or(0)
    }

    /// Coordinates and speeds of one.
    pub(crate) fn state(&self, index: usize) -> (&[f64], &[f64]) {
        let own = index * self.drivers()..(index + 1) * self.drivers();
        (&self.q[own.clone()], &self.speed[own])
    }

    /// One of them.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<Sample> {
        let n = self.drivers();
        let own = |all: &[f64]| all.get(index * n..(index + 1) * n).map(<[f64]>::to_vec);
        Some(Sample {
            t: *self.t.get(index)?,
            q: own(&self.q)?,
            speed: own(&self.speed)?,
            acceleration: own(&self.acceleration)?,
            work: *self.work.get(index)?,
        })
    }

    /// The last of them.
    #[must_use]
    pub fn last(&self) -> Option<Sample> {
        self.get(self.len().checked_sub(1)?)
    }

    /// Adds one.
    pub fn push(&mut self, sample: &Sample) {
        self.t.push(sample.t);
        self.q.extend_from_slice(&sample.q);
        self.speed.extend_from_slice(&sample.speed);
        self.acceleration.extend_from_slice(&sample.acceleration);
        self.work.push(sample.work);
    }

    /// Adds what a state and its rates tell.
    pub(crate) fn push_state(
        &mut self,
        along: Variable,
        sign: f64,
        x: f64,
        y: &[f64],
        rates: &[f64],
    ) {
        let n = y.len() / 2;
        match along {
            Variable::Time => {
                self.t.push(x);
                self.q.extend_from_slice(&y[..n]);
                self.speed.extend_from_slice(&y[n..2 * n]);
                self.acceleration.extend_from_slice(&rates[n..2 * n]);
                self.work.push(y[2 * n]);
            }
            Variable::Coordinate => {
                self.t.push(y[1]);
                self.q.push(x);
                self.speed.push(sign * y[0].max(0.0).sqrt());
                self.acceleration.push(0.5 * rates[0]);
                self.work.push(y[2]);
            }
        }
    }
}
