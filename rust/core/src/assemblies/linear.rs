//! Linear equations between complex numbers, in lanes.

use crate::math::lanes::{Mask, Real};
use crate::math::vector::Vector;

/// Solves `n` equations, rows of `n` factors and the right-hand side, by Gauss's elimination with
/// separate pivots in each lane; the right-hand sides become the solution. A singular matrix gives
/// infinities or NaN.
#[inline(always)]
pub(super) fn solve<R: Real>(matrix: &mut [Vector<R>], n: usize) {
    let width = n + 1;
    for pivot in 0..n {
        for row in pivot + 1..n {
            let (upper, lower) = matrix.split_at_mut(row * width);
            let (pivot_row, below) = (&mut upper[pivot * width..][..width], &mut lower[..width]);
            let swap = pivot_row[pivot].norm2().lt(below[pivot].norm2());
            if !swap.any() {
                continue;
            }
            for (a, b) in pivot_row[pivot..].iter_mut().zip(&mut below[pivot..]) {
                (*a, *b) = (select(swap, *b, *a), select(swap, *a, *b));
            }
        }
        let inverse = inverse(matrix[pivot * width + pivot]);
        let (upper, lower) = matrix.split_at_mut((pivot + 1) * width);
        let pivot_row = &mut upper[pivot * width..];
        for entry in &mut pivot_row[pivot + 1..width] {
            *entry = *entry * inverse;
        }
        for row in lower.chunks_exact_mut(width) {
            let factor = row[pivot];
            for (entry, pivot_entry) in
                row[pivot + 1..].iter_mut().zip(&pivot_row[pivot + 1..width])
            {
                *entry = *entry - factor * *pivot_entry;
            }
        }
    }
    for row in (0..n).rev() {
        let mut sum = matrix[row * width + n];
        for column in row + 1..n {
            sum = sum - matrix[row * width + column] * matrix[column * width + n];
        }
        matrix[row * width + n] = sum;
    }
}

/// `yes` where the mask is true, else `no`.
#[inline(always)]
pub(super) fn select<R: Real>(mask: R::Mask, yes: Vector<R>, no: Vector<R>) -> Vector<R> {
    Vector::new(R::select(mask, yes.x, no.x), R::select(mask, yes.y, no.y))
}

/// The inverse of a number.
#[inline(always)]
pub(super) fn inverse<R: Real>(number: Vector<R>) -> Vector<R> {
    number.conj().scale(R::ONE / number.norm2())
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::*;

    #[test]
    fn solutions_satisfy_the_equations() {
        let mut random = Random(1);
        for n in 1..8 {
            let mut matrix: Vec<Vector> = (0..n * (n + 1)).map(|_| random.complex()).collect();
            // The first pivot vanishes.
            matrix[0] = Vector::ZERO;
            if n == 1 {
                continue;
            }
            let original = matrix.clone();
            solve(&mut matrix, n);
            for row in original.chunks_exact(n + 1) {
                let mut sum = row[n];
                for (column, &factor) in row[..n].iter().enumerate() {
                    sum = sum - factor * matrix[column * (n + 1) + n];
                }
                assert!(sum.norm() < 1e-12, "{n}: {sum:?}");
            }
        }
    }
}
