//! A run as plain numbers, to store and restore it.

use thiserror::Error;

use super::dead_point::Tail;
use super::sample::Samples;
use super::trajectory::{EventRecord, Run, StopReason};
use super::variable::Variable;
use crate::ode::pair::dense::{DenseOutput, LEAST_ROWS};
use crate::ode::solution::Statistics;

/// All numbers of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct RunParts {
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
    /// Independent variable.
    pub along: Variable,
    /// Sign of the speed in a run along the coordinate.
    pub sign: f64,
    /// Where each step of the dense output starts.
    pub starts: Vec<f64>,
    /// Full width of each step.
    pub widths: Vec<f64>,
    /// Where each step ends.
    pub ends: Vec<f64>,
    /// Coefficients of the dense output, step after step.
    pub rows: Vec<f64>,
    /// The last part before a dead point.
    pub tail: Option<Tail>,
}

/// Parts whose lengths do not fit.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("wrong number of {what}: {given} given, {needed} needed")]
pub struct PartsError {
    what: &'static str,
    needed: usize,
    given: usize,
}

impl Run {
    /// The numbers of the run.
    #[must_use]
    pub fn parts(&self) -> RunParts {
        RunParts {
            samples: self.samples.clone(),
            energies: self.energies.clone(),
            events: self.events.clone(),
            stop_reason: self.stop_reason.clone(),
            statistics: self.statistics,
            along: self.along,
            sign: self.sign,
            starts: self.path.starts.clone(),
            widths: self.path.widths.clone(),
            ends: self.path.ends.clone(),
            rows: self.path.rows.clone(),
            tail: self.tail.clone(),
        }
    }

    /// The run with these numbers.
    ///
    /// # Errors
    ///
    /// Lists whose lengths do not fit each other.
    pub fn from_parts(parts: RunParts) -> Result<Self, PartsError> {
        let RunParts { samples, energies, events, stop_reason, statistics, along, sign, .. } =
            parts;
        let (count, drivers) = (samples.len(), samples.drivers());
        check("samples", count.max(1), count)?;
        check("coordinates", count * drivers.max(1), samples.q.len())?;
        check("speeds", samples.q.len(), samples.speed.len())?;
        check("accelerations", samples.q.len(), samples.acceleration.len())?;
        check("works", count, samples.work.len())?;
        check("energies", count, energies.len())?;
        for event in &events {
            check("coordinates of an event", drivers, event.q.len())?;
            check("speeds of an event", drivers, event.speed.len())?;
        }
        if along == Variable::Coordinate || parts.tail.is_some() {
            check("drivers", 1, drivers)?;
        }
        let steps = parts.starts.len();
        check("widths of steps", steps, parts.widths.len())?;
        check("ends of steps", steps, parts.ends.len())?;
        let components = if steps == 0 { 0 } else { 2 * drivers + 1 };
        let stride = parts.rows.len().checked_div(steps).unwrap_or(0);
        let rows = stride.checked_div(components).unwrap_or(0).max(LEAST_ROWS);
        check("coefficients", steps * components * rows, parts.rows.len())?;
        let path = DenseOutput {
            n: components,
            stride,
            starts: parts.starts,
            widths: parts.widths,
            ends: parts.ends,
            rows: parts.rows,
        };
        let tail = parts.tail;
        Ok(Self { samples, energies, events, stop_reason, statistics, along, sign, path, tail })
    }
}

fn check(what: &'static str, needed: usize, given: usize) -> Result<(), PartsError> {
    if needed == given { Ok(()) } else { Err(PartsError { what, needed, given }) }
}
