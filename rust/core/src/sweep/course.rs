//! The coordinates of all designs of a sweep.

use std::f64::consts::TAU;

/// Steps of a turn are even if they differ by at most this part: coordinates from degrees, or written with
/// ten digits, are even.
const EVEN: f64 = 1.0e-9;

/// The coordinates of a sweep.
#[derive(Debug, Clone, Copy)]
pub struct Course<'a> {
    /// The coordinates of all drivers at each position, rad or m.
    pub q: &'a [f64],
    /// Number of drivers.
    pub drivers: usize,
    /// If a driven angle goes once round in even steps, without the first again at the end: the turn,
    /// +2π or −2π.
    pub turn: Option<f64>,
}

impl<'a> Course<'a> {
    /// Coordinates of some drivers; `is_angle`: whether a single one is an angle.
    pub(super) fn new(q: &'a [f64], drivers: usize, is_angle: bool) -> Self {
        let turn = if drivers == 1 && is_angle { turn(q) } else { None };
        Self { q, drivers, turn }
    }

    /// Number of positions.
    #[must_use]
    pub fn count(&self) -> usize {
        self.q.len() / self.drivers.max(1)
    }

    /// An error unless there is one driver.
    pub(super) fn check_one_driver(&self, what: &str) -> Result<(), String> {
        match self.drivers {
            1 => Ok(()),
            drivers => Err(format!("{what} needs one driver, here are {drivers}")),
        }
    }

    /// The coordinates, and after a turn the first two again: the positions to solve for metrics that need to
    /// know whether the motion returns.
    pub(super) fn with_return(&self) -> Option<Vec<f64>> {
        let (turn, [first, second, ..]) = (self.turn?, self.q) else { return None };
        Some([self.q, &[first + turn, second + turn]].concat())
    }
}

fn turn(q: &[f64]) -> Option<f64> {
    let [first, second, .., last] = *q else { return None };
    let turn = TAU.copysign(second - first);
    let mut range = [first + turn - last; 2];
    for pair in q.windows(2) {
        let step = pair[1] - pair[0];
        range = [range[0].min(step), range[1].max(step)];
    }
    let is_even = range[1] - range[0] <= EVEN * (second - first).abs();
    (is_even && q.len() > 2).then_some(turn)
}
