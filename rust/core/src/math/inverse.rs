//! Inverses of small matrices, with separate pivoting in each lane.

use super::lanes::{Mask, Real};

/// Inverts the first `n` columns of `n` rows of `2 n` numbers into the other `n` columns, for `G`
/// groups at once, and returns the determinants. Each lane depends on its own numbers only; a
/// singular matrix gives infinities or NaN.
#[inline(always)]
pub(crate) fn invert<R: Real, const G: usize>(matrix: &mut [[R; G]], n: usize) -> [R; G] {
    if n == 3 { by_minors(matrix) } else { by_pivots(matrix, n) }
}

/// Three rows: minors over the determinant, without pivots.
///
/// Pivots are not needed. Scaling a row changes minors and determinant only by its factor, so let the rows
/// have length 1 and the matrix the singular values σ₁ ≥ σ₂ ≥ σ₃; then σ₁ ≥ 1. A minor is the
/// difference of two products, good to 2 u (by Cauchy and Schwarz both products together are at most
/// 1). All minors together are σ₁ σ₂ or more, so they are good to 6 u/σ₂ ≤ 6 u ‖A⁻¹‖, as by pivots. The
/// determinant σ₁ σ₂ σ₃ is a sum of three entries times minors, good to 8 u; so all entries of the
/// inverse have a factor 1 + ε in common, |ε| ≤ 8 u/(σ₂ σ₃) ≤ 8 u ‖A⁻¹‖². Such a factor does not affect
/// Newton's iteration. In an analogue it makes an error of 8 u κ², within the 64 u κ² of
/// [`crate::math::tolerance::ANALOGUE_PER_CONDITION_SQUARED`]; and where ε is not small, κ is beyond
/// [`crate::math::tolerance::SINGULAR_CONDITION`], from which on a position is singular in any case.
#[inline(always)]
fn by_minors<R: Real, const G: usize>(matrix: &mut [[R; G]]) -> [R; G] {
    let Some((matrix, _)) = matrix.split_first_chunk_mut::<18>() else { return [R::ZERO; G] };
    let mut determinant = [R::ZERO; G];
    for g in 0..G {
        let [a, b, c] = [matrix[0][g], matrix[1][g], matrix[2][g]];
        let [d, e, f] = [matrix[6][g], matrix[7][g], matrix[8][g]];
        let [p, q, r] = [matrix[12][g], matrix[13][g], matrix[14][g]];
        let (first, second, third) = (e * r - f * q, f * p - d * r, d * q - e * p);
        let det = a * first + b * second + c * third;
        let inv_det = R::ONE / det;
        matrix[3][g] = first * inv_det;
        matrix[9][g] = second * inv_det;
        matrix[15][g] = third * inv_det;
        matrix[4][g] = (c * q - b * r) * inv_det;
        matrix[10][g] = (a * r - c * p) * inv_det;
        matrix[16][g] = (b * p - a * q) * inv_det;
        matrix[5][g] = (b * f - c * e) * inv_det;
        matrix[11][g] = (c * d - a * f) * inv_det;
        matrix[17][g] = (a * e - b * d) * inv_det;
        determinant[g] = det;
    }
    determinant
}

