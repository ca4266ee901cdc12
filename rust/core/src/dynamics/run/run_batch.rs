//! Many runs of a machine: initial states of designs, each with its own end.

use std::ops::{ControlFlow, Range};
use std::time::{Duration, Instant};

use super::callbacks::Callbacks;
use super::error::RunError;
use super::options::{EventSpec, RunOptions};
use super::runner::{RunTables, Runner};
use super::tabulated::TabulatedMachine;
use super::trajectory::Run;
use crate::dynamics::machine::Machine;
use crate::dynamics::variation::Variation;
use crate::plan::mechanism::Mechanism;

/// Runs of designs, the same number of each.
#[derive(Debug, Clone, Copy)]
pub struct RunBatch<'a> {
    /// Dimensions: the first of every design, then the second of every design, and so on.
    pub dimensions: &'a [f64],
    /// Number of designs.
    pub designs: usize,
    /// Initial coordinates: runs × drivers, design by design.
    pub q: &'a [f64],
    /// Initial speeds in that layout.
    pub speed: &'a [f64],
    /// Where each run ends.
    pub ends: &'a [f64],
    /// The events of each design, or one list for all.
    pub events: &'a [Vec<EventSpec>],
    /// Numbers of bodies, loads and motors that differ from design to design. May be empty.
    pub variations: &'a [Variation<'a>],
    /// Limit of computing time of each run.
    pub limit: Option<Duration>,
    /// The other options. Its states, end, events and deadline do not count.
    pub options: RunOptions<'a>,
}

/// A run, or why there is none.
pub type Outcome<E> = Result<Run, RunError<E>>;

impl RunBatch<'_> {
    /// Number of runs.
    #[must_use]
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there are no runs.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The design of a run.
    pub(super) fn design(&self, run: usize) -> usize {
        run / (self.len() / self.designs.max(1)).max(1)
    }

    /// The dimensions of a design.
    pub(super) fn dimensions_of(&self, design: usize) -> Vec<f64> {
        self.dimensions.iter().skip(design).step_by(self.designs.max(1)).copied().collect()
    }

    /// The runs of a range, design by design.
    pub(super) fn by_designs(
        &self,
        range: Range<usize>,
    ) -> impl Iterator<Item = (usize, Range<usize>)> {
        let mut first = range.start;
        std::iter::from_fn(move || {
            let design = (first < range.end).then(|| self.design(first))?;
            let last = (first..range.end).find(|&run| self.design(run) != design);
            let runs = first..last.unwrap_or(range.end);
            first = runs.end;
            Some((design, runs))
        })
    }

    /// The options of a run.
    pub(super) fn options_of(&self, run: usize) -> RunOptions<'_> {
        let drivers = self.q.len().checked_div(self.len()).unwrap_or(0);
        let states = run * drivers..(run + 1) * drivers;
        let events = self.events.get(self.design(run)).or(self.events.first());
        RunOptions {
            q: self.q.get(states.clone()).unwrap_or(&[]),
            speed: self.speed.get(states).unwrap_or(&[]),
            end: self.ends[run],
            events: events.map_or(&[], |events| events),
            deadline: self.limit.and_then(|limit| Instant::now().checked_add(limit)),
            ..self.options
        }
    }

    /// Calls `integrate` with the options of each run in a range, until a callback fails or
    /// `keep` breaks off.
    fn each<E>(
        &self,
        range: Range<usize>,
        mut integrate: impl FnMut(&RunOptions<'_>) -> Outcome<E>,
        keep: &mut impl FnMut(usize, Outcome<E>) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        for run in range {
            let outcome = integrate(&self.options_of(run));
            let has_failed = matches!(outcome, Err(RunError::Callback(_)));
            if keep(run, outcome).is_break() || has_failed {
                return ControlFlow::Break(());
            }
        }
        ControlFlow::Continue(())
    }
}

impl Machine {
    /// Integrates a range of the runs of a batch, and passes each on to `keep` with its index. It ends
    /// early where a callback fails or `keep` breaks off. Each run has the bits that it has alone.
    pub fn runs<O: Callbacks>(
        &self,
        mechanism: &Mechanism,
        batch: &RunBatch<'_>,
        range: Range<usize>,
        callbacks: &mut O,
        keep: &mut impl FnMut(usize, Outcome<O::Error>) -> ControlFlow<()>,
    ) {
        let tables = RunTables::new(mechanism);
        for (design, runs) in batch.by_designs(range) {
            let machine = self.of(batch.variations, design);
            let mut bound: Option<Runner<'_>> = None;
            let integrate = |options: &RunOptions<'_>| {
                let runner = match bound.take() {
                    Some(runner) => runner,
                    None => {
                        Runner::new(&machine, mechanism, &batch.dimensions_of(design), &tables)?
                    }
                };
                bound.insert(runner).run(options, &mut *callbacks)
            };
            if batch.each(runs, integrate, keep).is_break() {
                return;
            }
        }
    }
}

impl TabulatedMachine {
    /// Integrates a range of the runs of a batch; see [`Machine::runs`].
    pub fn runs<O: Callbacks>(
        &self,
        batch: &RunBatch<'_>,
        range: Range<usize>,
        callbacks: &mut O,
        keep: &mut impl FnMut(usize, Outcome<O::Error>) -> ControlFlow<()>,
    ) {
        // One after another, whether or not they were broken off.
        let _ = batch.each(range, |options| self.run(options, &mut *callbacks), keep);
    }
}
