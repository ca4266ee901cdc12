//! Output of a run while it is computed.

use std::collections::TryReserveError;

use super::options::Output;
use super::pair::dense::{DenseOutput, Interpolant};
use super::solution::Event;

/// Events, output and steps of a run so far.
#[derive(Debug)]
pub(super) struct Record<'a> {
    output: Output<'a>,
    /// 1 or -1: the direction of the run.
    direction: f64,
    /// Number of output times reached.
    reached: usize,
    pub events: Vec<Event>,
    pub event_states: Vec<f64>,
    pub samples: Vec<f64>,
    pub dense: DenseOutput,
}

impl<'a> Record<'a> {
    /// For a run that starts at t in state y; `spare`: an empty record of steps with room.
    pub(super) fn new(
        output: Output<'a>,
        direction: f64,
        (t, y): (f64, &[f64]),
        spare: DenseOutput,
    ) -> Self {
        let mut record = Self {
            output,
            direction,
            reached: 0,
            events: Vec::new(),
            event_states: Vec::new(),
            samples: Vec::new(),
            dense: spare,
        };
        if let Output::At(times) = output {
            record.samples.reserve_exact(times.len() * y.len());
            while times.get(record.reached) == Some(&t) {
                record.samples.extend_from_slice(y);
                record.reached += 1;
            }
        }
        record
    }

    /// Whether a step to `end` needs its dense output.
    pub(super) fn needs_dense_output(&self, end: f64) -> bool {
        match self.output {
            Output::End => false,
            Output::Dense => true,
            Output::At(times) => {
                times.get(self.reached).is_some_and(|at| (end - at) * self.direction >= 0.0)
            }
        }
    }

    /// Adds an event.
    pub(super) fn event(&mut self, index: usize, t: f64, y: &[f64]) {
        self.events.push(Event { index, t });
        self.event_states.extend_from_slice(y);
    }

    /// Adds a step of full width h, accepted as far as `end`.
    ///
    /// # Errors
    ///
    /// The step does not fit in memory.
    pub(super) fn step(
        &mut self,
        interpolant: &Interpolant,
        n: usize,
        t: f64,
        h: f64,
        end: f64,
    ) -> Result<(), TryReserveError> {
        match self.output {
            Output::End => {}
            Output::Dense => self.dense.push(interpolant, t, h, end)?,
            Output::At(times) => {
                while let Some(at) = times.get(self.reached)
                    && (end - at) * self.direction >= 0.0
                {
                    let from = self.samples.len();
                    self.samples.resize(from + n, 0.0);
                    interpolant.at((at - t) / h, &mut self.samples[from..]);
                    self.reached += 1;
                }
            }
        }
        Ok(())
    }
}
