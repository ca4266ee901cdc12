//! Samples of a motion.

use super::variable::Variable;
/// A motion at one time.
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
    /// Work since the start of all that the potential energy does not include, J.
    pub work: f64,
}

/// Samples one after another; with several drivers, drivers fastest.
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
    /// Number of samples.
    #[must_use]
    pub fn len(&self) -> usize {
        self.t.len()
    }

    /// Whether there are no samples.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.t.is_empty()
    }

    /// Number of drivers.
    pub(crate) fn drivers(&self) -> usize {
        self.q.len().checked_div(self.len()).unwrap_or(0)
    }

    /// Coordinates and speeds of a sample.
    pub(crate) fn state(&self, index: usize) -> (&[f64], &[f64]) {
        let range = index * self.drivers()..(index + 1) * self.drivers();
        (&self.q[range.clone()], &self.speed[range])
    }

    /// The sample at an index.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<Sample> {
        let n = self.drivers();
        let row = |all: &[f64]| all.get(index * n..(index + 1) * n).map(<[f64]>::to_vec);
        Some(Sample {
            t: *self.t.get(index)?,
            q: row(&self.q)?,
            speed: row(&self.speed)?,
            acceleration: row(&self.acceleration)?,
            work: *self.work.get(index)?,
        })
    }

    /// The last sample.
    #[must_use]
    pub fn last(&self) -> Option<Sample> {
        self.get(self.len().checked_sub(1)?)
    }

    /// None yet, with room for a number of them.
    pub(crate) fn with_room(count: usize, drivers: usize) -> Self {
        let [t, work] = [0; 2].map(|_| Vec::with_capacity(count));
        let [q, speed, acceleration] = [0; 3].map(|_| Vec::with_capacity(count * drivers));
        Self { t, q, speed, acceleration, work }
    }

    /// Gives back the memory that they do not need.
    pub(crate) fn shrink(&mut self) {
        for numbers in
            [&mut self.t, &mut self.q, &mut self.speed, &mut self.acceleration, &mut self.work]
        {
            numbers.shrink_to_fit();
        }
    }

    /// Appends a sample.
    pub fn push(&mut self, sample: &Sample) {
        self.t.push(sample.t);
        self.q.extend_from_slice(&sample.q);
        self.speed.extend_from_slice(&sample.speed);
        self.acceleration.extend_from_slice(&sample.acceleration);
        self.work.push(sample.work);
    }

    /// Appends the sample of a state and its rates.
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
