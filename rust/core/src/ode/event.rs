//! Events of a step: which event functions change sign, and between which samples.

use super::system::Crossing;
use crate::math::root::double_root::find_double_root;
use crate::math::root::itp::itp;

/// Where event functions are sampled, as fractions of a step: near both ends, so that the slope
/// shows a minimum just inside, and often enough that two roots between samples are rare for a
/// polynomial of this degree.
pub(super) const SAMPLES: [f64; 6] = [1.0 / 64.0, 0.25, 0.5, 0.75, 63.0 / 64.0, 1.0];

/// Limit of halvings of an interval in search of a point near its start with another sign.
const MAX_HALVINGS: u32 = 20;

/// Fraction of the change of a function over an interval above which a change is not rounding.
const SIGNIFICANT: f64 = 1e-8;

/// Signs of the event functions as a run proceeds.
#[derive(Debug, Default)]
pub(super) struct EventTracker {
    crossings: Vec<Crossing>,
    /// Sign of each function after the last sample passed; 0 where it has none yet.
    signs: Vec<i8>,
    /// Whether each event occurred at the t where the run restarts.
    pub fired: Vec<bool>,
    /// Samples θ of the step, from 0 to 1, and the values there, one row each.
    thetas: Vec<f64>,
    values: Vec<f64>,
    /// Greatest |value| of each function over the last step.
    magnitudes: Vec<f64>,
    /// Values at the point evaluated last.
    pub current: Vec<f64>,
    /// Events between two samples: θ and the function.
    pub detected: Vec<(f64, usize)>,
}

fn sign(value: f64) -> Option<i8> {
    match value.partial_cmp(&0.0)? {
        std::cmp::Ordering::Less => Some(-1),
        std::cmp::Ordering::Equal => Some(0),
        std::cmp::Ordering::Greater => Some(1),
    }
}

impl EventTracker {
    /// Prepares for a new run.
    pub(super) fn reset(&mut self, crossings: &[Crossing]) {
        let count = crossings.len();
        self.crossings.clear();
        self.crossings.extend_from_slice(crossings);
        self.signs.clear();
        self.signs.resize(count, 0);
        self.fired.clear();
        self.fired.resize(count, false);
        self.magnitudes.clear();
        self.magnitudes.resize(count, 0.0);
        self.current.clear();
        self.current.resize(count, f64::NAN);
        self.thetas.clear();
        self.thetas.push(0.0);
        self.values.clear();
        self.values.resize(count, f64::NAN);
        // About one more sample for each function with a dip.
        self.thetas.reserve(SAMPLES.len() + count);
        self.values.reserve((SAMPLES.len() + count) * count);
        self.detected.reserve(count);
    }

    /// Number of event functions.
    pub(super) fn len(&self) -> usize {
        self.crossings.len()
    }

    /// Row for the values at the current t of the run.
    pub(super) fn start_values(&mut self) -> &mut [f64] {
        let count = self.len();
        self.thetas.truncate(1);
        self.values.truncate(count);
        &mut self.values
    }

    /// Takes the signs at the start of a run or at a restart after an event. Rounding must not
    /// repeat an event that has just occurred, and a change made by the event is not a crossing.
    pub(super) fn reset_signs(&mut self) {
        for j in 0..self.len() {
            let value = self.values[j];
            let same = value.to_bits() == self.current[j].to_bits();
            // The run leaves a boundary at once, to either side; any other function at zero has just had its
            // event.
            let on_zero = !self.is_boundary(j) && value.abs() <= SIGNIFICANT * self.magnitudes[j];
            let just_fired = self.fired[j] && (same || on_zero);
            self.signs[j] = match (self.crossings[j], just_fired) {
                (Crossing::Boundary, false) => 1,
                (Crossing::Boundary, true) => -1,
                (_, false) => sign(value).unwrap_or(0),
                (_, true) => 0,
            };
            self.fired[j] = false;
        }
    }

