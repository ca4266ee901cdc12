//! The accelerations of a few positions: `M q̈ = τ − b` by Cholesky's factors, a position in each lane.

use crate::math::lanes::{Mask, Real};

/// A pivot below this part of its diagonal entry is rounding: the mass matrix is singular there.
const SMALLEST_PIVOT: f64 = 8.0 * f64::EPSILON;

/// Replaces the lower half of a matrix, row by row, by its factor, and the right side by the solution: NaN
/// where the matrix is not positive definite.
#[inline(always)]
pub(super) fn solve_positive<R: Real>(matrix: &mut [R], right: &mut [R]) {
    let n = right.len();
    if let ([inertia], [net]) = (&*matrix, &mut *right) {
        let quotient = *net / *inertia;
        *net = R::select(R::ZERO.lt(*inertia), quotient, R::splat(f64::NAN));
        return;
    }
    let mut is_singular = R::Mask::NONE;
    for j in 0..n {
        let diagonal = matrix[j * n + j];
        let mut pivot = diagonal;
        for k in 0..j {
            pivot = pivot - matrix[j * n + k] * matrix[j * n + k];
        }
        let least = diagonal.abs() * R::splat(SMALLEST_PIVOT);
        is_singular = is_singular.or(least.lt(pivot).not());
        let root = pivot.sqrt();
        matrix[j * n + j] = root;
        for i in j + 1..n {
            let mut entry = matrix[i * n + j];
            for k in 0..j {
                entry = entry - matrix[i * n + k] * matrix[j * n + k];
            }
            matrix[i * n + j] = entry / root;
        }
    }
    for i in 0..n {
        let mut sum = right[i];
        for k in 0..i {
            sum = sum - matrix[i * n + k] * right[k];
        }
        right[i] = sum / matrix[i * n + i];
    }
    for i in (0..n).rev() {
        let mut sum = right[i];
        for k in i + 1..n {
            sum = sum - matrix[k * n + i] * right[k];
        }
        right[i] = sum / matrix[i * n + i];
    }
    for value in right.iter_mut() {
        *value = R::select(is_singular, R::splat(f64::NAN), *value);
    }
}
