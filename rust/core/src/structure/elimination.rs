//! Sparse Gaussian elimination of closure equations: rank, null spaces, solutions.
//!
//! Markowitz's count (1957) chooses pivots among entries that are large in their row and column
//! (threshold pivoting; Duff, Erisman & Reid 2017, 5.3 and 7.2). Without such entries the largest
//! remaining entry is the pivot (complete pivoting), so that the elimination reveals the rank: the
//! remaining entries at its end count as zero. The closure of a linkage is a tree of small groups:
//! rows stay short, and the work grows little faster than the number of links.

use std::collections::BTreeSet;

use nalgebra::{DMatrix, DVector};

/// Least ratio of a stable pivot to the largest entry of its row and of its column: multipliers
/// are at most 8, which limits the growth of rounding errors.
const MIN_PIVOT_RATIO: f64 = 0.125;
/// Least stable pivot, relative to the column's length. Below it, complete pivoting takes over.
const MIN_PIVOT: f64 = 1.0e-3;

/// A sparse matrix by rows: column and value of each entry, in the order of columns.
pub(crate) type SparseRows = Vec<Vec<(usize, f64)>>;

/// One step of the elimination.
#[derive(Debug)]
struct Pivot {
    row: usize,
    column: usize,
    value: f64,
    /// The other entries of its row at that step.
    entries: Vec<(usize, f64)>,
    /// The rows from which its row was subtracted, with the factors.
    multipliers: Vec<(usize, f64)>,
}

/// The pivots of a completed elimination.
#[derive(Debug)]
pub(crate) struct Elimination {
    shape: (usize, usize),
    pivots: Vec<Pivot>,
}

/// The rows not yet eliminated.
struct Active {
    rows: SparseRows,
    /// For each column, the rows with an entry in it.
    rows_with: Vec<BTreeSet<usize>>,
    /// Rows by number of entries.
    by_count: BTreeSet<(usize, usize)>,
}

impl Active {
    fn new(rows: SparseRows, columns: usize) -> Self {
        let mut rows_with = vec![BTreeSet::new(); columns];
        let mut by_count = BTreeSet::new();
        for (row, entries) in rows.iter().enumerate() {
            by_count.insert((entries.len(), row));
            for &(column, _) in entries {
                rows_with[column].insert(row);
            }
        }
        Self { rows, rows_with, by_count }
    }

    fn entry(&self, row: usize, column: usize) -> f64 {
        let entries = &self.rows[row];
        entries.binary_search_by_key(&column, |e| e.0).map_or(0.0, |index| entries[index].1)
    }

    /// The next pivot; `None` if no entry is above `threshold`.
    fn choose_pivot(&self, threshold: f64) -> Option<(usize, usize)> {
        self.stable_pivot(threshold.max(MIN_PIVOT)).or_else(|| {
            let row_of = |&(_, row): &(usize, usize)| {
                self.rows[row].iter().map(move |&(column, value)| (value.abs(), row, column))
            };
            let largest = self.by_count.iter().flat_map(row_of).max_by(|a, b| a.0.total_cmp(&b.0));
            largest.filter(|x| x.0 > threshold).map(|(_, row, column)| (row, column))
        })
    }

    /// The stable entry in the sparsest row that has one and, within it, the sparsest column.
    fn stable_pivot(&self, threshold: f64) -> Option<(usize, usize)> {
        self.by_count.iter().find_map(|&(_, row)| {
            let entries = &self.rows[row];
            let largest = entries.iter().fold(0.0_f64, |greatest, e| greatest.max(e.1.abs()));
            let threshold = threshold.max(MIN_PIVOT_RATIO * largest);
            let is_stable = |&(column, value): &(usize, f64)| {
                let limit = value.abs() / MIN_PIVOT_RATIO;
                value.abs() >= threshold
                    && self.rows_with[column].iter().all(|&r| self.entry(r, column).abs() <= limit)
            };
            let stable = entries.iter().copied().filter(is_stable);
            stable
                .map(|(column, _)| (self.rows_with[column].len(), column))
                .min()
                .map(|x| (row, x.1))
        })
    }

    /// Removes the pivot's row and eliminates its column from the other rows.
    fn eliminate(&mut self, row: usize, column: usize) -> Pivot {
        let pivot_row = std::mem::take(&mut self.rows[row]);
        self.by_count.remove(&(pivot_row.len(), row));
        for &(c, _) in &pivot_row {
            self.rows_with[c].remove(&row);
        }
        let value = pivot_row.iter().find(|e| e.0 == column).map_or(1.0, |e| e.1);
        let entries: Vec<_> = pivot_row.into_iter().filter(|e| e.0 != column).collect();
        let mut multipliers = Vec::new();
        for target in std::mem::take(&mut self.rows_with[column]) {
            let multiplier = self.entry(target, column) / value;
            multipliers.push((target, multiplier));
            self.by_count.remove(&(self.rows[target].len(), target));
            let updated = subtract_multiple(&self.rows[target], &entries, multiplier, column);
            for &(c, _) in &updated {
                self.rows_with[c].insert(target);
            }
            self.by_count.insert((updated.len(), target));
            self.rows[target] = updated;
        }
        Pivot { row, column, value, entries, multipliers }
    }
}