    /// Whether a function is the boundary of a piece.
    pub(super) fn is_boundary(&self, j: usize) -> bool {
        self.crossings[j] == Crossing::Boundary
    }

    /// Whether a change of a function to a value is an event.
    pub(super) fn is_event(&self, j: usize, value: f64) -> bool {
        let Some(new) = sign(value) else { return false };
        let old = self.signs[j];
        match self.crossings[j] {
            Crossing::Rising => old < 0 && new >= 0,
            Crossing::Falling => old > 0 && new <= 0,
            Crossing::Either => old != 0 && new != old,
            Crossing::Boundary => old >= 0 && new < 0,
        }
    }

    /// Samples all functions over a step; `f` writes their values at θ.
    pub(super) fn sample<E>(
        &mut self,
        mut f: impl FnMut(f64, &mut [f64]) -> Result<(), E>,
    ) -> Result<(), E> {
        let count = self.len();
        self.thetas.truncate(1);
        self.values.truncate(count);
        for theta in SAMPLES {
            self.thetas.push(theta);
            let at = self.values.len();
            self.values.resize(at + count, f64::NAN);
            f(theta, &mut self.values[at..])?;
        }
        for j in 0..count {
            let values = self.values.iter().skip(j).step_by(count);
            self.magnitudes[j] = values.fold(0.0, |greatest, value| greatest.max(value.abs()));
            let mut c = 1;
            while c + 1 < self.thetas.len() {
                if let Some(theta) = self.find_dip(j, c, &mut f)? {
                    f(theta, &mut self.current)?;
                    let index = usize::from(theta > self.thetas[c]) + c;
                    self.insert(index, theta);
                    c += 1;
                }
                c += 1;
            }
        }
        Ok(())
    }

    /// Finds a point beyond zero between samples of one sign, if the function dips there.
    fn find_dip<E>(
        &mut self,
        j: usize,
        c: usize,
        f: &mut impl FnMut(f64, &mut [f64]) -> Result<(), E>,
    ) -> Result<Option<f64>, E> {
        let side = self.value(c, j).signum();
        let at = |i: usize| (self.thetas[i], side * self.value(i, j));
        let (a, m, b) = (at(c - 1), at(c), at(c + 1));
        if !(m.1 > 0.0 && a.1 >= m.1 && b.1 >= m.1) || (a.1 == m.1 && b.1 == m.1) {
            return Ok(None);
        }
        let values = &mut self.current;
        find_double_root(a, m, b, |theta| f(theta, values).map(|()| side * values[j]))
    }

    /// Inserts a sample, whose values are in `current`.
    fn insert(&mut self, at: usize, theta: f64) {
        let count = self.len();
        self.thetas.insert(at, theta);
        self.values.extend_from_slice(&self.current);
        self.values[at * count..].rotate_right(count);
    }

    fn value(&self, sample: usize, j: usize) -> f64 {
        self.values[sample * self.len() + j]
    }

    /// Number of intervals between samples.
    pub(super) fn intervals(&self) -> usize {
        self.thetas.len() - 1
    }

    /// Finds the events in an interval: `detected`, in order.
    pub(super) fn find_events<E>(
        &mut self,
        interval: usize,
        width: f64,
        mut f: impl FnMut(f64, &mut [f64]) -> Result<(), E>,
    ) -> Result<(), E> {
        self.detected.clear();
        for j in 0..self.len() {
            let from = self.start_of_sign(j, interval, &mut f)?;
            if self.is_event(j, self.value(interval + 1, j)) {
                let theta = self.locate(j, from, interval + 1, width, &mut f)?;
                self.detected.push((theta, j));
            }
        }
        self.detected.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        Ok(())
    }

