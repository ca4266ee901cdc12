//! Small matrices, inverted with pivots of each lane's own.

use super::{Mask, Real};

/// Inverts the first `n` columns of `n` rows of `2 n` numbers into the other `n`
/// (Gauss & Jordan). A lane's pivots depend on its own numbers alone; a singular matrix leaves
/// infinities or no numbers. Gives the determinant.
#[inline(always)]
pub fn invert<R: Real>(matrix: &mut [R], n: usize) -> R {
    let width = 2 * n;
    for row in 0..n {
        for column in 0..n {
            matrix[row * width + n + column] = if row == column { R::ONE } else { R::ZERO };
        }
    }
    let mut determinant = R::ONE;
    for pivot in 0..n {
        for row in pivot + 1..n {
            let (here, there) = (matrix[pivot * width + pivot], matrix[row * width + pivot]);
            let swap = here.abs().lt(there.abs());
            if !swap.any() {
                continue;
            }
            for column in pivot..width {
                let (a, b) = (matrix[pivot * width + column], matrix[row * width + column]);
                matrix[pivot * width + column] = R::select(swap, b, a);
                matrix[row * width + column] = R::select(swap, a, b);
            }
            determinant = R::select(swap, -determinant, determinant);
        }
        let head = matrix[pivot * width + pivot];
        determinant = determinant * head;
        let per = R::ONE / head;
        for column in pivot + 1..width {
            matrix[pivot * width + column] = matrix[pivot * width + column] * per;
        }
        for row in 0..n {
            if row == pivot {
                continue;
            }
            let factor = matrix[row * width + pivot];
            for column in pivot + 1..width {
                let less = factor * matrix[pivot * width + column];
                matrix[row * width + column] = matrix[row * width + column] - less;
            }
        }
    }
    determinant
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::{LANES, Lanes};
    use nalgebra::DMatrix;

    /// A matrix of numbers that look random, the same for a seed.
    fn matrix(n: usize, seed: u64) -> DMatrix<f64> {
        let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
        DMatrix::from_fn(n, n, |_, _| {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 11) as f64 / 2.0_f64.powi(52) - 1.0
        })
    }

    fn work(a: &DMatrix<f64>) -> Vec<f64> {
        let n = a.nrows();
        let mut work = vec![0.0; 2 * n * n];
        for row in 0..n {
            for column in 0..n {
                work[row * 2 * n + column] = a[(row, column)];
            }
        }
        work
    }

    #[test]
    fn the_product_is_the_unit_matrix() {
        for n in 1..=12 {
            for seed in 1..40 {
                let a = matrix(n, seed);
                let mut rows = work(&a);
                let determinant = invert(&mut rows, n);
                let inverse = DMatrix::from_fn(n, n, |r, c| rows[r * 2 * n + n + c]);
                let condition = a.norm() * inverse.norm();
                let error = (&a * &inverse - DMatrix::identity(n, n)).norm();
                assert!(error <= 16.0 * f64::EPSILON * condition, "{n} {seed}: {error}");
                let by_nalgebra = a.determinant();
                let close = (determinant - by_nalgebra).abs();
                assert!(
                    close <= 1e-12 * a.norm().powi(i32::try_from(n).unwrap_or(0)),
                    "{n} {seed}"
                );
            }
        }
    }

    #[test]
    fn lanes_have_the_bits_of_the_scalar() {
        for n in [1, 2, 3, 5, 6] {
            let ones: Vec<Vec<f64>> = (0..LANES as u64).map(|s| work(&matrix(n, s + 7))).collect();
            let mut eight: Vec<Lanes> =
                (0..2 * n * n).map(|i| Lanes::from_lanes(|lane| ones[lane][i])).collect();
            let determinant = invert(&mut eight, n);
            for (lane, mut one) in ones.into_iter().enumerate() {
                assert_eq!(invert(&mut one, n).to_bits(), determinant.lane(lane).to_bits());
                for row in 0..n {
                    for column in n..2 * n {
                        let i = row * 2 * n + column;
                        assert_eq!(one[i].to_bits(), eight[i].lane(lane).to_bits());
                    }
                }
            }
        }
    }

    #[test]
    fn a_zero_on_the_diagonal_is_no_matter() {
        let mut rows = [0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0];
        assert!((invert(&mut rows, 2) + 2.0).abs() < 1e-15);
        assert_eq!([rows[2], rows[3], rows[6], rows[7]], [0.0, 0.5, 1.0, 0.0]);
    }
}
