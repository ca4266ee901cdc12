//! Linear equations that are met but for rounding, with the shortest solution.

use nalgebra::{DMatrix, DVector};

use crate::math::tolerance::UNIT_ROUNDOFF;

/// Eigenvalues (squares of singular values) that count, as a part of the greatest.
const TRUNCATED: f64 = 1.0e-14;

/// The shortest `x` for which `A x + c` is nothing but rounding, or as small as can be: singular vectors
/// of `A` count from the greatest value on until the rest of `c` is rounding (Morozov's discrepancy
/// principle), since those of small values would only raise it.
pub(crate) fn least_norm(a: DMatrix<f64>, c: &DVector<f64>) -> DVector<f64> {
    let rounding = UNIT_ROUNDOFF * (c.len() as f64).sqrt();
    let (a, c) = if a.nrows() > a.ncols() {
        // The triangle R of A = Q R, and Qᵀ c.
        let decomposed = a.qr();
        let mut c = c.clone();
        decomposed.q_tr_mul(&mut c);
        (decomposed.unpack_r(), c)
    } else {
        (a, c.clone())
    };
    // Entry by entry: nalgebra's product of two matrices rounds otherwise where the processor has FMA.
    let squares = DMatrix::from_fn(a.nrows(), a.nrows(), |i, j| a.row(i).dot(&a.row(j)));
    let eigen = squares.symmetric_eigen();
    let least = TRUNCATED * eigen.eigenvalues.amax();
    let parts = eigen.eigenvectors.tr_mul(&c.rows(0, a.nrows()));
    let mut order: Vec<usize> = (0..parts.len()).collect();
    order.sort_by(|&i, &j| eigen.eigenvalues[j].total_cmp(&eigen.eigenvalues[i]));
    let mut weights = DVector::zeros(parts.len());
    for (done, &place) in order.iter().enumerate() {
        let value = eigen.eigenvalues[place];
        let rest: f64 = order[done..].iter().map(|&other| parts[other] * parts[other]).sum();
        if value <= least || rest <= rounding * rounding {
            break;
        }
        weights[place] = -parts[place] / value;
    }
    a.tr_mul(&(&eigen.eigenvectors * weights))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn least_norm_is_the_pseudo_inverse_of_either_shape() {
        for (rows, columns) in [(3, 7), (7, 3), (4, 4)] {
            let mut a = DMatrix::from_fn(rows, columns, |i, j| ((3 * i + 5 * j) % 7) as f64 - 2.5);
            // One row that depends on others, whatever the shape.
            let sum = a.row(0) + a.row(1);
            a.set_row(rows - 1, &sum);
            let c = DVector::from_fn(rows, |i, _| 1.0 / (1.0 + i as f64));
            let wanted = -a.clone().pseudo_inverse(1e-9).expect("a tolerance above 0") * &c;
            assert!((least_norm(a, &c) - wanted).amax() < 1e-13, "{rows} by {columns}");
        }
    }

    #[test]
    fn what_is_rounding_is_not_raised_by_small_singular_values() {
        let a = DMatrix::from_diagonal(&DVector::from_vec(vec![1.0, 1e-5]));
        let x = least_norm(a.clone(), &DVector::from_vec(vec![1e-3, 1e-16]));
        assert!((x[0] + 1e-3).abs() < 1e-18 && x[1] == 0.0);
        let x = least_norm(a, &DVector::from_vec(vec![1e-3, 1e-12]));
        // Squares of 1e-5 are known to six digits.
        assert!((x[1] + 1e-7).abs() < 1e-12);
    }
}
