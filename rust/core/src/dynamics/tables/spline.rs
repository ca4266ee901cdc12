//! Piecewise cubics through tables: splines with several end conditions, and monotone ones.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use super::error::TableError;
use super::monotone::{self, Leg};
use super::passes::{collected, is_cancelled};

/// Curves through a table: a spline by its end conditions, or another one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum EndCondition {
    /// The first two pieces are one cubic, and so are the last two (Mathcad's `cspline`).
    #[default]
    NotAKnot,
    /// Zero second derivative at the ends.
    Natural,
    /// Zero first derivative at the ends.
    Clamped,
    /// Equal derivatives at both ends.
    Periodic,
    /// Monotone cubics instead of a spline: every value lies between those of the rows beside it.
    Pchip,
    /// Linear interpolation instead of a spline.
    Linear,
}

/// Pieces of a spline: for each, coefficients in powers of the distance from its first knot.
pub type Pieces = Vec<[f64; 4]>;

/// The spline through values at increasing knots, from its slopes at the knots: C. de Boor,
/// A Practical Guide to Splines (1978), chapter IV.
///
/// # Errors
///
/// Fewer than two knots (periodic: three), or a different number of values.
pub fn spline(knots: &[f64], values: &[f64], ends: EndCondition) -> Result<Pieces, TableError> {
    spline_unless(knots, values, ends, &AtomicBool::new(false))
}

/// [`spline`], left unfitted once `cancel` is true: millions of rows take seconds.
///
/// # Errors
///
/// Those of [`spline`].
pub fn spline_unless(
    knots: &[f64],
    values: &[f64],
    ends: EndCondition,
    cancel: &AtomicBool,
) -> Result<Pieces, TableError> {
    spline_beside(knots, values, ends, [None; 2], cancel)
}

/// The curves through the sections of a table, fitted separately. Monotone cubics of a `closed` table
/// go on from its last section into its first. Once `cancel` is true the curves are not fitted.
///
/// # Errors
///
/// Those of [`spline`].
pub(crate) fn fit_sections(
    knots: &[f64],
    values: &[f64],
    ends: EndCondition,
    sections: &[Range<usize>],
    closed: bool,
    cancel: &AtomicBool,
) -> Result<Pieces, TableError> {
    let mut all = Pieces::new();
    let leg = |row: usize| leg(knots, values, row);
    for (k, section) in sections.iter().enumerate() {
        let before = (closed && k == 0).then(|| leg(knots.len() - 2));
        let behind = (closed && k + 1 == sections.len()).then(|| leg(0));
        let (section_knots, at) = (&knots[section.clone()], &values[section.clone()]);
        let mut pieces = spline_beside(section_knots, at, ends, [before, behind], cancel)?;
        if sections.len() == 1 {
            return Ok(pieces);
        }
        all.append(&mut pieces);
    }
    Ok(all)
}

fn leg(knots: &[f64], values: &[f64], row: usize) -> Leg {
    let width = knots[row + 1] - knots[row];
    [width, (values[row + 1] - values[row]) / width]
}

fn spline_beside(
    knots: &[f64],
    values: &[f64],
    ends: EndCondition,
    beyond: [Option<Leg>; 2],
    cancel: &AtomicBool,
) -> Result<Pieces, TableError> {
    let n = knots.len();
    let least = if ends == EndCondition::Periodic { 3 } else { 2 };
    if n < least || values.len() != n {
        return Err(TableError::TooShort { count: n.min(values.len()), least });
    }
    let pieces = fitted(n - 1, |row| leg(knots, values, row), values, ends, beyond, cancel);
    Ok(pieces.unwrap_or_else(|| vec![[0.0; 4]; n - 1]))
}

/// The pieces over `count` legs; `None` once `cancel` is true.
fn fitted(
    count: usize,
    leg: impl Fn(usize) -> Leg,
    values: &[f64],
    ends: EndCondition,
    beyond: [Option<Leg>; 2],
    cancel: &AtomicBool,
) -> Option<Pieces> {
    let go_on = || (!cancel.load(Ordering::Relaxed)).then_some(());
    if ends == EndCondition::Linear {
        let pieces = collected(count, cancel, |row| [values[row], leg(row)[1], 0.0, 0.0]);
        return go_on().map(|()| pieces);
    }
    let legs = collected(count, cancel, leg);
    go_on()?;
    let slopes = match ends {
        EndCondition::Pchip => monotone::slopes(&legs, beyond, cancel),
        _ => slopes(&legs, ends, cancel)?,
    };
    go_on()?;
    let pieces = collected(count, cancel, |i| {
        let [h, r] = legs[i];
        let (a, b) = (slopes[i], slopes[i + 1]);
        [values[i], a, (3.0 * r - 2.0 * a - b) / h, (a + b - 2.0 * r) / (h * h)]
    });
    go_on().map(|()| pieces)
}

