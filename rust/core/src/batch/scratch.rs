//! The memory into which a thread solves one design after another.

use std::num::NonZeroUsize;

use super::request::Column;
use super::rows::{Layout, RowSlices};
use super::schedule::{Control, available_threads};
use super::solve::as_unwritten;
use super::worker::Job;
use crate::description::error::SolveError;
use crate::math::lanes::LANES;
use crate::math::room::has_room;

/// Columns for the positions of one design.
#[derive(Debug)]
pub(crate) struct Scratch {
    values: Vec<Vec<f64>>,
    status: Vec<u8>,
    layout: Layout,
}

/// The rows of a scratch, to be written and read in turn.
pub(crate) struct ScratchRows<'a>(RowSlices<'a>);

impl Scratch {
    /// Whether memory has room for one of each thread.
    pub(crate) fn check(
        columns: &[Column],
        positions: usize,
        control: &Control<'_>,
    ) -> Result<(), SolveError> {
        let widths: usize = columns.iter().map(|column| column.width).sum();
        let threads = control.threads.map_or_else(available_threads, NonZeroUsize::get);
        let numbers = positions.saturating_mul(widths + 1).saturating_mul(threads);
        if has_room(numbers) { Ok(()) } else { Err(SolveError::OutOfMemory { numbers }) }
    }

    pub(crate) fn new(columns: &[Column], positions: usize, layout: Layout) -> Self {
        let rows = match layout {
            Layout::Rows => positions,
            Layout::Blocks => positions.next_multiple_of(LANES),
        };
        let values = columns.iter().map(|column| vec![f64::NAN; rows * column.width]).collect();
        Self { values, status: vec![0; positions], layout }
    }

    pub(crate) fn rows(&mut self) -> ScratchRows<'_> {
        #[allow(unsafe_code, reason = "the standard library has no safe form of this yet")]
        // SAFETY: a worker stores only initialised numbers.
        unsafe {
            ScratchRows(RowSlices {
                layout: self.layout,
                columns: self.values.iter_mut().map(|values| as_unwritten(values)).collect(),
                status: as_unwritten(&mut self.status),
                past_caches: false,
            })
        }
    }
}

impl<'a> ScratchRows<'a> {
    /// The job of solving a design at `q`, the same for all designs, into the first rows.
    pub(crate) fn job<'j>(&'j mut self, q: &'j [f64], design: usize) -> Job<'j, 'a> {
        Job { q, rows: &mut self.0, first: 0, index: 0, design, shared: Some(0) }
    }

    /// The job of solving a design at some of these coordinates, from a row on.
    pub(crate) fn part<'j>(&'j mut self, q: &'j [f64], first: usize, design: usize) -> Job<'j, 'a> {
        Job { first, shared: Some(first), ..self.job(q, design) }
    }

    /// Repeats the last of `count` rows in the rest of its block, which registers read with it.
    pub(crate) fn repeat_last(&mut self, count: usize) {
        if count.is_multiple_of(LANES) {
            return;
        }
        for column in &mut self.0.columns {
            let block = count / LANES;
            let width = column.len() / self.0.status.len().next_multiple_of(LANES);
            let numbers = &mut column[block * LANES * width..(block + 1) * LANES * width];
            for register in numbers.chunks_exact_mut(LANES) {
                let last = register[count % LANES - 1];
                register[count % LANES..].fill(last);
            }
        }
    }

    pub(crate) fn column(&self, index: usize) -> &[f64] {
        #[allow(unsafe_code, reason = "the standard library has no safe form of this yet")]
        // SAFETY: the numbers were initialised when the scratch was made.
        unsafe {
            self.0.columns[index].assume_init_ref()
        }
    }

    pub(crate) fn status(&self) -> &[u8] {
        #[allow(unsafe_code, reason = "the standard library has no safe form of this yet")]
        // SAFETY: as above.
        unsafe {
            self.0.status.assume_init_ref()
        }
    }
}
