//! Residuals of targets at the positions of a design, with their derivatives.

use super::normal::Rows;
use super::point::Point;
use super::problem::{Problem, is_solved};
use super::target::{FitTarget, Freedom, TargetNumber, Timing, width, within_half_turn};
use crate::batch::request::{Quantity, Series};
use crate::math::trig::sin_cos;

/// A block of designs at all positions.
pub(super) struct Solved<'s> {
    /// For each quantity its value and first derivative.
    pub series: Vec<&'s Series>,
    /// For each quantity its derivatives by the dimensions that move.
    pub derivatives: &'s [Vec<f64>],
    pub status: &'s [u8],
}

/// Sets the value and the normal equations of a point from the block's design.
pub(super) fn linearize(problem: &Problem, solved: &Solved, design: usize, point: &mut Point) {
    let all = problem.positions();
    let first = design * all;
    point.normal.clear(point.x.len(), all);
    point.value = 0.0;
    if !solved.status[first..first + all].iter().copied().all(is_solved) {
        point.value = f64::INFINITY;
        return;
    }
    let mut rows = Rows::default();
    for (target, positions, extra) in problem.parts() {
        for (k, position) in positions.enumerate() {
            rows.clear(target.numbers.len(), point.x.len());
            let weight = target.weights[k];
            for (index, number) in target.numbers.iter().enumerate() {
                read(problem, solved, (first + position, index), number, &point.x, &mut rows);
            }
            free(target, &point.x, extra, &mut rows);
            for (index, number) in target.numbers.iter().enumerate() {
                let missed = rows.residuals[index] - number.wanted[k];
                rows.residuals[index] =
                    if number.is_angle { within_half_turn(missed) } else { missed };
                scale(&mut rows, index, weight * number.weight);
            }
            let free = matches!(target.timing, Timing::Free { .. }).then_some(position);
            point.value += rows.add_to(&mut point.normal, free);
        }
    }
    point.misfit = point.value;
    if !point.value.is_finite() {
        point.value = f64::INFINITY;
    }
}

/// Reads a number at a row of the block, with its derivatives by the variables.
fn read(
    problem: &Problem,
    solved: &Solved,
    (row, index): (usize, usize),
    number: &TargetNumber,
    x: &[f64],
    rows: &mut Rows,
) {
    let place = |(at, _): &(usize, &(Quantity, usize))| *at;
    let mut quantities = problem.quantities.iter().enumerate();
    let Some(at) = quantities.find(|(_, of)| of.0 == number.quantity).as_ref().map(place) else {
        return;
    };
    let width = width(number.quantity);
    let entry = row * width + number.axis.min(width - 1);
    let [value, rate] = [0, 1].map(|order| solved.series[at].derivatives[order][entry]);
    let count = problem.variables.by.len();
    rows.residuals[index] = value;
    rows.by_q[index] = rate;
    let own = &mut rows.derivatives[index * x.len()..][..problem.variables.len()];
    problem.variables.chain(&solved.derivatives[at][entry * count..][..count], own);
}

/// Applies what is free in a target's frame, and the phase.
fn free(target: &FitTarget, x: &[f64], mut extra: usize, rows: &mut Rows) {
    let width = x.len();
    if let Timing::Phase(_) = target.timing {
        for (index, rate) in rows.by_q.iter().enumerate() {
            rows.derivatives[index * width + extra] = *rate;
        }
        extra += 1;
    }
    match target.freedom {
        Freedom::None => {}
        Freedom::Turned => {
            rows.residuals[2] += x[extra];
            rows.derivatives[2 * width + extra] = 1.0;
        }
        Freedom::Place => {
            let (b, a) = sin_cos(x[extra]);
            let p = turned([a, b], [x[extra + 1], x[extra + 2]], rows);
            let turning = [-b * p[0] - a * p[1], a * p[0] - b * p[1]];
            for (row, turning) in turning.into_iter().enumerate() {
                rows.derivatives[row * width + extra] = turning;
                rows.derivatives[row * width + extra + 1 + row] = 1.0;
            }
        }
        Freedom::Similarity => {
            let p = turned([x[extra], x[extra + 1]], [x[extra + 2], x[extra + 3]], rows);
            for (row, own) in [[p[0], -p[1]], [p[1], p[0]]].into_iter().enumerate() {
                rows.derivatives[row * width + extra..][..2].copy_from_slice(&own);
                rows.derivatives[row * width + extra + 2 + row] = 1.0;
            }
        }
        Freedom::Line { scale: has_scale, offset } => {
            let value = rows.residuals[0];
            if has_scale {
                scale(rows, 0, x[extra]);
                rows.derivatives[extra] = value;
                extra += 1;
            }
            if offset {
                rows.residuals[0] += x[extra];
                rows.derivatives[extra] = 1.0;
            }
        }
    }
}

/// Multiplies the point of a path, and its derivatives, by a + ib, and shifts it; the point as it was.
fn turned([a, b]: [f64; 2], shift: [f64; 2], rows: &mut Rows) -> [f64; 2] {
    let width = rows.derivatives.len() / rows.residuals.len();
    let turn = |[u, v]: [f64; 2]| [a * u - b * v, a * v + b * u];
    for column in 0..width {
        let [u, v] = turn([rows.derivatives[column], rows.derivatives[width + column]]);
        (rows.derivatives[column], rows.derivatives[width + column]) = (u, v);
    }
    let [u, v] = turn([rows.by_q[0], rows.by_q[1]]);
    (rows.by_q[0], rows.by_q[1]) = (u, v);
    let point = [rows.residuals[0], rows.residuals[1]];
    let [u, v] = turn(point);
    (rows.residuals[0], rows.residuals[1]) = (u + shift[0], v + shift[1]);
    point
}

/// Multiplies one residual with its derivatives.
fn scale(rows: &mut Rows, index: usize, factor: f64) {
    let width = rows.derivatives.len() / rows.residuals.len();
    rows.residuals[index] *= factor;
    rows.by_q[index] *= factor;
    for derivative in &mut rows.derivatives[index * width..][..width] {
        *derivative *= factor;
    }
}
