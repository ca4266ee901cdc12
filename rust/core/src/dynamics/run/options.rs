//! What is asked of a run.

use std::time::Instant;

use super::error::{RunError, check_counts};
use crate::dynamics::angle_between::Angle;
use crate::dynamics::motor::Motor;
use crate::ode::options::Method;
use crate::ode::system::Crossing;

/// What a run goes along.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variable {
    /// The time.
    Time,
    /// The coordinate of the one driver.
    Coordinate,
}

/// Something to be looked for on the way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum EventKind {
    /// A driver's coordinate has a value.
    Coordinate {
        /// Which driver.
        driver: usize,
        /// The value.
        value: f64,
    },
    /// A driver's speed has a value; 0 is rest.
    Speed {
        /// Which driver.
        driver: usize,
        /// The value.
        value: f64,
    },
    /// The speed of the one driver is the greatest or the least.
    Extreme,
    /// An angle has a value.
    Angle(Angle, f64),
    /// A function from outside is zero: which one.
    Callback(usize),
}

/// An event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EventSpec {
    /// What is looked for.
    pub kind: EventKind,
    /// Which way.
    pub crossing: Crossing,
    /// Whether the run ends there.
    pub stops: bool,
}

/// A run.
#[derive(Debug, Clone, Copy)]
pub struct RunOptions<'a> {
    /// What it goes along.
    pub along: Variable,
    /// Time at the beginning, s.
    pub t: f64,
    /// Coordinates there.
    pub q: &'a [f64],
    /// Speeds there.
    pub speed: &'a [f64],
    /// Where it ends: a time or a coordinate.
    pub end: f64,
    /// The pair of formulas.
    pub method: Method,
    /// Relative tolerance of the speeds; that of the coordinates is as much of a radian, or of the
    /// size of the mechanism.
    pub relative: f64,
    /// Absolute tolerances of coordinates and speeds instead.
    pub absolute: Option<[f64; 2]>,
    /// The widest step.
    pub max_step: f64,
    /// How many steps may be tried.
    pub max_steps: u64,
    /// When it must be over.
    pub deadline: Option<Instant>,
    /// Where functions from outside are not smooth (times or coordinates), ascending.
    pub breaks: &'a [f64],
    /// Events.
    pub events: &'a [EventSpec],
    /// Inertia added to the first driver's.
    pub flywheel: f64,
}

impl RunOptions<'_> {
    /// Refuses what is no task of a machine with so many drivers.
    pub(crate) fn check<E>(&self, drivers: usize, motors: &[Motor]) -> Result<(), RunError<E>> {
        check_counts(&[
            ("coordinates", drivers, self.q.len()),
            ("speeds", drivers, self.speed.len()),
        ])?;
        if self.along == Variable::Coordinate {
            check_counts(&[("drivers of a motion along the coordinate", 1, drivers)])?;
        }
        let driver_of = |event: &EventSpec| match event.kind {
            EventKind::Coordinate { driver, .. } | EventKind::Speed { driver, .. } => driver,
            _ => 0,
        };
        let drivers_used =
            self.events.iter().map(driver_of).chain(motors.iter().map(|motor| motor.driver));
        match drivers_used.max().filter(|driver| *driver >= drivers) {
            Some(driver) => {
                Err(RunError::Malformed { what: "drivers", needed: driver + 1, given: drivers })
            }
            None => Ok(()),
        }
    }
}
