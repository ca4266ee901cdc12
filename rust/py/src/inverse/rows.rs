//! The inverse question for many designs and values.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};

use assur::{Followed, Inverse, Mechanism, SolveError, Start, Status};
use numpy::PyReadonlyArray1;
use pyo3::PyResult;

use crate::parallel_map::parallel_map;
use crate::reserve;

/// Rows for which another thread pays off.
const MIN_PER_THREAD: usize = 16;

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
        let positions_of = |index: usize| {
            let (design, row) = (index / self.length, index % self.length);
            self.positions(&self.dimensions_of(design), self.values_of(design, row, 1), cancel)
        };
        let threads = threads.map(NonZeroUsize::get);
        let each = parallel_map(self.count(), MIN_PER_THREAD, threads, cancel, &positions_of);
        let each: Vec<(Vec<f64>, Status)> = each.into_iter().collect::<Result<_, _>>()?;
        let drivers = self.inverse.drivers();
        let most = each.iter().map(|(q, _)| q.len() / drivers).max().unwrap_or(0);
        let mut found = Found { q: Vec::new(), most, counts: Vec::new(), status: Vec::new() };
        found.q.reserve_exact(each.len() * most * drivers);
        for (q, status) in each {
            found.counts.push((q.len() / drivers).cast_signed() as i64);
            found.status.push(status as u8);
            let missing = most * drivers - q.len();
            found.q.extend(q);
            found.q.extend(std::iter::repeat_n(f64::NAN, missing));
        }
        Ok(found)
    }

    /// The positions of a row, one after another, and its status.
    fn positions(
        &self,
        dimensions: &[f64],
        values: &[f64],
        cancel: &AtomicBool,
    ) -> Result<(Vec<f64>, Status), SolveError> {
        if self.original.dimensions().first_fault(dimensions).is_some() {
            return Ok((Vec::new(), Status::BadDimension));
        }
        if values.iter().any(|value| !value.is_finite()) {
            return Ok((Vec::new(), Status::BadInput));
        }
        let answers = match self.inverse.find(self.original, dimensions, values, Some(cancel)) {
            Err(SolveError::CoordinateTooFar { .. }) => return Ok((Vec::new(), Status::Lost)),
            answers => answers?,
        };
        let status = match (answers.is_complete, answers.found.is_empty()) {
            (false, _) => Status::NotConverged,
            (true, true) => Status::Unreachable,
            (true, false) => Status::Ok,
        };
        Ok((answers.found.into_iter().flat_map(|answer| answer.q).collect(), status))
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
