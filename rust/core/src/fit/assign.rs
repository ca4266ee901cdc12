//! Which positions of a turn meet the points of a target: the nearest, in order where that counts.

use std::f64::consts::TAU;
use std::ops::Range;

use super::problem::series;
use super::target::{FitTarget, TargetNumber, width, within_half_turn};
use crate::batch::request::Motion;

/// Positions at which the first point of an ordered target may be met: those nearest to it.
const FIRST_PLACES: usize = 4;

/// For each point of a target the place, along the turn, of the position that is nearest to it: places may be beyond
/// the turn, or before it. Of an ordered target they rise, or fall, by less than a turn.
pub(super) fn assign(
    target: &FitTarget,
    is_ordered: bool,
    motion: &Motion,
    rows: &Range<usize>,
) -> Vec<f64> {
    let count = rows.len();
    let misses: Vec<Vec<f64>> = (0..target.len())
        .map(|k| rows.clone().map(|row| missed(target, k, motion, row)).collect())
        .collect();
    if !is_ordered {
        return misses.iter().map(|own| least(own) as f64).collect();
    }
    let Some(first) = misses.first() else { return vec![] };
    let mut starts: Vec<usize> = (0..count).collect();
    starts.sort_by(|&a, &b| first[a].total_cmp(&first[b]));
    let mut best = (f64::INFINITY, vec![]);
    for &start in starts.iter().take(FIRST_PLACES) {
        for side in [1.0, -1.0] {
            let at = |step: usize| {
                let step = if side > 0.0 { start + step } else { start + count - step };
                step % count
            };
            let (sum, steps) = rising(&misses, count, at);
            if sum < best.0 {
                let places = steps.iter().map(|&step| start as f64 + side * step as f64).collect();
                best = (sum, places);
            }
        }
    }
    best.1
}

/// The steps from the first position, never falling, with the least sum of misses; by dynamic programming.
fn rising(misses: &[Vec<f64>], count: usize, at: impl Fn(usize) -> usize) -> (f64, Vec<usize>) {
    let mut sums = vec![f64::INFINITY; count];
    // The first point is met at the start.
    sums[0] = misses[0][at(0)];
    let mut from: Vec<Vec<usize>> = vec![];
    for own in &misses[1..] {
        let mut before = (f64::INFINITY, 0);
        let mut own_from = vec![0; count];
        for step in 0..count {
            if sums[step] < before.0 {
                before = (sums[step], step);
            }
            own_from[step] = before.1;
            sums[step] = before.0 + own[at(step)];
        }
        from.push(own_from);
    }
    let mut step = least(&sums);
    let sum = sums[step];
    let mut steps = vec![step];
    for own_from in from.iter().rev() {
        step = own_from[step];
        steps.push(step);
    }
    steps.reverse();
    (sum, steps)
}

/// Index of the least number; 0 without one.
fn least(numbers: &[f64]) -> usize {
    let best = numbers.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1));
    best.map_or(0, |(index, _)| index)
}

/// The square of what a position misses of a point; infinite where it is not solved.
pub(super) fn missed(target: &FitTarget, k: usize, motion: &Motion, row: usize) -> f64 {
    let of = |number: &TargetNumber| {
        let width = width(number.quantity);
        let values = &series(motion, number.quantity)?.derivatives[0];
        let missed = values[row * width + number.axis.min(width - 1)] - number.wanted[k];
        let missed = if number.is_angle { within_half_turn(missed) } else { missed };
        let missed = number.weight * missed;
        Some(missed * missed)
    };
    let sum: f64 = target.numbers.iter().filter_map(of).sum();
    if sum.is_nan() { f64::INFINITY } else { sum }
}

/// A coordinate from a place along the turn.
pub(super) fn coordinate(place: f64, count: usize) -> f64 {
    TAU * place / count as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_best_rising_steps_are_found() {
        // Against all combinations.
        let misses: Vec<Vec<f64>> = (0..4)
            .map(|k| (0..6).map(|p| f64::from((7 * k + 5 * p + k * p * p) % 11)).collect())
            .collect();
        let (sum, steps) = rising(&misses, 6, |step| step);
        let mut best = f64::INFINITY;
        for a in 0..6 {
            for b in a..6 {
                for c in b..6 {
                    best = best.min(misses[0][0] + misses[1][a] + misses[2][b] + misses[3][c]);
                }
            }
        }
        assert_eq!(sum, best);
        assert_eq!(steps[0], 0);
        assert!(steps.is_sorted());
        let of_steps: f64 = steps.iter().zip(&misses).map(|(&step, own)| own[step]).sum();
        assert_eq!(of_steps, best);
    }
}
