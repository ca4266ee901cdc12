//! Rank of a system of closure equations, with its motions and self-stresses.

use nalgebra::{DMatrix, DVector};

use super::elimination::{Elimination, SparseRows};
use crate::description::error::Interrupted;

/// Rank and null spaces of a system.
#[derive(Debug, Clone)]
pub(crate) struct Rank {
    /// Unknowns minus rank.
    pub mobility: usize,
    /// Equations minus rank.
    pub excess: usize,
    /// Basis of the motions that the equations allow: a column each (rows: unknowns).
    pub motions: DMatrix<f64>,
    /// Basis of the self-stresses, the dependencies of equations: a column each (rows:
    /// equations).
    pub stresses: DMatrix<f64>,
    /// Least pivot that does not count as zero.
    pub least_pivot: f64,
}

/// Rank of a matrix with columns scaled to length 1; entries up to `threshold` count as zero.
///
/// # Errors
///
/// [`Interrupted`] once `cancelled` returns true.
pub(crate) fn rank(
    mut matrix: SparseRows,
    unknowns: usize,
    threshold: f64,
    cancelled: impl Fn() -> bool,
) -> Result<Rank, Interrupted> {
    let equations = matrix.len();
    let scale = scale_columns(&mut matrix, unknowns);
    let elimination = Elimination::of(matrix, unknowns, threshold, cancelled).ok_or(Interrupted)?;
    let rank = elimination.rank();
    let mut motions = elimination.null_space();
    for (mut row, factor) in motions.row_iter_mut().zip(scale) {
        row *= factor;
    }
    let stresses = elimination.left_null_space();
    Ok(Rank {
        mobility: unknowns - rank,
        excess: equations - rank,
        motions,
        stresses,
        least_pivot: elimination.least_pivot(),
    })
}

/// Solves `matrix · x = rhs`, ignoring equations that depend on others; entries up to `threshold`
/// count as zero.
///
/// # Errors
///
/// [`Interrupted`] once `cancelled` returns true.
pub(crate) fn solve(
    matrix: SparseRows,
    unknowns: usize,
    threshold: f64,
    rhs: &DVector<f64>,
    cancelled: impl Fn() -> bool,
) -> Result<DVector<f64>, Interrupted> {
    let elimination = Elimination::of(matrix, unknowns, threshold, cancelled).ok_or(Interrupted)?;
    Ok(elimination.solve(rhs))
}

/// Scales columns to length 1 and returns the factors.
fn scale_columns(matrix: &mut SparseRows, unknowns: usize) -> Vec<f64> {
    let mut squares = vec![0.0; unknowns];
    for &(column, value) in matrix.iter().flatten() {
        squares[column] += value * value;
    }
    let factor = |square: f64| if square > 0.0 { 1.0 / square.sqrt() } else { 1.0 };
    let scale: Vec<f64> = squares.into_iter().map(factor).collect();
    for (column, value) in matrix.iter_mut().flatten() {
        *value *= scale[*column];
    }
    scale
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::tolerance::RANK;

    /// A sparse pseudo-random matrix with entries of order 1; some rows and columns are sums of
    /// others.
    fn matrix(seed: u64) -> (SparseRows, usize) {
        let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
        let mut next = move |below: usize| {
            state ^= state >> 12;
            state ^= state << 25;
            state ^= state >> 27;
            let high = state.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 33;
            usize::try_from(high).expect("31 bits") % below
        };
        let (m, n) = (12 + next(20), 12 + next(20));
        let mut all = DMatrix::<f64>::zeros(m, n);
        for row in 0..m {
            for _ in 0..=next(3) {
                all[(row, next(n))] = 0.25 * (next(17) as f64 - 8.0);
            }
        }
        for _ in 0..next(4) {
            let (a, b, c) = (next(m), next(m), next(m));
            let sum = all.row(a) + all.row(b);
            all.set_row(c, &sum);
            let (a, b, c) = (next(n), next(n), next(n));
            let sum = all.column(a) + all.column(b);
            all.set_column(c, &sum);
        }
        let entries = |row: usize| (0..n).map(move |c| (row, c));
        let rows = (0..m).map(|row| {
            let kept = entries(row).filter(|&place| all[place] != 0.0);
            kept.map(|place| (place.1, all[place])).collect()
        });
        (rows.collect(), n)
    }

    fn dense(rows: &SparseRows, n: usize) -> DMatrix<f64> {
        let mut all = DMatrix::zeros(rows.len(), n);
        for (row, entries) in rows.iter().enumerate() {
            for &(column, value) in entries {
                all[(row, column)] = value;
            }
        }
        all
    }

    /// Number of singular values above [`RANK`] after scaling the columns to length 1.
    fn rank_by_singular_values(mut all: DMatrix<f64>) -> usize {
        for mut column in all.column_iter_mut() {
            let norm = column.norm();
            if norm > 0.0 {
                column /= norm;
            }
        }
        // Eigenvalues of AᵀA would lose half the digits. Those of [0 A; Aᵀ 0] are the singular
        // values of A and their negatives (Golub & Van Loan 8.6).
        let (m, n) = all.shape();
        let mut symmetric = DMatrix::zeros(m + n, m + n);
        symmetric.view_mut((0, m), (m, n)).copy_from(&all);
        symmetric.view_mut((m, 0), (n, m)).copy_from(&all.transpose());
        symmetric.symmetric_eigenvalues().iter().filter(|&&value| value > RANK).count()
    }

    #[test]
    fn elimination_finds_the_same_rank_as_singular_values() {
        let mut deficient = 0;
        for seed in 1..400 {
            let (rows, n) = matrix(seed);
            let (all, m) = (dense(&rows, n), rows.len());
            let actual = rank(rows, n, RANK, || false).expect("not cancelled");
            let expected = rank_by_singular_values(all.clone());
            assert_eq!((actual.mobility, actual.excess), (n - expected, m - expected), "{seed}");
            deficient += usize::from(actual.mobility.min(actual.excess) > 0);
            assert!((&all * &actual.motions).amax() < 1e-12, "{seed}");
            assert!((actual.stresses.transpose() * &all).amax() < 1e-12, "{seed}");
            for (span, dimension) in
                [(&actual.motions, actual.mobility), (&actual.stresses, actual.excess)]
            {
                assert_eq!(span.ncols(), dimension, "{seed}");
                assert!(dimension == 0 || span.rank(1e-9) == dimension, "{seed}");
            }
        }
        assert!(deficient > 100, "{deficient} of them are deficient");
    }

    #[test]
    fn elimination_can_be_cancelled() {
        let (rows, n) = matrix(1);
        assert_eq!(rank(rows, n, RANK, || true).err(), Some(Interrupted));
    }
}