/// Gauss-Jordan elimination, each lane choosing its own pivots.
#[inline(always)]
fn by_pivots<R: Real, const G: usize>(matrix: &mut [[R; G]], n: usize) -> [R; G] {
    let width = 2 * n;
    for row in 0..n {
        for column in 0..n {
            let entry = if row == column { R::ONE } else { R::ZERO };
            matrix[row * width + n + column] = [entry; G];
        }
    }
    let mut determinant = [R::ONE; G];
    for pivot in 0..n {
        for row in pivot + 1..n {
            let (upper, lower) = matrix.split_at_mut(row * width);
            let (pivot_row, below) = (&mut upper[pivot * width..][..width], &mut lower[..width]);
            let mut swap = [R::Mask::NONE; G];
            let mut any = false;
            for g in 0..G {
                swap[g] = pivot_row[pivot][g].abs().lt(below[pivot][g].abs());
                any |= swap[g].any();
            }
            if !any {
                continue;
            }
            for (upper, lower) in pivot_row[pivot..].iter_mut().zip(&mut below[pivot..]) {
                for g in 0..G {
                    let (a, b) = (upper[g], lower[g]);
                    upper[g] = R::select(swap[g], b, a);
                    lower[g] = R::select(swap[g], a, b);
                }
            }
            for g in 0..G {
                determinant[g] = R::select(swap[g], -determinant[g], determinant[g]);
            }
        }
        let mut inv_pivot = [R::ONE; G];
        for g in 0..G {
            let head = matrix[pivot * width + pivot][g];
            determinant[g] = determinant[g] * head;
            inv_pivot[g] = R::ONE / head;
        }
        for column in pivot + 1..width {
            for g in 0..G {
                matrix[pivot * width + column][g] =
                    matrix[pivot * width + column][g] * inv_pivot[g];
            }
        }
        for row in (0..n).filter(|&row| row != pivot) {
            let factor = matrix[row * width + pivot];
            for column in pivot + 1..width {
                let head = matrix[pivot * width + column];
                let entry = &mut matrix[row * width + column];
                for g in 0..G {
                    entry[g] = entry[g] - factor[g] * head[g];
                }
            }
        }
    }
    determinant
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::lanes::LANES;
    use crate::math::pair::Lanes;
    use nalgebra::DMatrix;

    /// A pseudorandom matrix, the same for the same seed.
    fn random_matrix(n: usize, seed: u64) -> DMatrix<f64> {
        let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
        DMatrix::from_fn(n, n, |_, _| {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 11) as f64 / 2.0_f64.powi(52) - 1.0
        })
    }

    fn augmented(a: &DMatrix<f64>) -> Vec<[f64; 1]> {
        let n = a.nrows();
        let mut rows = vec![[0.0]; 2 * n * n];
        for row in 0..n {
            for column in 0..n {
                rows[row * 2 * n + column] = [a[(row, column)]];
            }
        }
        rows
    }

    #[test]
    fn matrix_times_inverse_is_the_identity() {
        for n in 1..=12 {
            for seed in 1..40 {
                let a = random_matrix(n, seed);
                let mut rows = augmented(&a);
                let [determinant] = invert(&mut rows, n);
                let inverse = DMatrix::from_fn(n, n, |r, c| rows[r * 2 * n + n + c][0]);
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
    fn lanes_equal_scalars_bit_for_bit() {
        for n in [1, 2, 3, 5, 6] {
            let ones: Vec<Vec<[f64; 1]>> =
                (0..LANES as u64).map(|s| augmented(&random_matrix(n, s + 7))).collect();
            let all = |i: usize| Lanes::from_lanes(|lane| ones[lane][i][0]);
            // Twice, in two groups.
            let mut eight: Vec<[Lanes; 2]> = (0..2 * n * n).map(|i| [all(i); 2]).collect();
            let [_, determinant] = invert(&mut eight, n);
            for (lane, mut single) in ones.into_iter().enumerate() {
                let [alone] = invert(&mut single, n);
                assert_eq!(alone.to_bits(), determinant.lane(lane).to_bits());
                for row in 0..n {
                    for column in n..2 * n {
                        let i = row * 2 * n + column;
                        assert_eq!(single[i][0].to_bits(), eight[i][1].lane(lane).to_bits());
                    }
                }
            }
        }
    }

    /// Rows of length 1, from well apart to nearly parallel, all three or two of them.
    #[test]
    fn minors_are_as_good_as_pivots_within_their_bound() {
        for seed in 1..40 {
            for (second, third) in
                [(1.0, 1.0), (1.0, 1e-3), (1.0, 1e-6), (1e-3, 1e-3), (1e-3, 1e-6), (0.1, 1e-5)]
            {
                let a = random_matrix(3, seed);
                let mut near = a.clone();
                for column in 0..3 {
                    near[(1, column)] = a[(0, column)] + second * a[(1, column)];
                    near[(2, column)] = a[(0, column)] + third * a[(2, column)];
                }
                for mut row in near.row_iter_mut() {
                    let length = row.norm();
                    row /= length;
                }
                let (mut minors, mut pivots) = (augmented(&near), augmented(&near));
                by_minors(&mut minors);
                by_pivots(&mut pivots, 3);
                let inverse =
                    |rows: &[[f64; 1]]| DMatrix::from_fn(3, 3, |r, c| rows[r * 6 + 3 + c][0]);
                let (minors, pivots) = (inverse(&minors), inverse(&pivots));
                let norm = pivots.norm();
                let bound = 16.0 * f64::EPSILON * norm * norm;
                let error = (&minors - &pivots).norm() / norm;
                assert!(error <= bound, "{seed} {second} {third}: {error:e} > {bound:e}");
            }
        }
    }

    #[test]
    fn a_zero_on_the_diagonal_does_no_harm() {
        let mut rows = [0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0].map(|x| [x]);
        let [determinant] = invert(&mut rows, 2);
        assert!((determinant + 2.0).abs() < 1e-15);
        let rows = rows.map(|[x]| x);
        assert_eq!([rows[2], rows[3], rows[6], rows[7]], [0.0, 0.5, 1.0, 0.0]);
    }
}
