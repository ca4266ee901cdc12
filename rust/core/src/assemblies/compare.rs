//! Compares complex assemblies: components of x, then of y.

use crate::math::vector::Vector;

/// Solutions nearer than this (relative to their size) are the same, found in two searches; different ones
/// are farther apart.
const SAME: f64 = 1.0e-8;
/// A solution nearer than this (relative to its size) to its conjugate may be real.
const REAL: f64 = 1.0e-6;

/// Whether two solutions are the same to rounding.
pub(super) fn is_same(a: &[Vector], b: &[Vector]) -> bool {
    let difference: f64 = a.iter().zip(b).map(|(&a, &b)| (a - b).norm2()).sum();
    let size: f64 = 1.0 + a.iter().map(|a| a.norm2()).sum::<f64>();
    difference <= SAME * SAME * size
}

/// Whether a solution that may be multiple is the same as another.
pub(super) fn is_near(a: &[Vector], b: &[Vector]) -> bool {
    let difference: f64 = a.iter().zip(b).map(|(&a, &b)| (a - b).norm2()).sum();
    let size: f64 = 1.0 + a.iter().map(|a| a.norm2()).sum::<f64>();
    difference <= REAL * REAL * size
}

/// Conj Y, conj X: the mirror image of a solution.
pub(super) fn conjugate(point: &[Vector]) -> Vec<Vector> {
    let (x, y) = point.split_at(point.len() / 2);
    y.iter().chain(x).map(|x| x.conj()).collect()
}
