//! Sparse Gaussian elimination of closure equations: rank, null spaces, solutions.
//!
//! Pivots are chosen by Markowitz's count (1957) among entries that are large in their row and
//! column (threshold pivoting; Duff, Erisman & Reid 2017, 5.3 and 7.2); where none is safe, the
//! greatest entry that is left (complete pivoting). What is then left is zero: elimination with
//! complete pivoting shows the rank. The closure of a linkage is a tree of small groups, so that
//! rows stay short and the work grows little faster than the number of links.

use std::collections::BTreeSet;

use nalgebra::{DMatrix, DVector};

/// A pivot is at least this part of the greatest entry of its row and of its column: no multiplier
/// is above 8, so rounding does not grow.
const RELATIVE: f64 = 0.125;
/// And at least this part of a column's length: below, complete pivoting decides.
const ABSOLUTE: f64 = 1.0e-3;

/// A sparse matrix by rows: column and value of every entry.
pub(crate) type SparseRows = Vec<Vec<(usize, f64)>>;

/// One step of the elimination.
#[derive(Debug)]
struct Pivot {
    row: usize,
    column: usize,
    value: f64,
    /// The other entries of the row when it was chosen.
    entries: Vec<(usize, f64)>,
    /// How often the row was subtracted from others.
    multipliers: Vec<(usize, f64)>,
}

/// A matrix after elimination.
#[derive(Debug)]
pub(crate) struct Elimination {
    shape: (usize, usize),
    pivots: Vec<Pivot>,
}

/// Rows under elimination, with the rows that each column touches.
struct Active {
    rows: SparseRows,
    touched_by: Vec<BTreeSet<usize>>,
    /// Rows by number of entries.
    by_count: BTreeSet<(usize, usize)>,
}

impl Active {
    fn new(rows: SparseRows, columns: usize) -> Self {
        let mut touched_by = vec![BTreeSet::new(); columns];
        let mut by_count = BTreeSet::new();
        for (row, entries) in rows.iter().enumerate() {
            by_count.insert((entries.len(), row));
            for &(column, _) in entries {
                touched_by[column].insert(row);
            }
        }
        Self { rows, touched_by, by_count }
    }

    fn entry(&self, row: usize, column: usize) -> f64 {
        let entries = &self.rows[row];
        entries.binary_search_by_key(&column, |e| e.0).map_or(0.0, |place| entries[place].1)
    }

    /// The next pivot; none if no entry is above `least`.
    fn choose(&self, least: f64) -> Option<(usize, usize)> {
        self.safe(least.max(ABSOLUTE)).or_else(|| {
            let row_of = |&(_, row): &(usize, usize)| {
                self.rows[row].iter().map(move |&(column, value)| (value.abs(), row, column))
            };
            let greatest = self.by_count.iter().flat_map(row_of).max_by(|a, b| a.0.total_cmp(&b.0));
            greatest.filter(|x| x.0 > least).map(|(_, row, column)| (row, column))
        })
    }

    /// The sparsest row that has a safe entry, and of its safe entries that in the sparsest column.
    fn safe(&self, least: f64) -> Option<(usize, usize)> {
        self.by_count.iter().find_map(|&(_, row)| {
            let entries = &self.rows[row];
            let greatest = entries.iter().fold(0.0_f64, |most, e| most.max(e.1.abs()));
            let least = least.max(RELATIVE * greatest);
            let is_safe = |&(column, value): &(usize, f64)| {
                let most = value.abs() / RELATIVE;
                value.abs() >= least
                    && self.touched_by[column].iter().all(|&r| self.entry(r, column).abs() <= most)
            };
            let safe = entries.iter().copied().filter(is_safe);
            safe.map(|(column, _)| (self.touched_by[column].len(), column))
                .min()
                .map(|x| (row, x.1))
        })
    }

    /// Takes a row out and its column out of all others.
    fn eliminate(&mut self, row: usize, column: usize) -> Pivot {
        let own = std::mem::take(&mut self.rows[row]);
        self.by_count.remove(&(own.len(), row));
        for &(c, _) in &own {
            self.touched_by[c].remove(&row);
        }
        let value = own.iter().find(|e| e.0 == column).map_or(1.0, |e| e.1);
        let entries: Vec<_> = own.into_iter().filter(|e| e.0 != column).collect();
        let mut multipliers = Vec::new();
        for other in std::mem::take(&mut self.touched_by[column]) {
            let multiplier = self.entry(other, column) / value;
            multipliers.push((other, multiplier));
            self.by_count.remove(&(self.rows[other].len(), other));
            let rest = subtracted(&self.rows[other], &entries, multiplier, column);
            for &(c, _) in &rest {
                self.touched_by[c].insert(other);
            }
            self.by_count.insert((rest.len(), other));
            self.rows[other] = rest;
        }
        Pivot { row, column, value, entries, multipliers }
    }
}

