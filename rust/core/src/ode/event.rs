//! Events of a step: which event functions change their signs, and between which places.

use super::root::{change_of_sign, dip};
use super::system::Crossing;

/// Where event functions are looked at, as parts of a step: near both ends (so that a minimum just
/// inside is seen by the slope) and so often that a pair of zeros between is a rare thing for a
/// polynomial of this degree.
const CHECKS: [f64; 6] = [1.0 / 64.0, 0.25, 0.5, 0.75, 63.0 / 64.0, 1.0];

/// How often an interval is halved in search of a place near its start with another sign.
const HALVINGS: u32 = 20;

/// Part of the change of a function over an interval that is no rounding.
const SEEN: f64 = 1e-8;

/// Signs of event functions, as far as a run has come.
#[derive(Debug, Default)]
pub(super) struct EventTracker {
    crossings: Vec<Crossing>,
    /// Sign of each function behind the last place looked at; 0 where it has none yet.
    signs: Vec<i8>,
    /// Whether it has happened at the place where the run starts again.
    pub fired: Vec<bool>,
    /// Parts of the step, from 0 to 1, and the values there, one row each.
    places: Vec<f64>,
    values: Vec<f64>,
    /// The greatest value of each function over the last step.
    sizes: Vec<f64>,
    /// Values at the place of the event last looked at.
    pub here: Vec<f64>,
    /// Changes of sign between two places: part of the step, and which function.
    pub found: Vec<(f64, usize)>,
}

fn sign(value: f64) -> Option<i8> {
    match value.partial_cmp(&0.0)? {
        std::cmp::Ordering::Less => Some(-1),
        std::cmp::Ordering::Equal => Some(0),
        std::cmp::Ordering::Greater => Some(1),
    }
}

impl EventTracker {
    /// For a new run.
    pub(super) fn reset(&mut self, crossings: &[Crossing]) {
        let count = crossings.len();
        self.crossings.clear();
        self.crossings.extend_from_slice(crossings);
        self.signs.clear();
        self.signs.resize(count, 0);
        self.fired.clear();
        self.fired.resize(count, false);
        self.sizes.clear();
        self.sizes.resize(count, 0.0);
        self.here.clear();
        self.here.resize(count, f64::NAN);
        self.places.clear();
        self.places.push(0.0);
        self.values.clear();
        self.values.resize(count, f64::NAN);
        // One place more for each function that dips, about.
        self.places.reserve(CHECKS.len() + count);
        self.values.reserve((CHECKS.len() + count) * count);
        self.found.reserve(count);
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.crossings.len()
    }

    /// Values where the run stands.
    pub(super) fn start_values(&mut self) -> &mut [f64] {
        let count = self.len();
        self.places.truncate(1);
        self.values.truncate(count);
        &mut self.values
    }

    /// The run begins, or begins again after an event: what has just happened must not happen
    /// again by its rounding, and what the event has changed is no crossing.
    pub(super) fn begin(&mut self) {
        for j in 0..self.len() {
            let value = self.values[j];
            let same = value.to_bits() == self.here[j].to_bits();
            // A border is left at once, on whichever side; what else is on zero has just happened.
            let on_zero = !self.is_border(j) && value.abs() <= SEEN * self.sizes[j];
            let again = self.fired[j] && (same || on_zero);
            self.signs[j] = match (self.crossings[j], again) {
                (Crossing::Boundary, false) => 1,
                (Crossing::Boundary, true) => -1,
                (_, false) => sign(value).unwrap_or(0),
                (_, true) => 0,
            };
            self.fired[j] = false;
        }
    }

    /// Whether a function is the border of a piece.
    pub(super) fn is_border(&self, j: usize) -> bool {
        self.crossings[j] == Crossing::Boundary
    }

    /// Whether a function makes an event by going to a value.
    pub(super) fn happens(&self, j: usize, value: f64) -> bool {
        let Some(new) = sign(value) else { return false };
        let old = self.signs[j];
        match self.crossings[j] {
            Crossing::Rising => old < 0 && new >= 0,
            Crossing::Falling => old > 0 && new <= 0,
            Crossing::Either => old != 0 && new != old,
            Crossing::Boundary => old >= 0 && new < 0,
        }
    }

    /// Looks at all functions over a step: `f` writes their values at a part of it.
    pub(super) fn survey<E>(
        &mut self,
        mut f: impl FnMut(f64, &mut [f64]) -> Result<(), E>,
    ) -> Result<(), E> {
        let count = self.len();
        self.places.truncate(1);
        self.values.truncate(count);
        for place in CHECKS {
            self.places.push(place);
            let at = self.values.len();
            self.values.resize(at + count, f64::NAN);
            f(place, &mut self.values[at..])?;
        }
        for j in 0..count {
            let own = self.values.iter().skip(j).step_by(count);
            self.sizes[j] = own.fold(0.0, |most, value| most.max(value.abs()));
            let mut c = 1;
            while c + 1 < self.places.len() {
                if let Some(place) = self.look_for_dip(j, c, &mut f)? {
                    f(place, &mut self.here)?;
                    let before = usize::from(place > self.places[c]) + c;
                    self.insert(before, place);
                    c += 1;
                }
                c += 1;
            }
        }
        Ok(())
    }

