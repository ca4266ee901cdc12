//! Minimum-norm solution of linear equations, to rounding.

use nalgebra::{DMatrix, DVector};

use crate::math::tolerance::UNIT_ROUNDOFF;

/// Least ratio of an eigenvalue (squared singular value) to the largest one for it to be used.
const MIN_EIGENVALUE_RATIO: f64 = 1.0e-14;

/// The shortest `x` that makes `A x + c` zero to rounding, or as small as possible. It adds
/// singular vectors of `A` in descending order of their values until the remainder of `c` is
/// rounding, or the error that each entry of `c` has (Morozov's discrepancy principle): those of
/// small values would only amplify it.
pub(crate) fn least_norm(a: DMatrix<f64>, c: &DVector<f64>, error: f64) -> DVector<f64> {
    let allowed = error.max(UNIT_ROUNDOFF) * (c.len() as f64).sqrt();
    let (a, c) = if a.nrows() > a.ncols() {
        // A = Q R: go on with R and Qᵀ c.
        let qr = a.qr();
        let mut c = c.clone();
        qr.q_tr_mul(&mut c);
        (qr.unpack_r(), c)
    } else {
        (a, c.clone())
    };
    // Entry by entry, because nalgebra's matrix product rounds differently on processors with FMA.
    let gram = DMatrix::from_fn(a.nrows(), a.nrows(), |i, j| a.row(i).dot(&a.row(j)));
    let eigen = gram.symmetric_eigen();
    let threshold = MIN_EIGENVALUE_RATIO * eigen.eigenvalues.amax();
    let components = eigen.eigenvectors.tr_mul(&c.rows(0, a.nrows()));
    let mut order: Vec<usize> = (0..components.len()).collect();
    order.sort_by(|&i, &j| eigen.eigenvalues[j].total_cmp(&eigen.eigenvalues[i]));
    let mut weights = DVector::zeros(components.len());
    for (done, &index) in order.iter().enumerate() {
        let value = eigen.eigenvalues[index];
        let remainder: f64 = order[done..].iter().map(|&i| components[i] * components[i]).sum();
        if value <= threshold || remainder <= allowed * allowed {
            break;
        }
        weights[index] = -components[index] / value;
    }
    a.tr_mul(&(&eigen.eigenvectors * weights))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn least_norm_agrees_with_the_pseudo_inverse_for_every_shape() {
        for (rows, columns) in [(3, 7), (7, 3), (4, 4)] {
            let mut a = DMatrix::from_fn(rows, columns, |i, j| ((3 * i + 5 * j) % 7) as f64 - 2.5);
            // One row depends on others.
            let sum = a.row(0) + a.row(1);
            a.set_row(rows - 1, &sum);
            let c = DVector::from_fn(rows, |i, _| 1.0 / (1.0 + i as f64));
            let expected = -a.clone().pseudo_inverse(1e-9).expect("a positive tolerance") * &c;
            assert!((least_norm(a, &c, 0.0) - expected).amax() < 1e-13, "{rows} by {columns}");
        }
    }

    #[test]
    fn small_singular_values_do_not_amplify_rounding() {
        let a = DMatrix::from_diagonal(&DVector::from_vec(vec![1.0, 1e-5]));
        let x = least_norm(a.clone(), &DVector::from_vec(vec![1e-3, 1e-16]), 0.0);
        assert!((x[0] + 1e-3).abs() < 1e-18 && x[1] == 0.0);
        let x = least_norm(a, &DVector::from_vec(vec![1e-3, 1e-12]), 0.0);
        // The square of 1e-5 is accurate to six digits beside 1.
        assert!((x[1] + 1e-7).abs() < 1e-12);
    }
}