/// A row without a column, less a multiple of another (both in the order of columns).
fn subtracted(
    row: &[(usize, f64)],
    other: &[(usize, f64)],
    multiplier: f64,
    column: usize,
) -> Vec<(usize, f64)> {
    let mut rest = Vec::with_capacity(row.len() + other.len());
    let (mut i, mut j) = (0, 0);
    while i < row.len() || j < other.len() {
        let (a, b) = (row.get(i), other.get(j));
        let at = a.map_or(usize::MAX, |e| e.0).min(b.map_or(usize::MAX, |e| e.0));
        let mut value = 0.0;
        if let Some(&(_, own)) = a.filter(|e| e.0 == at) {
            value += own;
            i += 1;
        }
        if let Some(&(_, taken)) = b.filter(|e| e.0 == at) {
            value -= multiplier * taken;
            j += 1;
        }
        if at != column {
            rest.push((at, value));
        }
    }
    rest
}

impl Elimination {
    /// Eliminates until no entry is above `least`; `stop` is asked before each pivot, None if it
    /// says so.
    pub(crate) fn of(
        rows: SparseRows,
        columns: usize,
        least: f64,
        stop: impl Fn() -> bool,
    ) -> Option<Self> {
        let shape = (rows.len(), columns);
        let mut active = Active::new(rows, columns);
        let mut pivots = Vec::new();
        while let Some((row, column)) = active.choose(least) {
            if stop() {
                return None;
            }
            pivots.push(active.eliminate(row, column));
        }
        Some(Self { shape, pivots })
    }

    /// The rank.
    pub(crate) fn rank(&self) -> usize {
        self.pivots.len()
    }

    /// Columns that span what the matrix maps to zero, with greatest entry 1.
    pub(crate) fn null_space(&self) -> DMatrix<f64> {
        let free = without(self.pivots.iter().map(|pivot| pivot.column), self.shape.1);
        let mut all = DMatrix::zeros(self.shape.1, free.len());
        let zero = DVector::zeros(self.pivots.len());
        for (mut vector, free) in all.column_iter_mut().zip(free) {
            vector[free] = 1.0;
            self.substitute_back(&zero, vector.as_mut_slice());
            vector /= vector.amax();
        }
        all
    }

    /// Columns that span what maps the matrix to zero from the left, with greatest entry 1.
    pub(crate) fn left_null_space(&self) -> DMatrix<f64> {
        let free = without(self.pivots.iter().map(|pivot| pivot.row), self.shape.0);
        let mut all = DMatrix::zeros(self.shape.0, free.len());
        for (mut vector, free) in all.column_iter_mut().zip(free) {
            vector[free] = 1.0;
            for pivot in self.pivots.iter().rev() {
                let sum: f64 = pivot.multipliers.iter().map(|&(row, m)| m * vector[row]).sum();
                vector[pivot.row] = -sum;
            }
            vector /= vector.amax();
        }
        all
    }

    /// A solution for a right-hand side, with zero for the unknowns that are free; equations that
    /// depend on others are left unmet.
    pub(crate) fn solve(&self, right: &DVector<f64>) -> DVector<f64> {
        let mut right = right.clone();
        for pivot in &self.pivots {
            for &(row, multiplier) in &pivot.multipliers {
                right[row] -= multiplier * right[pivot.row];
            }
        }
        let of_pivots =
            DVector::from_iterator(self.pivots.len(), self.pivots.iter().map(|p| right[p.row]));
        let mut all = DVector::zeros(self.shape.1);
        self.substitute_back(&of_pivots, all.as_mut_slice());
        all
    }

    /// The unknowns of the pivots, from their right-hand sides and the other unknowns.
    fn substitute_back(&self, right: &DVector<f64>, all: &mut [f64]) {
        for (pivot, right) in self.pivots.iter().zip(right.iter()).rev() {
            let known: f64 = pivot.entries.iter().map(|&(c, value)| value * all[c]).sum();
            all[pivot.column] = (right - known) / pivot.value;
        }
    }
}

/// The numbers below `count` that are not among some.
fn without(some: impl Iterator<Item = usize>, count: usize) -> Vec<usize> {
    let some: BTreeSet<usize> = some.collect();
    (0..count).filter(|i| !some.contains(i)).collect()
}
