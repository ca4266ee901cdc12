//! The accelerations of a few positions: `M q̈ = τ − b` by Cholesky's factors without roots, L D Lᵀ (Golub & Van
//! Loan 2013, section 4.1), a position in each lane.

use crate::math::lanes::{Mask, Real};

/// A pivot below this part of its diagonal entry is rounding: the mass matrix is singular there.
const SMALLEST_PIVOT: f64 = 8.0 * f64::EPSILON;

/// Replaces the right side by the solution, NaN where the matrix, of which the lower half is given row by row, is
/// not positive definite. The matrix is lost.
#[inline(always)]
pub(super) fn solve_positive<R: Real>(matrix: &mut [R], right: &mut [R]) {
    match (&mut *matrix, &mut *right) {
        ([inertia], [net]) => {
            let quotient = *net / *inertia;
            *net = R::select(R::ZERO.lt(*inertia), quotient, R::splat(f64::NAN));
        }
        // The compiler unrolls loops over a number of rows that it knows.
        ([a, b, c, d], [x, y]) => {
            let (mut entries, mut values) = ([*a, *b, *c, *d], [*x, *y]);
            eliminate(&mut entries, &mut values, 2);
            [*x, *y] = values;
        }
        (matrix, right) => {
            let n = right.len();
            eliminate(matrix, right, n);
        }
    }
}

/// The same for `n` rows.
#[inline(always)]
fn eliminate<R: Real>(matrix: &mut [R], right: &mut [R], n: usize) {
    let mut is_singular = R::Mask::NONE;
    // Below the diagonal are the entries of L D, in the rows that are done those of L; on it those of D⁻¹.
    for j in 0..n {
        let diagonal = matrix[j * n + j];
        let mut pivot = diagonal;
        for k in 0..j {
            let part = matrix[j * n + k] * matrix[k * n + k];
            pivot = pivot - matrix[j * n + k] * part;
            right[j] = right[j] - part * right[k];
            matrix[j * n + k] = part;
        }
        let least = diagonal.abs() * R::splat(SMALLEST_PIVOT);
        is_singular = is_singular.or(least.lt(pivot).not());
        matrix[j * n + j] = R::ONE / pivot;
        for i in j + 1..n {
            let mut entry = matrix[i * n + j];
            for k in 0..j {
                entry = entry - matrix[i * n + k] * matrix[j * n + k];
            }
            matrix[i * n + j] = entry;
        }
    }
    for i in (0..n).rev() {
        let mut sum = right[i] * matrix[i * n + i];
        for k in i + 1..n {
            sum = sum - matrix[k * n + i] * right[k];
        }
        right[i] = sum;
    }
    for value in right.iter_mut() {
        *value = R::select(is_singular, R::splat(f64::NAN), *value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The lower half of a positive definite matrix of n rows, with zeros above it.
    fn lower(n: usize) -> Vec<f64> {
        let entry = |i: usize, j: usize| {
            let part = 1.0 / (1.0 + (i + 2 * j) as f64);
            if i == j { 3.0 + part } else { part }
        };
        (0..n * n).map(|at| if at / n < at % n { 0.0 } else { entry(at / n, at % n) }).collect()
    }

    #[test]
    fn the_solution_fits_the_matrix() {
        for n in 1..6 {
            let matrix = lower(n);
            let right: Vec<f64> = (0..n).map(|i| 1.5 - i as f64).collect();
            let mut solved = right.clone();
            solve_positive(&mut matrix.clone(), &mut solved);
            for i in 0..n {
                let entry = |j: usize| matrix[i.max(j) * n + i.min(j)];
                let sum: f64 = (0..n).map(|j| entry(j) * solved[j]).sum();
                assert!((sum - right[i]).abs() < 1e-14, "{n} rows: {sum} is not {}", right[i]);
            }
        }
    }

    #[test]
    fn a_matrix_that_is_not_positive_definite_has_none() {
        for n in 1..5 {
            let mut singular = vec![1.0; n * n];
            singular[0] = if n == 1 { 0.0 } else { 1.0 };
            let mut indefinite = lower(n);
            indefinite[n * n - 1] = -1.0;
            for mut matrix in [singular, indefinite] {
                let mut right = vec![1.0; n];
                solve_positive(&mut matrix, &mut right);
                assert!(right.iter().all(|x| x.is_nan()), "{n} rows: {right:?}");
            }
        }
    }
}
