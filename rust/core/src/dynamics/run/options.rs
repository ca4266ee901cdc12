//! Options of a run.

use std::time::Instant;

use super::error::{RunError, check_counts};
use super::variable::Variable;
use crate::dynamics::angle_between::Angle;
use crate::dynamics::motor::Motor;
use crate::ode::options::Method;
use crate::ode::system::Crossing;

/// The condition of an event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum EventKind {
    /// A driver's coordinate reaches a value.
    Coordinate {
        /// Index of the driver.
        driver: usize,
        /// The value.
        value: f64,
    },
    /// A driver's speed reaches a value; 0 is rest.
    Speed {
        /// Index of the driver.
        driver: usize,
        /// The value.
        value: f64,
    },
    /// The speed of a single driver is greatest or least.
    Extreme,
    /// An angle reaches a value.
    Angle(Angle, f64),
    /// The callback with this index reaches zero.
    Callback(usize),
}

/// An event to look for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EventSpec {
    /// The condition of the event.
    pub kind: EventKind,
    /// Direction of the crossing.
    pub crossing: Crossing,
    /// Whether the run ends there.
    pub stops: bool,
    /// The coefficient of restitution of an obstacle there: the speed of the only driver is multiplied by
    /// −this.
    pub rebound: Option<f64>,
}

/// Options of a run.
#[derive(Debug, Clone, Copy)]
pub struct RunOptions<'a> {
    /// Independent variable.
    pub along: Variable,
    /// Initial time, s.
    pub t: f64,
    /// Initial coordinates.
    pub q: &'a [f64],
    /// Initial speeds.
    pub speed: &'a [f64],
    /// Final time or coordinate.
    pub end: f64,
    /// Runge-Kutta method.
    pub method: Method,
    /// Relative tolerance of the speeds; also the absolute tolerance of the coordinates, in rad or
    /// as a part of the mechanism's size.
    pub relative: f64,
    /// Absolute tolerances of coordinates and speeds, if they are given.
    pub absolute: Option<[f64; 2]>,
    /// Largest step.
    pub max_step: f64,
    /// Largest number of steps, rejected ones included.
    pub max_steps: u64,
    /// Time limit.
    pub deadline: Option<Instant>,
    /// Times or coordinates where callbacks are not smooth, ascending.
    pub breaks: &'a [f64],
    /// Events to look for.
    pub events: &'a [EventSpec],
    /// Inertia added to the first driver's.
    pub flywheel: f64,
}

impl RunOptions<'_> {
    /// Checks the options against the number of drivers.
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
                Err(RunError::WrongCount { what: "drivers", needed: driver + 1, given: drivers })
            }
            None => Ok(()),
        }
    }
}
