//! Symmetric positive definite equations, solved by their Cholesky factor.

use crate::batch::dispatch::{Entry, Task};
use crate::math::lanes::{LANES, Real};

/// Equations H x = b: in rows of `width` numbers H above its diagonal, and b in column `right`, behind those of H.
#[derive(Debug, Clone, Default)]
pub(super) struct Equations {
    pub rows: Vec<f64>,
    /// The length of a row, a multiple of that of registers.
    pub width: usize,
    /// The column of b.
    pub right: usize,
    /// The number of unknowns.
    pub count: usize,
}

impl Equations {
    /// Solves them, and leaves the factor in the place of H; `false` if H is not positive definite.
    pub(super) fn solve<L: Entry>(&mut self, solution: &mut Vec<f64>) -> bool {
        let mut factor = Factor { equations: self, is_definite: false };
        L::call(&mut factor);
        let is_definite = factor.is_definite;
        solution.clear();
        solution.resize(self.width, 0.0);
        for k in (0..self.count).rev() {
            let row = &self.rows[k * self.width..][..self.width];
            let known = dot(&row[k + 1..self.count], &solution[k + 1..self.count]);
            solution[k] = (row[self.right] - known) / row[k];
        }
        is_definite
    }
}

/// H = Uᵀ U, row after row of U; b goes along.
struct Factor<'f> {
    equations: &'f mut Equations,
    is_definite: bool,
}

impl<R: Real> Task<R> for Factor<'_> {
    #[inline(always)]
    fn run(&mut self) {
        let Equations { rows, width, count, .. } = &mut *self.equations;
        let (width, count) = (*width, *count);
        for k in 0..count {
            let (done, later) = rows.split_at_mut((k + 1) * width);
            let row = &mut done[k * width..];
            if row[k].is_nan() || row[k] <= 0.0 {
                return;
            }
            let inverse = R::splat(1.0 / row[k].sqrt());
            for first in (k / R::LANES * R::LANES..width).step_by(R::LANES) {
                (R::read(&row[first..]) * inverse).put(&mut row[first..]);
            }
            for (i, other) in (k + 1..count).zip(later.chunks_exact_mut(width)) {
                // Entries before the diagonal are in the same register, and not used.
                let factor = R::splat(row[i]);
                for first in (i / R::LANES * R::LANES..width).step_by(R::LANES) {
                    let rest = R::read(&other[first..]) - factor * R::read(&row[first..]);
                    rest.put(&mut other[first..]);
                }
            }
        }
        self.is_definite = true;
    }
}

/// The scalar product, as eight sums side by side.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; LANES];
    for (a, b) in a.chunks(LANES).zip(b.chunks(LANES)) {
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += a * b;
        }
    }
    sums.iter().sum()
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;
    use crate::math::random::Random;
    use crate::state::kernel::baseline::Baseline;

    /// nalgebra's factorisation by LU shares no code with it.
    #[test]
    fn solutions_are_those_of_elimination() {
        let random = &mut Random::new(11, 0);
        for count in [1, 5, 8, 13] {
            let root = DMatrix::from_fn(count, count, |_, _| random.normal());
            let matrix = root.transpose() * &root + DMatrix::identity(count, count);
            let right = DVector::from_fn(count, |_, _| random.normal());
            let width = (count + 1).next_multiple_of(LANES);
            let mut equations =
                Equations { rows: vec![0.0; count * width], width, right: count, count };
            for p in 0..count {
                for q in p..count {
                    equations.rows[p * width + q] = matrix[(p, q)];
                }
                equations.rows[p * width + count] = right[p];
            }
            let mut solution = vec![];
            assert!(equations.solve::<Baseline>(&mut solution));
            let known = matrix.lu().solve(&right).expect("a regular matrix");
            for (own, known) in solution.iter().zip(known.iter()) {
                assert!((own - known).abs() < 1e-12, "{own} {known}");
            }
        }
    }

    #[test]
    fn a_matrix_that_is_not_definite_is_refused() {
        let mut rows = vec![0.0; 2 * LANES];
        rows[..3].copy_from_slice(&[1.0, 2.0, 1.0]);
        rows[LANES + 1] = 3.0;
        let mut equations = Equations { rows, width: LANES, right: 2, count: 2 };
        assert!(!equations.solve::<Baseline>(&mut vec![]));
    }
}