    /// Two zeros between two places, where the function has one sign at both.
    fn look_for_dip<E>(
        &mut self,
        j: usize,
        c: usize,
        f: &mut impl FnMut(f64, &mut [f64]) -> Result<(), E>,
    ) -> Result<Option<f64>, E> {
        let side = self.value(c, j).signum();
        let at = |i: usize| (self.places[i], side * self.value(i, j));
        let (a, m, b) = (at(c - 1), at(c), at(c + 1));
        if !(m.1 > 0.0 && a.1 >= m.1 && b.1 >= m.1) || (a.1 == m.1 && b.1 == m.1) {
            return Ok(None);
        }
        let here = &mut self.here;
        dip(a, m, b, |theta| f(theta, here).map(|()| side * here[j]))
    }

    /// Puts in one more place, whose values are in `here`.
    fn insert(&mut self, at: usize, place: f64) {
        let count = self.len();
        self.places.insert(at, place);
        self.values.extend_from_slice(&self.here);
        self.values[at * count..].rotate_right(count);
    }

    fn value(&self, place: usize, j: usize) -> f64 {
        self.values[place * self.len() + j]
    }

    /// How many intervals the places make.
    pub(super) fn intervals(&self) -> usize {
        self.places.len() - 1
    }

    /// Finds the changes of sign in an interval that are events: `found`, in order.
    pub(super) fn search<E>(
        &mut self,
        interval: usize,
        width: f64,
        mut f: impl FnMut(f64, &mut [f64]) -> Result<(), E>,
    ) -> Result<(), E> {
        self.found.clear();
        for j in 0..self.len() {
            let from = self.sign_behind(j, interval, &mut f)?;
            if self.happens(j, self.value(interval + 1, j)) {
                let theta = self.place_of(j, from, interval + 1, width, &mut f)?;
                self.found.push((theta, j));
            }
        }
        self.found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        Ok(())
    }

    /// A function that starts from zero has no sign to change: looks just behind the start of an
    /// interval for one that the end does not have, as a ball that has bounced falls again. Returns
    /// a place where the function has its sign.
    fn sign_behind<E>(
        &mut self,
        j: usize,
        interval: usize,
        f: &mut impl FnMut(f64, &mut [f64]) -> Result<(), E>,
    ) -> Result<(f64, f64), E> {
        let start = (self.places[interval], self.value(interval, j));
        let end = (self.places[interval + 1], self.value(interval + 1, j));
        let left = self.crossings[j] == Crossing::Boundary && self.signs[j] < 0;
        if !(left && end.1 < 0.0 || self.signs[j] == 0 && end.1 != 0.0) {
            return Ok(start);
        }
        let mut width = end.0 - start.0;
        for _ in 0..HALVINGS {
            width *= 0.5;
            let theta = start.0 + width;
            f(theta, &mut self.here)?;
            let value = self.here[j];
            let seen = (value - start.1).abs() > SEEN * (end.1 - start.1).abs();
            if value * end.1.signum() < 0.0 && seen {
                self.signs[j] = sign(value).unwrap_or(0);
                return Ok((theta, value));
            }
        }
        Ok(start)
    }

    /// The place of a change of sign behind `from`, and not behind the place of number `to`.
    fn place_of<E>(
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
        let mut b = (self.places[to], side * self.value(to, j));
        let here = &mut self.here;
        let mut g = |theta: f64| f(theta, here).map(|()| side * here[j]);
        // From the border itself, or from the other side of a break: look for a place inside.
        let mut halvings = HALVINGS;
        while a.1 <= 0.0 && halvings > 0 {
            halvings -= 1;
            let theta = a.0 + 0.5 * (b.0 - a.0);
            let value = g(theta)?;
            *(if value > 0.0 { &mut a } else { &mut b }) = (theta, value);
        }
        if a.1 <= 0.0 { Ok(a.0) } else { change_of_sign(a, b, width, far, g) }
    }

    /// An event has happened on the way through a step: the function is on its other side.
    pub(super) fn passed(&mut self, j: usize) {
        self.signs[j] = match self.crossings[j] {
            Crossing::Rising => 1,
            Crossing::Either => -self.signs[j],
            Crossing::Falling | Crossing::Boundary => -1,
        };
    }

    /// The run has come through an interval.
    pub(super) fn leave(&mut self, interval: usize) {
        for j in 0..self.len() {
            if let Some(new) = sign(self.value(interval + 1, j)) {
                self.signs[j] = new;
            }
        }
    }

    /// The run has come through the step: its end is the start of the next.
    pub(super) fn turn_over(&mut self) {
        let count = self.len();
        let last = self.values.len() - count;
        self.values.copy_within(last.., 0);
        self.places.truncate(1);
        self.values.truncate(count);
    }
}