/// A row (before, own, behind) = right-hand side of a tridiagonal system.
type Row = ([f64; 3], f64);

/// The row of a knot between two legs.
fn between([h, r]: Leg, [g, s]: Leg) -> Row {
    ([g, 2.0 * (h + g), h], 3.0 * (g * r + h * s))
}

/// Slopes at the knots that make second derivatives continuous; `None` once `cancel` is true.
fn slopes(legs: &[Leg], ends: EndCondition, cancel: &AtomicBool) -> Option<Vec<f64>> {
    let n = legs.len() + 1;
    let last = n - 2;
    let ([head, foot], [first, final_]) = match ends {
        EndCondition::NotAKnot if n == 2 => return Some(vec![legs[0][1]; 2]),
        EndCondition::NotAKnot if n == 3 => {
            // Three points: one parabola.
            let bend = (legs[1][1] - legs[0][1]) / (legs[0][0] + legs[1][0]);
            let at = |[h, r]: Leg, sign: f64| r + sign * bend * h;
            return Some(vec![at(legs[0], -1.0), at(legs[0], 1.0), at(legs[1], 1.0)]);
        }
        EndCondition::NotAKnot => {
            let end = |[h, r]: Leg, [g, s]: Leg| {
                let whole = h + g;
                ([g, whole], ((h + 2.0 * whole) * g * r + h * h * s) / whole)
            };
            let (a, x) = end(legs[0], legs[1]);
            let (b, y) = end(legs[last], legs[last - 1]);
            ([a, b], [x, y])
        }
        EndCondition::Natural => ([[2.0, 1.0]; 2], [3.0 * legs[0][1], 3.0 * legs[last][1]]),
        EndCondition::Clamped => ([[1.0, 0.0]; 2], [0.0; 2]),
        EndCondition::Periodic => return periodic(legs, cancel),
        EndCondition::Linear | EndCondition::Pchip => return None,
    };
    let mut rows = collected(n, cancel, |knot| match knot {
        0 => ([0.0, head[0], head[1]], first),
        _ if knot == n - 1 => ([foot[1], foot[0], 0.0], final_),
        _ => between(legs[knot - 1], legs[knot]),
    });
    tridiagonal(&mut rows, cancel)
}

/// Slopes of a periodic spline: a tridiagonal system with corners, by Sherman & Morrison.
fn periodic(legs: &[Leg], cancel: &AtomicBool) -> Option<Vec<f64>> {
    let n = legs.len();
    let mut rows = collected(n, cancel, |i| between(legs[(i + n - 1) % n], legs[i]));
    if rows.len() < n {
        return None;
    }
    let mut slopes = if n == 2 {
        // Both neighbours are the same slope.
        let ([a, b, c], x) = rows[0];
        let ([d, e, f], y) = rows[1];
        let (p, q) = (a + c, d + f);
        let determinant = b * e - p * q;
        vec![(x * e - p * y) / determinant, (b * y - q * x) / determinant]
    } else {
        let (corner, opposite_corner) = (rows[0].0[0], rows[n - 1].0[2]);
        let pivot = -rows[0].0[1];
        rows[0].0[1] -= pivot;
        rows[n - 1].0[1] -= corner * opposite_corner / pivot;
        let mut extra = rows.clone();
        for row in &mut extra {
            row.1 = 0.0;
        }
        extra[0].1 = pivot;
        extra[n - 1].1 = opposite_corner;
        let (y, z) = (tridiagonal(&mut rows, cancel)?, tridiagonal(&mut extra, cancel)?);
        let part = |x: &[f64]| x[0] + corner / pivot * x[n - 1];
        let factor = part(&y) / (1.0 + part(&z));
        y.iter().zip(&z).map(|(y, z)| y - factor * z).collect()
    };
    slopes.push(slopes[0]);
    Some(slopes)
}

