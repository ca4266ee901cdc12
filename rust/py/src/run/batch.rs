//! Many runs for Python: in threads, or one after another where they call functions.

use std::ops::{ControlFlow, Range};
use std::sync::atomic::{AtomicBool, Ordering};

use assur::dynamics::{
    Callbacks, EventKind, EventSpec, Machine, Outcome, RunBatch, RunError, StopReason,
    TabulatedMachine, UnlessCancelled,
};
use assur::{Mechanism, Simd};
use pyo3::prelude::*;

use super::PythonCallbacks;
use super::outcomes::{Kept, Runs};
use crate::convert::event::event;
use crate::parallel_map::parallel_map;
use crate::{detach, reserve};

/// Runs of a chunk, which share the traced branch of their design; and the chunks of a small batch.
const CHUNK: [usize; 2] = [16, 512];
const CHUNKS: usize = 32;
/// Runs that take only milliseconds.
const FEW_RUNS: usize = 8;

/// What a batch integrates.
#[derive(Clone, Copy)]
pub(crate) enum Source<'m> {
    Mechanism(&'m Mechanism, &'m Machine),
    Tables(&'m TabulatedMachine),
}

impl Source<'_> {
    fn runs<O: Callbacks>(
        self,
        batch: &RunBatch<'_>,
        range: Range<usize>,
        callbacks: &mut O,
        keep: &mut impl FnMut(usize, Outcome<O::Error>) -> ControlFlow<()>,
    ) {
        match self {
            Self::Mechanism(mechanism, machine) => {
                machine.runs(mechanism, batch, range, callbacks, keep);
            }
            Self::Tables(tabulated) => tabulated.runs(batch, range, callbacks, keep),
        }
    }
}

impl Source<'_> {
    /// The same for runs that call no functions of Python.
    fn runs_without_functions(
        self,
        batch: &RunBatch<'_>,
        range: Range<usize>,
        cancel: &AtomicBool,
        keep: &mut impl FnMut(usize, Outcome<PyErr>) -> ControlFlow<()>,
    ) {
        match self {
            Self::Mechanism(mechanism, machine) => {
                let control = (cancel, Simd::default());
                machine.runs_side_by_side(mechanism, batch, range, control, keep);
            }
            Self::Tables(tabulated) => {
                tabulated.runs(batch, range, &mut UnlessCancelled::new(cancel), keep);
            }
        }
    }
}

/// The events of each design, or one list where they do not depend on the design. Functions are added
/// to the list.
pub(crate) fn events_of_designs(
    mechanism: Option<&Mechanism>,
    (dimensions, designs): (&[f64], usize),
    objects: &[Bound<'_, PyAny>],
    functions: &mut Vec<Py<PyAny>>,
) -> PyResult<Vec<Vec<EventSpec>>> {
    let of_design = |design: usize, functions: &mut Vec<Py<PyAny>>| -> PyResult<Vec<EventSpec>> {
        let row: Vec<f64> =
            dimensions.iter().skip(design).step_by(designs.max(1)).copied().collect();
        objects.iter().map(|object| event(mechanism, &row, object, functions)).collect()
    };
    let first = of_design(0, functions)?;
    let follows = first.iter().any(|event| matches!(event.kind, EventKind::Angle(..)));
    let mut all = vec![first];
    if follows {
        for design in 1..designs {
            // The functions are those of the first.
            all.push(of_design(design, &mut Vec::new())?);
        }
    }
    Ok(all)
}

/// All runs of a batch on several threads, without functions of Python.
pub(crate) fn in_threads(
    py: Python<'_>,
    source: Source<'_>,
    batch: &RunBatch<'_>,
    only_ends: bool,
    threads: Option<usize>,
) -> PyResult<Runs> {
    let count = batch.len();
    let _room = reserve::room(py, count.saturating_mul(2 * size_of::<Kept>()))?;
    let size = count.div_ceil(CHUNKS).clamp(CHUNK[0], CHUNK[1]);
    let chunks = detach::run(py, count <= FEW_RUNS, |cancel| {
        let chunk = |index: usize| {
            let range = index * size..((index + 1) * size).min(count);
            let mut kept = Vec::with_capacity(range.len());
            source.runs_without_functions(batch, range, cancel, &mut |_, outcome| {
                kept.push(Kept::new(outcome, only_ends));
                go_on(cancel.load(Ordering::Relaxed))
            });
            kept
        };
        parallel_map(count.div_ceil(size), 1, threads, cancel, &chunk)
    })?;
    Runs::new(py, chunks.into_iter().flatten().collect())
}

/// All runs of a batch, one after another, which call functions of Python. Where one fails, its
/// exception is raised at once.
pub(crate) fn one_by_one(
    source: Source<'_>,
    batch: &RunBatch<'_>,
    only_ends: bool,
    callbacks: &mut PythonCallbacks,
) -> PyResult<Vec<Kept>> {
    let mut kept = Vec::with_capacity(batch.len());
    let mut failed = None;
    source.runs(batch, 0..batch.len(), callbacks, &mut |_, outcome| {
        let is_cancelled =
            outcome.as_ref().is_ok_and(|run| run.stop_reason == StopReason::Cancelled);
        match outcome {
            Err(RunError::Callback(error)) => failed = Some(error),
            outcome => kept.push(Kept::new(outcome, only_ends)),
        }
        go_on(is_cancelled)
    });
    failed.map_or(Ok(kept), Err)
}

fn go_on(is_cancelled: bool) -> ControlFlow<()> {
    if is_cancelled { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}