/// `row − multiplier · pivot_row`, without the entry in `column`.
fn subtract_multiple(
    row: &[(usize, f64)],
    pivot_row: &[(usize, f64)],
    multiplier: f64,
    column: usize,
) -> Vec<(usize, f64)> {
    let mut result = Vec::with_capacity(row.len() + pivot_row.len());
    let (mut i, mut j) = (0, 0);
    while i < row.len() || j < pivot_row.len() {
        let (a, b) = (row.get(i), pivot_row.get(j));
        let current = a.map_or(usize::MAX, |e| e.0).min(b.map_or(usize::MAX, |e| e.0));
        let mut value = 0.0;
        if let Some(&(_, entry)) = a.filter(|e| e.0 == current) {
            value += entry;
            i += 1;
        }
        if let Some(&(_, entry)) = b.filter(|e| e.0 == current) {
            value -= multiplier * entry;
            j += 1;
        }
        if current != column {
            result.push((current, value));
        }
    }
    result
}

impl Elimination {
    /// Eliminates until no entry is above `threshold`. `None` once `cancelled`, called before
    /// each pivot, returns true.
    pub(crate) fn of(
        rows: SparseRows,
        columns: usize,
        threshold: f64,
        cancelled: impl Fn() -> bool,
    ) -> Option<Self> {
        let shape = (rows.len(), columns);
        let mut active = Active::new(rows, columns);
        let mut pivots = Vec::new();
        while let Some((row, column)) = active.choose_pivot(threshold) {
            if cancelled() {
                return None;
            }
            pivots.push(active.eliminate(row, column));
        }
        Some(Self { shape, pivots })
    }

    /// Rank of the matrix.
    pub(crate) fn rank(&self) -> usize {
        self.pivots.len()
    }

    /// Least pivot; infinite without a pivot.
    pub(crate) fn least_pivot(&self) -> f64 {
        self.pivots.iter().map(|pivot| pivot.value.abs()).fold(f64::INFINITY, f64::min)
    }

    /// Basis of the null space: columns scaled to a largest entry of 1.
    pub(crate) fn null_space(&self) -> DMatrix<f64> {
        let free = complement(self.pivots.iter().map(|pivot| pivot.column), self.shape.1);
        let mut basis = DMatrix::zeros(self.shape.1, free.len());
        let zero = DVector::zeros(self.pivots.len());
        for (mut vector, free) in basis.column_iter_mut().zip(free) {
            vector[free] = 1.0;
            self.substitute_back(&zero, vector.as_mut_slice());
            vector /= vector.amax();
        }
        basis
    }

    /// Basis of the left null space: columns scaled to a largest entry of 1.
    pub(crate) fn left_null_space(&self) -> DMatrix<f64> {
        let free = complement(self.pivots.iter().map(|pivot| pivot.row), self.shape.0);
        let mut basis = DMatrix::zeros(self.shape.0, free.len());
        for (mut vector, free) in basis.column_iter_mut().zip(free) {
            vector[free] = 1.0;
            for pivot in self.pivots.iter().rev() {
                let sum: f64 = pivot.multipliers.iter().map(|&(row, m)| m * vector[row]).sum();
                vector[pivot.row] = -sum;
            }
            vector /= vector.amax();
        }
        basis
    }

    /// The solution with zero for the free unknowns. Equations that depend on others are ignored.
    pub(crate) fn solve(&self, rhs: &DVector<f64>) -> DVector<f64> {
        let mut rhs = rhs.clone();
        for pivot in &self.pivots {
            for &(row, multiplier) in &pivot.multipliers {
                rhs[row] -= multiplier * rhs[pivot.row];
            }
        }
        let of_pivots =
            DVector::from_iterator(self.pivots.len(), self.pivots.iter().map(|p| rhs[p.row]));
        let mut solution = DVector::zeros(self.shape.1);
        self.substitute_back(&of_pivots, solution.as_mut_slice());
        solution
    }

    /// Computes the unknowns of the pivots from the right-hand sides and the free unknowns.
    fn substitute_back(&self, rhs: &DVector<f64>, solution: &mut [f64]) {
        for (pivot, rhs) in self.pivots.iter().zip(rhs.iter()).rev() {
            let solved_part: f64 =
                pivot.entries.iter().map(|&(c, value)| value * solution[c]).sum();
            solution[pivot.column] = (rhs - solved_part) / pivot.value;
        }
    }
}

/// The numbers below `count` that are not among `excluded`.
fn complement(excluded: impl Iterator<Item = usize>, count: usize) -> Vec<usize> {
    let excluded: BTreeSet<usize> = excluded.collect();
    (0..count).filter(|i| !excluded.contains(i)).collect()
}
