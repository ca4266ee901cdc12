//! The damped step within bounds.

use nalgebra::{DMatrix, DVector};

use super::point::Normal;

/// Share of the mean diagonal that is added to each entry of it, so that numbers without effect stay.
const FLOOR: f64 = 1e-9;

/// The step of Levenberg (1944) and Marquardt (1963) that keeps within bounds: numbers that would leave them go
/// to the bound, and the others are solved for again. `None` if the equations are not positive definite.
pub(super) fn damped_step(
    normal: &Normal,
    damping: f64,
    x: &[f64],
    bounds: &[[f64; 2]],
) -> Option<Vec<f64>> {
    let count = x.len();
    let Normal { h, g, .. } = normal;
    let entry = |i: usize, j: usize| h[i.max(j) * count + i.min(j)];
    let mean = (0..count).map(|i| entry(i, i)).sum::<f64>() / count as f64;
    let mut step = vec![0.0; count];
    let mut is_free: Vec<bool> = (0..count)
        .map(|i| !(x[i] <= bounds[i][0] && g[i] > 0.0 || x[i] >= bounds[i][1] && g[i] < 0.0))
        .collect();
    loop {
        let free: Vec<usize> = (0..count).filter(|&i| is_free[i]).collect();
        let mut matrix = DMatrix::from_fn(free.len(), free.len(), |i, j| entry(free[i], free[j]));
        for i in 0..free.len() {
            matrix[(i, i)] +=
                damping * matrix[(i, i)] + FLOOR * damping.max(FLOOR) * mean + f64::MIN_POSITIVE;
        }
        let fixed = |i: usize| -> f64 {
            (0..count).filter(|&j| !is_free[j]).map(|j| entry(i, j) * step[j]).sum()
        };
        let wanted = DVector::from_fn(free.len(), |i, _| -g[free[i]] - fixed(free[i]));
        let solved = matrix.cholesky()?.solve(&wanted);
        let mut leaves = false;
        for (k, &i) in free.iter().enumerate() {
            step[i] = solved[k];
            let [low, high] = bounds[i];
            if x[i] + step[i] < low || x[i] + step[i] > high {
                step[i] = if x[i] + step[i] < low { low } else { high } - x[i];
                is_free[i] = false;
                leaves = true;
            }
        }
        if !leaves {
            return step.iter().all(|d| d.is_finite()).then_some(step);
        }
    }
}
