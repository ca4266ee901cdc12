//! What is kept of a run while it is made.

use super::dense::{DenseOutput, Interpolant};
use super::options::Output;
use super::solution::Event;

/// Events, output and steps of a run so far.
#[derive(Debug)]
pub(super) struct Record<'a> {
    asked: Output<'a>,
    /// 1 or -1: the direction of the run.
    way: f64,
    /// How many places of output were met.
    met: usize,
    pub events: Vec<Event>,
    pub event_states: Vec<f64>,
    pub samples: Vec<f64>,
    pub path: DenseOutput,
}

impl<'a> Record<'a> {
    /// For a run that starts at t in state y.
    pub(super) fn new(asked: Output<'a>, way: f64, t: f64, y: &[f64]) -> Self {
        let mut record = Self {
            asked,
            way,
            met: 0,
            events: Vec::new(),
            event_states: Vec::new(),
            samples: Vec::new(),
            path: DenseOutput::default(),
        };
        if let Output::At(places) = asked {
            record.samples.reserve_exact(places.len() * y.len());
            while places.get(record.met) == Some(&t) {
                record.samples.extend_from_slice(y);
                record.met += 1;
            }
        }
        record
    }

    /// Whether something is asked of the inside of a step to there.
    pub(super) fn asks_before(&self, end: f64) -> bool {
        match self.asked {
            Output::End => false,
            Output::Path => true,
            Output::At(places) => {
                places.get(self.met).is_some_and(|at| (end - at) * self.way >= 0.0)
            }
        }
    }

    /// An event.
    pub(super) fn event(&mut self, index: usize, t: f64, y: &[f64]) {
        self.events.push(Event { index, t });
        self.event_states.extend_from_slice(y);
    }

    /// A step of full width h, taken as far as `end`.
    pub(super) fn step(&mut self, interpolant: &Interpolant, n: usize, t: f64, h: f64, end: f64) {
        match self.asked {
            Output::End => {}
            Output::Path => self.path.push(interpolant, t, h, end),
            Output::At(places) => {
                while let Some(at) = places.get(self.met)
                    && (end - at) * self.way >= 0.0
                {
                    let from = self.samples.len();
                    self.samples.resize(from + n, 0.0);
                    interpolant.at((at - t) / h, &mut self.samples[from..]);
                    self.met += 1;
                }
            }
        }
    }
}
