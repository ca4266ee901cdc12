//! The inverse question for many designs and values.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};

use assur::{Followed, Inverse, Mechanism, SolveError, Start, Status};
use numpy::PyReadonlyArray1;
use pyo3::PyResult;

use crate::parallel_map::parallel_map;
use crate::reserve;

/// Rows of a design that one thread does.
const BLOCK: usize = 64;

/// Designs with rows of values, for all of them or for each.
pub(super) struct Rows<'r> {
    inverse: &'r Inverse,
    original: &'r Mechanism,
    /// The first dimension of every design, then the second.
    dimensions: Vec<f64>,
    values: Vec<f64>,
    per_design: bool,
    designs: usize,
    /// Rows of each design.
    length: usize,
}

/// The positions of a row, one after another.
#[derive(Clone)]
struct Row {
    q: Vec<f64>,
    status: Status,
}

/// The positions of all rows.
pub(super) struct Found {
    /// Rows of `most` positions.
    pub(super) q: Vec<f64>,
    pub(super) most: usize,
    pub(super) counts: Vec<i64>,
    pub(super) status: Vec<u8>,
}

impl<'r> Rows<'r> {
    pub(super) fn new(
        inverse: &'r Inverse,
        original: &'r Mechanism,
        (dimensions, values, per_design): (
            PyReadonlyArray1<'_, f64>,
            PyReadonlyArray1<'_, f64>,
            bool,
        ),
    ) -> PyResult<Self> {
        let dimensions = reserve::copied(&dimensions)?;
        let values = reserve::copied(&values)?;
        let size = original.dimensions().len();
        let designs = dimensions.len().checked_div(size).unwrap_or(1);
        let all = values.len() / inverse.drivers();
        let length = if per_design { all / designs.max(1) } else { all };
        Ok(Self { inverse, original, dimensions, values, per_design, designs, length })
    }

    /// Number of rows of all designs.
    pub(super) fn count(&self) -> usize {
        self.designs * self.length
    }

    fn dimensions_of(&self, design: usize) -> Vec<f64> {
        let columns = self.dimensions.chunks_exact(self.designs.max(1));
        columns.map(|column| column[design]).collect()
    }

    fn values_of(&self, design: usize, row: usize, rows: usize) -> &[f64] {
        let first = if self.per_design { design * self.length + row } else { row };
        let drivers = self.inverse.drivers();
        &self.values[first * drivers..][..rows * drivers]
    }

    /// All positions of every row.
    pub(super) fn find(
        &self,
        threads: Option<NonZeroUsize>,
        cancel: &AtomicBool,
    ) -> Result<Found, SolveError> {
        let blocks = self.length.div_ceil(BLOCK);
        let of_block = |index: usize| self.positions(index / blocks, index % blocks, cancel);
        let threads = threads.map(NonZeroUsize::get);
        let each = parallel_map(self.designs * blocks, 1, threads, cancel, &of_block);
        let each: Vec<Vec<Row>> = each.into_iter().collect::<Result<_, _>>()?;
        let (each, drivers) = (|| each.iter().flatten(), self.inverse.drivers());
        let most = each().map(|row| row.q.len() / drivers).max().unwrap_or(0);
        let mut found = Found { q: Vec::new(), most, counts: Vec::new(), status: Vec::new() };
        found.q.reserve_exact(self.count() * most * drivers);
        for row in each() {
            found.counts.push((row.q.len() / drivers).cast_signed() as i64);
            found.status.push(row.status as u8);
            found.q.extend(&row.q);
            found.q.extend(std::iter::repeat_n(f64::NAN, most * drivers - row.q.len()));
        }
        Ok(found)
    }

    /// The positions of a block of rows of a design.
    fn positions(
        &self,
        design: usize,
        block: usize,
        cancel: &AtomicBool,
    ) -> Result<Vec<Row>, SolveError> {
        let first = block * BLOCK;
        let count = BLOCK.min(self.length - first);
        let dimensions = self.dimensions_of(design);
        let finder = self.inverse.finder(self.original, &dimensions, Some(cancel))?;
        let failed = |status| Row { q: Vec::new(), status };
        let Some(mut finder) = finder else {
            return Ok(vec![failed(Status::BadDimension); count]);
        };
        let values = self.values_of(design, first, count).chunks_exact(self.inverse.drivers());
        let row = |values: &[f64]| {
            if values.iter().any(|value| !value.is_finite()) {
                return Ok(failed(Status::BadInput));
            }
            let answers = match finder.find(values) {
                Err(SolveError::CoordinateTooFar { .. }) => return Ok(failed(Status::Lost)),
                answers => answers?,
            };
            let status = match (answers.is_complete, answers.found.is_empty()) {
                (false, _) => Status::NotConverged,
                (true, true) => Status::Unreachable,
                (true, false) => Status::Ok,
            };
            let q = answers.found.into_iter().flat_map(|answer| answer.q).collect();
            Ok(Row { q, status })
        };
        values.map(row).collect()
    }

    /// Follows every design from a start on, one for all or one for each.
    pub(super) fn follow(
        &self,
        (signs, start): (&[i8], &[f64]),
        threads: Option<NonZeroUsize>,
        cancel: &AtomicBool,
    ) -> Result<(Vec<f64>, Vec<u8>), SolveError> {
        let drivers = self.inverse.drivers();
        let follow = |design: usize| -> Result<Vec<Followed>, SolveError> {
            let first = if start.len() == drivers { 0 } else { design * drivers };
            let dimensions = &self.dimensions_of(design);
            let q = &start[first..][..drivers];
            let start = Start { mechanism: self.original, dimensions, signs, q };
            self.inverse.follow(start, self.values_of(design, 0, self.length), Some(cancel))
        };
        let threads = threads.map(NonZeroUsize::get);
        let each = parallel_map(self.designs, 1, threads, cancel, &follow);
        if cancel.load(Ordering::Relaxed) {
            return Err(SolveError::Interrupted);
        }
        let (mut q, mut status) = (Vec::new(), Vec::new());
        for followed in each {
            for position in followed? {
                q.extend(position.q);
                status.push(position.status as u8);
            }
        }
        Ok((q, status))
    }
}