/// Solves a tridiagonal system; `None` once `cancel` is true. It is diagonally dominant except for the
/// not-a-knot rows, where elimination is still stable (de Boor).
fn tridiagonal(rows: &mut [Row], cancel: &AtomicBool) -> Option<Vec<f64>> {
    let mut solution = vec![0.0; rows.len()];
    for i in 1..rows.len() {
        if is_cancelled(i, cancel) {
            return None;
        }
        let ([_, pivot, behind], right) = rows[i - 1];
        let factor = rows[i].0[0] / pivot;
        rows[i].0[1] -= factor * behind;
        rows[i].1 -= factor * right;
    }
    let mut next = 0.0;
    for (i, (([_, diagonal, behind], right), out)) in
        rows.iter().zip(&mut solution).enumerate().rev()
    {
        if is_cancelled(i, cancel) {
            return None;
        }
        next = (right - behind * next) / diagonal;
        *out = next;
    }
    Some(solution)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::polynomial::value;

    const KNOTS: [f64; 7] = [0.0, 0.3, 1.0, 1.4, 2.5, 3.0, 4.0];
    const ALL: [EndCondition; 4] = [
        EndCondition::NotAKnot,
        EndCondition::Natural,
        EndCondition::Clamped,
        EndCondition::Periodic,
    ];

    fn derivatives(piece: &[f64; 4], x: f64) -> [f64; 3] {
        let [_, b, c, d] = *piece;
        [value(piece, x), value(&[b, 2.0 * c, 3.0 * d], x), value(&[2.0 * c, 6.0 * d], x)]
    }

    #[test]
    fn pieces_join_with_two_derivatives() {
        let values = [1.0, -2.0, 0.5, 3.0, 1.0, 0.0, 1.0];
        for ends in ALL {
            let pieces = spline(&KNOTS, &values, ends).expect("a spline");
            for i in 0..5 {
                let here = derivatives(&pieces[i], KNOTS[i + 1] - KNOTS[i]);
                let next = derivatives(&pieces[i + 1], 0.0);
                for (a, b) in here.iter().zip(next) {
                    assert!((a - b).abs() < 1e-12, "{ends:?} {i}: {a} {b}");
                }
            }
            let first = derivatives(&pieces[0], 0.0);
            let last = derivatives(&pieces[5], 1.0);
            assert!((last[0] - 1.0).abs() < 1e-13);
            let zero = match ends {
                EndCondition::NotAKnot => {
                    [pieces[0][3] - pieces[1][3], pieces[4][3] - pieces[5][3]]
                }
                EndCondition::Natural => [first[2], last[2]],
                EndCondition::Clamped => [first[1], last[1]],
                _ => [first[1] - last[1], first[2] - last[2]],
            };
            assert!(zero.iter().all(|z| z.abs() < 1e-12), "{ends:?}: {zero:?}");
        }
    }

    #[test]
    fn not_a_knot_reproduces_cubics() {
        let cubic = |x: f64| 1.0 - x + 0.5 * x * x + 0.25 * x * x * x;
        let values = KNOTS.map(cubic);
        for n in [4, 5, 7] {
            let pieces =
                spline(&KNOTS[..n], &values[..n], EndCondition::NotAKnot).expect("a spline");
            for (piece, &knot) in pieces.iter().zip(&KNOTS) {
                assert!((value(piece, 0.1) - cubic(knot + 0.1)).abs() < 1e-13);
            }
        }
        let two = spline(&[0.0, 2.0], &[1.0, 5.0], EndCondition::NotAKnot).expect("a line");
        assert_eq!(two, [[1.0, 2.0, 0.0, 0.0]]);
        let three =
            spline(&[0.0, 1.0, 3.0], &[0.0, 1.0, 9.0], EndCondition::NotAKnot).expect("a parabola");
        assert!((value(&three[1], 1.0) - 4.0).abs() < 1e-15);
    }

    #[test]
    fn short_tables() {
        let three =
            spline(&[0.0, 1.0, 3.0], &[1.0, 2.0, 1.0], EndCondition::Periodic).expect("a spline");
        let (first, last) = (derivatives(&three[0], 0.0), derivatives(&three[1], 2.0));
        for k in 0..3 {
            assert!((first[k] - last[k]).abs() < 1e-14);
        }
        assert!(spline(&[0.0], &[1.0], EndCondition::Natural).is_err());
        assert!(spline(&[0.0, 1.0], &[1.0, 1.0], EndCondition::Periodic).is_err());
    }
}