    /// A function that starts from zero has no sign to change. This searches just after the start
    /// of an interval for a sign opposite to that of the end, as for a ball that has bounced and
    /// falls again. Returns a point where the function has its sign.
    fn start_of_sign<E>(
        &mut self,
        j: usize,
        interval: usize,
        f: &mut impl FnMut(f64, &mut [f64]) -> Result<(), E>,
    ) -> Result<(f64, f64), E> {
        let start = (self.thetas[interval], self.value(interval, j));
        let end = (self.thetas[interval + 1], self.value(interval + 1, j));
        let outside = self.crossings[j] == Crossing::Boundary && self.signs[j] < 0;
        if !(outside && end.1 < 0.0 || self.signs[j] == 0 && end.1 != 0.0) {
            return Ok(start);
        }
        let mut width = end.0 - start.0;
        for _ in 0..MAX_HALVINGS {
            width *= 0.5;
            let theta = start.0 + width;
            f(theta, &mut self.current)?;
            let value = self.current[j];
            let significant = (value - start.1).abs() > SIGNIFICANT * (end.1 - start.1).abs();
            if value * end.1.signum() < 0.0 && significant {
                self.signs[j] = sign(value).unwrap_or(0);
                return Ok((theta, value));
            }
        }
        Ok(start)
    }

    /// Locates the sign change between `from` and sample `to`.
    fn locate<E>(
        &mut self,
        j: usize,
        from: (f64, f64),
        to: usize,
        width: f64,
        f: &mut impl FnMut(f64, &mut [f64]) -> Result<(), E>,
    ) -> Result<f64, E> {
        let strict = self.crossings[j] == Crossing::Boundary;
        let side = if strict { 1.0 } else { f64::from(self.signs[j]) };
        let far = |value: f64| if strict { value < 0.0 } else { value <= 0.0 };
        let mut a = (from.0, side * from.1);
        let mut b = (self.thetas[to], side * self.value(to, j));
        let values = &mut self.current;
        let mut g = |theta: f64| f(theta, values).map(|()| side * values[j]);
        // A start on the boundary itself or on the other side of a break: find a point inside. (Not
        // `math::root`'s bisection: it rounds the middle otherwise and goes on inside.)
        let mut halvings = MAX_HALVINGS;
        while a.1 <= 0.0 && halvings > 0 {
            halvings -= 1;
            let theta = a.0 + 0.5 * (b.0 - a.0);
            let value = g(theta)?;
            *(if value > 0.0 { &mut a } else { &mut b }) = (theta, value);
        }
        if a.1 <= 0.0 { Ok(a.0) } else { itp(a, b, width, far, g) }
    }

    /// Flips the sign of a function after its event inside a step.
    pub(super) fn pass_event(&mut self, j: usize) {
        self.signs[j] = match self.crossings[j] {
            Crossing::Rising => 1,
            Crossing::Either => -self.signs[j],
            Crossing::Falling | Crossing::Boundary => -1,
        };
    }

    /// Takes the signs at the end of an interval that the run has passed.
    pub(super) fn pass_interval(&mut self, interval: usize) {
        for j in 0..self.len() {
            if let Some(new) = sign(self.value(interval + 1, j)) {
                self.signs[j] = new;
            }
        }
    }

    /// Sign of the first function after the last sample passed, and its value there; 0 without a sign or
    /// functions.
    pub(super) fn first(&self) -> (f64, f64) {
        match (self.signs.first(), self.values.first()) {
            (Some(&sign), Some(&value)) => (f64::from(sign), value),
            _ => (0.0, 0.0),
        }
    }

    /// Passes a step over which the only function keeps its sign, to its value at the end.
    pub(super) fn pass_step(&mut self, end: f64, magnitude: f64) {
        (self.values[0], self.magnitudes[0]) = (end, magnitude);
    }

    /// Makes the end of the step the start of the next.
    pub(super) fn next_step(&mut self) {
        let count = self.len();
        let last = self.values.len() - count;
        self.values.copy_within(last.., 0);
        self.thetas.truncate(1);
        self.values.truncate(count);
    }
}
