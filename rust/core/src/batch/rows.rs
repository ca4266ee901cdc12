//! The rows of arrays that positions are written to, and how registers are stored in them.

use std::marker::PhantomData;
use std::mem::MaybeUninit;

use super::request::Column;
use crate::math::lanes::{LANES, Real, place_in_blocks};
use crate::math::vector::Vector;

/// Bytes of a cache line.
const LINE: usize = 64;

/// How the numbers of several per row lie in an array.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Layout {
    /// Row after row, as results are read.
    Rows,
    /// In [blocks](place_in_blocks): each register lies by itself, and an array has room for whole eights.
    Blocks,
}

/// The rows of some positions in every array, not yet written.
#[derive(Debug)]
pub(crate) struct RowSlices<'a> {
    pub columns: Vec<&'a mut [MaybeUninit<f64>]>,
    pub status: &'a mut [MaybeUninit<u8>],
    /// Whether the whole result exceeds the caches, so that rows may bypass them.
    pub past_caches: bool,
    pub layout: Layout,
}

/// Rows to write.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RowRange {
    pub first: usize,
    pub count: usize,
    /// Whether rows may bypass the caches: untouched until the chunk ends.
    pub once: bool,
}

impl RowRange {
    /// One row.
    pub(crate) fn single(first: usize) -> Self {
        Self { first, count: 1, once: false }
    }
}

/// A column with [`Layout::Blocks`], to be written from a row on.
pub(super) struct BlockColumn<'r> {
    numbers: &'r mut [MaybeUninit<f64>],
    first: usize,
    width: usize,
}

impl BlockColumn<'_> {
    /// Writes number `index` of each row in a register, which is number `g` from the first row on.
    #[inline(always)]
    pub(super) fn put<R: Real>(&mut self, g: usize, index: usize, x: R) {
        let at = place_in_blocks(self.first + g * R::LANES, self.width, index);
        x.write(&mut self.numbers[at..at + R::LANES]);
    }

    /// Where numbers `index` of the rows go, register after register.
    #[inline(always)]
    pub(super) fn registers<R: Real>(&mut self, index: usize) -> BlockRegisters<'_, R> {
        let at = place_in_blocks(self.first, self.width, index);
        BlockRegisters {
            rest: self.numbers.get_mut(at..).unwrap_or_default(),
            lane: self.first % LANES,
            gap: LANES * (self.width - 1),
            register: PhantomData,
        }
    }
}

/// Registers of a [`BlockColumn`]. Each takes few instructions, unlike a [place](place_in_blocks).
pub(super) struct BlockRegisters<'r, R> {
    rest: &'r mut [MaybeUninit<f64>],
    /// Lane of the next register in its block.
    lane: usize,
    /// Numbers between those of a block and of the next one.
    gap: usize,
    register: PhantomData<R>,
}

impl<'r, R: Real> Iterator for BlockRegisters<'r, R> {
    type Item = &'r mut [MaybeUninit<f64>];

    #[inline(always)]
    fn next(&mut self) -> Option<Self::Item> {
        let (out, rest) = std::mem::take(&mut self.rest).split_at_mut_checked(R::LANES)?;
        self.lane += R::LANES;
        self.rest = rest;
        if R::LANES == LANES || self.lane == LANES {
            self.lane = 0;
            self.rest = std::mem::take(&mut self.rest).get_mut(self.gap..).unwrap_or_default();
        }
        Some(out)
    }
}

impl RowSlices<'_> {
    /// A column of some width, with [`Layout::Blocks`].
    #[inline(always)]
    pub(super) fn blocks(
        &mut self,
        column: usize,
        width: usize,
        range: RowRange,
    ) -> BlockColumn<'_> {
        BlockColumn { numbers: &mut *self.columns[column], first: range.first, width }
    }

    /// Prefetches rows that will be written through the caches.
    #[inline(always)]
    pub(crate) fn prefetch<R: Real>(&self, columns: &[Column], range: RowRange) {
        if !self.past_caches {
            return;
        }
        for (array, column) in self.columns.iter().zip(columns) {
            let rows =
                &array[range.first * column.width..(range.first + range.count) * column.width];
            if !rows.as_ptr().addr().is_multiple_of(LINE) {
                R::prefetch(rows);
            }
        }
    }

    /// Writes NaN and a status into `count` rows from `row` on.
    pub(crate) fn write_failed(
        &mut self,
        columns: &[Column],
        row: usize,
        count: usize,
        status: u8,
    ) {
        self.write_nan(columns, 0, row, count);
        self.status[row..row + count].fill(MaybeUninit::new(status));
    }

    /// Writes NaN into the derivatives from `order` on.
    pub(crate) fn write_nan(&mut self, columns: &[Column], order: usize, row: usize, count: usize) {
        for (column, out) in columns.iter().zip(&mut self.columns) {
            if column.order < order {
                continue;
            }
            if self.layout == Layout::Blocks {
                for row in row..row + count {
                    for entry in 0..column.width {
                        out[place_in_blocks(row, column.width, entry)] = MaybeUninit::new(f64::NAN);
                    }
                }
                continue;
            }
            let rows = row * column.width..(row + count) * column.width;
            out[rows].fill(MaybeUninit::new(f64::NAN));
        }
    }
}

/// Whether rows begin where a line of a cache does.
#[inline(always)]
pub(crate) fn begins_line(rows: &[MaybeUninit<f64>]) -> bool {
    rows.as_ptr().addr().is_multiple_of(LINE)
}

/// Stores the lanes of a point, x and y side by side.
#[inline(always)]
pub(crate) fn store_pairs<R: Real>(out: &mut [MaybeUninit<f64>], past: bool, p: Vector<R>) {
    let (first, last) = out.split_at_mut(R::LANES);
    let [before, after] = p.x.zip(p.y);
    write(first, past, before);
    write(last, past, after);
}

/// Writes a whole register, past the caches if `past`.
#[inline(always)]
pub(crate) fn write<R: Real>(out: &mut [MaybeUninit<f64>], past: bool, x: R) {
    if past { x.stream(out) } else { x.write(out) }
}

/// Writes `(number + term) * factor` for each whole register of a column; returns how many there
/// were.
#[inline(always)]
pub(super) fn write_scaled<R: Real>(
    out: &mut [MaybeUninit<f64>],
    past: bool,
    numbers: &[R],
    term: Option<R>,
    factor: R,
) -> usize {
    for (&number, out) in numbers.iter().zip(out.chunks_exact_mut(R::LANES)) {
        let number = if let Some(term) = term { number + term } else { number };
        write(out, past, number * factor);
    }
    out.len() / R::LANES
}

/// Stores one entry of each row, one lane per row.
#[inline(always)]
pub(crate) fn store_lanes<R: Real>(out: &mut [MaybeUninit<f64>], width: usize, index: usize, x: R) {
    for (lane, row) in out.chunks_exact_mut(width).enumerate() {
        row[index] = MaybeUninit::new(x.lane(lane));
    }
}
