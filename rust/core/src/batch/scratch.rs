//! The memory into which a thread solves one design after another.

use std::num::NonZeroUsize;

use super::dispatch::Task;
use super::helpers::available_threads;
use super::request::Column;
use super::rows::{Layout, RowSlices};
use super::schedule::Control;
use super::solve::as_unwritten;
use super::worker::Job;
use crate::description::error::SolveError;
use crate::math::lanes::{LANES, Real, place_in_blocks};
use crate::math::room::has_room;

/// Columns for the positions of one design.
#[derive(Debug)]
pub(crate) struct Scratch {
    values: Vec<Vec<f64>>,
    status: Vec<u8>,
    layout: Layout,
    copied: Vec<Copied>,
}

/// The rows of a scratch, to be written and read in turn.
pub(crate) struct ScratchRows<'a> {
    slices: RowSlices<'a>,
    copied: &'a mut [Copied],
}

/// Copies the columns in [blocks](Layout::Blocks) that are read row after row.
pub(crate) struct CopyRows<'s, 'a> {
    pub rows: &'s mut ScratchRows<'a>,
    /// Number of rows.
    pub count: usize,
}

/// A column in blocks, copied row after row.
#[derive(Debug)]
struct Copied {
    column: usize,
    width: usize,
    numbers: Vec<f64>,
}

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
        let rows = positions.next_multiple_of(LANES);
        let values = columns.iter().map(|column| vec![f64::NAN; rows * column.width]).collect();
        Self { values, status: vec![0; positions], layout, copied: Vec::new() }
    }

    /// Lets some columns in blocks, those of several numbers a row, be [copied](CopyRows).
    pub(crate) fn copying(mut self, columns: &[Column], is_read: impl Fn(usize) -> bool) -> Self {
        let several = columns.iter().enumerate().filter(|(_, column)| column.width > 1);
        let copied = several.filter(|&(index, _)| is_read(index)).map(|(column, of)| Copied {
            column,
            width: of.width,
            numbers: self.values[column].clone(),
        });
        self.copied = copied.collect();
        self
    }

    pub(crate) fn rows(&mut self) -> ScratchRows<'_> {
        #[allow(unsafe_code, reason = "the standard library has no safe form of this yet")]
        // SAFETY: a worker stores only initialised numbers.
        unsafe {
            ScratchRows {
                slices: RowSlices {
                    layout: self.layout,
                    columns: self.values.iter_mut().map(|values| as_unwritten(values)).collect(),
                    status: as_unwritten(&mut self.status),
                    past_caches: false,
                },
                copied: &mut self.copied,
            }
        }
    }
}

impl<R: Real> Task<R> for CopyRows<'_, '_> {
    #[inline(always)]
    fn run(&mut self) {
        for copied in &mut *self.rows.copied {
            #[allow(unsafe_code, reason = "the standard library has no safe form of this yet")]
            // SAFETY: the numbers were initialised when the scratch was made.
            let blocks = unsafe { self.rows.slices.columns[copied.column].assume_init_ref() };
            let width = copied.width;
            let size = LANES * width;
            let whole = blocks.chunks_exact(size).zip(copied.numbers.chunks_exact_mut(size));
            for (block, rows) in whole.take(self.count.div_ceil(LANES)) {
                if width == 2 {
                    pairs_of_block::<R>(block, rows);
                    continue;
                }
                for (place, number) in rows.iter_mut().enumerate() {
                    *number = block[place_in_blocks(place / width, width, place % width)];
                }
            }
        }
    }
}

/// The rows of a block of pairs.
#[inline(always)]
fn pairs_of_block<R: Real>(block: &[f64], rows: &mut [f64]) {
    let (first, second) = block.split_at(LANES);
    let halves = first.chunks_exact(R::LANES).zip(second.chunks_exact(R::LANES));
    for ((first, second), rows) in halves.zip(rows.chunks_exact_mut(2 * R::LANES)) {
        let [before, after] = R::read(first).zip(R::read(second));
        for lane in 0..R::LANES {
            (rows[lane], rows[R::LANES + lane]) = (before.lane(lane), after.lane(lane));
        }
    }
}

impl<'a> ScratchRows<'a> {
    /// The job of solving a design at `q`, the same for all designs, into the first rows.
    pub(crate) fn job<'j>(&'j mut self, q: &'j [f64], design: usize) -> Job<'j, 'a> {
        Job { q, rows: &mut self.slices, first: 0, index: 0, design, shared: Some(0) }
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
        for column in &mut self.slices.columns {
            let block = count / LANES;
            let width = column.len() / self.slices.status.len().next_multiple_of(LANES);
            let numbers = &mut column[block * LANES * width..(block + 1) * LANES * width];
            for register in numbers.chunks_exact_mut(LANES) {
                let last = register[count % LANES - 1];
                register[count % LANES..].fill(last);
            }
        }
    }

    /// A column row after row.
    pub(crate) fn by_row(&self, index: usize) -> &[f64] {
        let copied = self.copied.iter().find(|copied| copied.column == index);
        copied.map_or_else(|| self.column(index), |copied| &copied.numbers)
    }

    /// A column as it was written.
    pub(crate) fn column(&self, index: usize) -> &[f64] {
        #[allow(unsafe_code, reason = "the standard library has no safe form of this yet")]
        // SAFETY: the numbers were initialised when the scratch was made.
        unsafe {
            self.slices.columns[index].assume_init_ref()
        }
    }

    pub(crate) fn status(&self) -> &[u8] {
        #[allow(unsafe_code, reason = "the standard library has no safe form of this yet")]
        // SAFETY: as above.
        unsafe {
            self.slices.status.assume_init_ref()
        }
    }
}
