//! The curve of a point over a turn of the driver, or there and back over the longest stretch on which a design moves.

use std::f64::consts::TAU;
use std::ops::Range;

use super::problem::{TRAVEL_POSITIONS, is_solved, series};
use super::target::FitTarget;
use crate::batch::request::Motion;
use crate::math::vector::Vector;

/// The least number of positions of a stretch.
const LEAST_STRETCH: usize = 8;

/// A closed curve, at equal steps of an angle over which it is gone round once.
pub(super) struct Course {
    pub points: Vec<Vector>,
    /// Of a stretch its first position and how many steps it has.
    stretch: Option<(usize, usize)>,
}

impl Course {
    /// Of the point of a path; `None` if it has none, or if the design moves over less than a stretch.
    pub(super) fn new(motion: &Motion, rows: &Range<usize>, target: &FitTarget) -> Option<Self> {
        let points = &series(motion, target.numbers.first()?.quantity)?.derivatives[0];
        let at = |place: usize| {
            let row = rows.start + place % TRAVEL_POSITIONS;
            Vector::new(points[2 * row], points[2 * row + 1])
        };
        let is_solved_at =
            |place: usize| is_solved(motion.status[rows.start + place % TRAVEL_POSITIONS]);
        if (0..TRAVEL_POSITIONS).all(is_solved_at) {
            return Some(Self { points: (0..TRAVEL_POSITIONS).map(at).collect(), stretch: None });
        }
        let (first, steps) = longest(is_solved_at)?;
        let half = TRAVEL_POSITIONS / 2;
        let there_and_back = (0..TRAVEL_POSITIONS).map(|t| t.min(TRAVEL_POSITIONS - t));
        let between = |part: usize| {
            let place = (part * steps) as f64 / half as f64;
            let from = part * steps / half;
            let (start, end) = (at(first + from), at(first + (from + 1).min(steps)));
            start + (end - start).scale(place - from as f64)
        };
        let points = there_and_back.map(between).collect();
        Some(Self { points, stretch: Some((first, steps)) })
    }

    /// Whether it is of a whole turn.
    pub(super) fn is_whole(&self) -> bool {
        self.stretch.is_none()
    }

    /// The driver's coordinate at an angle of the curve.
    pub(super) fn coordinate(&self, angle: f64) -> f64 {
        let Some((first, steps)) = self.stretch else { return angle };
        let part = (angle / TAU).rem_euclid(1.0);
        let there = 2.0 * part.min(1.0 - part);
        TAU * (first as f64 + there * steps as f64) / TRAVEL_POSITIONS as f64
    }
}

/// The first place of the longest stretch that is solved, and its steps; it may pass the end of the turn.
fn longest(is_solved: impl Fn(usize) -> bool) -> Option<(usize, usize)> {
    let mut best = (0, 0);
    for first in (0..TRAVEL_POSITIONS).filter(|&place| is_solved(place)) {
        let count = (first..first + TRAVEL_POSITIONS).take_while(|&place| is_solved(place)).count();
        if count > best.1 {
            best = (first, count);
        }
    }
    (best.1 >= LEAST_STRETCH).then(|| (best.0, best.1 - 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_stretch_passes_the_end_of_the_turn() {
        let is_solved = |place: usize| {
            let place = place % TRAVEL_POSITIONS;
            !(10..=60).contains(&place) || (20..30).contains(&place)
        };
        assert_eq!(longest(is_solved), Some((61, 12)));
        assert_eq!(longest(|place| place % TRAVEL_POSITIONS < 5), None);
    }

    #[test]
    fn a_stretch_is_gone_there_and_back() {
        let course = Course { points: vec![], stretch: Some((4, 8)) };
        let step = TAU / TRAVEL_POSITIONS as f64;
        for (angle, place) in [(0.0, 4.0), (0.25, 8.0), (0.5, 12.0), (0.75, 8.0), (-0.25, 8.0)] {
            assert!((course.coordinate(TAU * angle) - step * place).abs() < 1e-12);
        }
    }
}
