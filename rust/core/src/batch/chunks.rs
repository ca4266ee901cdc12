//! The work in chunks: some positions of some designs, with the rows to write. The designs of a chunk are
//! read dimension by dimension, so that range checks and scales vectorise over the designs.

use std::ops::Range;

use super::request::{Arrays, Column};
use super::rows::{Layout, RowSlices};
use super::writer::Writer;
use crate::branch::driven_chord::positions_share_branch;
use crate::plan::mechanism::Mechanism;
use crate::state::kernel::BLOCK;

/// Positions per chunk: some hundred microseconds of work, so that tracing the branch and taking
/// the chunk from the queue cost little.
const CHUNK: usize = 8192;
/// The same with at least [`MANY_DESIGNS`]: a longer chunk loads the shared coordinates and their
/// unit vectors once for all its designs, as long as they fit in a cache.
const CHUNK_OF_MANY_DESIGNS: usize = 65_536;
/// With at least this many designs all threads have work even if each design is one chunk.
const MANY_DESIGNS: usize = 64;
/// The same with several drivers, where each position needs its own branch.
const CHUNK_SEVERAL_DRIVERS: usize = 8;
/// Largest number of designs per chunk: tracing the branch of one may take a millisecond.
const MAX_DESIGNS: usize = 128;
/// Numbers in a result that no cache holds: 32 MiB.
const BEYOND_CACHES: usize = 4 << 20;

/// A range of positions of a range of designs.
#[derive(Debug, Clone)]
pub(crate) struct Chunk {
    pub designs: Range<usize>,
    pub positions: Range<usize>,
}

/// The chunks still to do, with the rows to write. After an interruption the rest stays unwritten:
/// it must not be read, and filling it would take as long as solving.
pub(crate) struct Chunks<'a> {
    rest: Arrays<'a>,
    columns: &'a [Column],
    designs: usize,
    positions: usize,
    next: (usize, usize),
    /// Most positions and designs of a chunk.
    pub size: usize,
    pub max_designs: usize,
    past_caches: bool,
}

/// Most positions of one design in a chunk, of `positions`.
pub(crate) fn most_positions(positions: usize) -> usize {
    positions.min(CHUNK_OF_MANY_DESIGNS)
}

impl<'a> Chunks<'a> {
    pub(crate) fn new(
        arrays: Arrays<'a>,
        columns: &'a [Column],
        [designs, positions]: [usize; 2],
        drivers: usize,
    ) -> Self {
        let size = match drivers {
            1 if designs >= MANY_DESIGNS => positions.clamp(CHUNK, CHUNK_OF_MANY_DESIGNS),
            1 => CHUNK,
            _ => CHUNK_SEVERAL_DRIVERS,
        };
        let numbers: usize = arrays.columns.iter().map(|column| column.len()).sum();
        let past_caches = numbers >= BEYOND_CACHES;
        Self {
            rest: arrays,
            columns,
            designs,
            positions,
            next: (0, 0),
            size,
            max_designs: MAX_DESIGNS,
            past_caches,
        }
    }

    /// Makes the chunks of several drivers longer if no position needs a branch of its own.
    pub(crate) fn lengthen(&mut self, mechanism: &Mechanism, writer: &Writer) {
        if positions_share_branch(mechanism.plan(), !writer.classes.is_empty()) {
            self.size = self.size.max(BLOCK);
        }
    }

    /// Number of chunks not taken yet.
    pub(super) fn count(&self) -> usize {
        let (design, position) = self.next;
        let designs = self.designs - design;
        if self.positions == 0 {
            0
        } else if self.positions >= self.size {
            designs * self.positions.div_ceil(self.size) - position / self.size
        } else {
            designs.div_ceil(self.designs_per_chunk())
        }
    }

    /// Rows not taken yet.
    pub(super) fn left(&self) -> usize {
        let (design, position) = self.next;
        (self.designs - design) * self.positions - position
    }

    /// Designs per chunk when each has all its positions in the chunk.
    fn designs_per_chunk(&self) -> usize {
        (self.size / self.positions).clamp(1, self.max_designs)
    }

    pub(super) fn take(&mut self) -> Option<(Chunk, RowSlices<'a>)> {
        let (design, position) = self.next;
        if design == self.designs || self.positions == 0 {
            return None;
        }
        let chunk = if self.positions >= self.size || position > 0 {
            let end = (position + self.size).min(self.positions);
            self.next = if end == self.positions { (design + 1, 0) } else { (design, end) };
            Chunk { designs: design..design + 1, positions: position..end }
        } else {
            let end = (design + self.designs_per_chunk()).min(self.designs);
            self.next = (end, 0);
            Chunk { designs: design..end, positions: 0..self.positions }
        };
        let rows = self.take_rows(chunk.designs.len() * chunk.positions.len());
        Some((chunk, rows))
    }

    fn take_rows(&mut self, rows: usize) -> RowSlices<'a> {
        let columns = self.rest.columns.iter_mut().zip(self.columns);
        RowSlices {
            layout: Layout::Rows,
            columns: columns.map(|(all, column)| split_front(all, rows * column.width)).collect(),
            status: split_front(&mut self.rest.status, rows),
            past_caches: self.past_caches,
        }
    }
}

/// Splits the first `count` elements off a slice.
#[allow(clippy::mut_mut, reason = "the slice itself is moved on")]
fn split_front<'a, T>(all: &mut &'a mut [T], count: usize) -> &'a mut [T] {
    let (front, rest) = std::mem::take(all).split_at_mut(count);
    *all = rest;
    front
}

/// The designs of a chunk.
#[derive(Debug, Default)]
pub(crate) struct Designs {
    /// Number of dimensions.
    size: usize,
    /// Dimensions, design after design.
    rows: Vec<f64>,
    scales: Vec<f64>,
    valid: Vec<bool>,
}

/// One design of a chunk.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DesignRow<'a> {
    pub dimensions: &'a [f64],
    /// See [`crate::plan::constants::DesignConstants::scale`].
    pub scale: f64,
    /// Whether all dimensions are in range.
    pub is_valid: bool,
}

impl Designs {
    /// Reads some of `all` designs. `dimensions` holds the first dimension of every design, then the
    /// second of every design, and so on.
    pub(crate) fn read(
        &mut self,
        mechanism: &Mechanism,
        dimensions: &[f64],
        all: usize,
        designs: Range<usize>,
    ) {
        let (size, count) = (mechanism.dimensions().len(), designs.len());
        let column = |index: usize| &dimensions[index * all..][designs.clone()];
        self.size = size;
        self.rows.resize(count * size, 0.0);
        self.valid.clear();
        self.valid.resize(count, true);
        for (index, &[low, high]) in mechanism.dimensions().ranges().iter().enumerate() {
            let values = column(index);
            for (row, &value) in self.rows.chunks_exact_mut(size).zip(values) {
                row[index] = value;
            }
            for (valid, &value) in self.valid.iter_mut().zip(values) {
                *valid &= low <= value && value <= high;
            }
        }
        self.scales.resize(count, 1.0);
        let row = |design: usize| &self.rows[design * size..][..size];
        mechanism.slots.scales(column, row, &mut self.scales);
    }

    /// The design at an index of the chunk.
    pub(crate) fn row(&self, index: usize) -> DesignRow<'_> {
        DesignRow {
            dimensions: &self.rows[index * self.size..][..self.size],
            scale: self.scales[index],
            is_valid: self.valid[index],
        }
    }
}
