//! Evenly spaced knots that are solved in lanes: over a turn of a driven angle, or over the requested
//! range of a driven slide.

use std::f64::consts::TAU;

use crate::branch::branch::{CELLS_PER_TURN, CELLS_PER_UNIT};
use crate::math::lanes::{LANES, Real};
use crate::state::kernel::BLOCK;

/// Knots of a turn, including its end.
pub(crate) const KNOTS: usize = CELLS_PER_TURN as usize + 1;
const _: () = assert!(KNOTS <= BLOCK, "the knots of a turn are solved at once");
/// Width of a cell.
pub(crate) const CELL: f64 = TAU / CELLS_PER_TURN as f64;

/// Cells of a turn where only groups above class II are followed: their predictions show whether the cells
/// are narrow enough.
const WIDE_CELLS_PER_TURN: u32 = 15;
const _: () = assert!((WIDE_CELLS_PER_TURN as usize + 1).is_multiple_of(LANES), "whole registers");

/// Greatest width of a cell along a slide, in units of the scale: about [`CELL`] in rad.
const MAX_CELL: f64 = 0.2;

/// Evenly spaced knots.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Grid {
    /// The first knot, and the width of a cell (negative for a grid that runs downward).
    pub from: f64,
    pub cell: f64,
    /// Number of knots.
    pub count: usize,
    /// The knot at the drawing's coordinate.
    pub home: usize,
    /// Whether they cover one turn of the driver.
    pub is_turn: bool,
}

impl Grid {
    pub(in crate::branch) const NONE: Self =
        Self { from: f64::NAN, cell: CELL, count: 0, home: 0, is_turn: true };

    /// A turn from the drawing's angle on.
    pub(in crate::branch) fn turn(q0: f64) -> Self {
        Self { from: q0, cell: CELL, count: KNOTS, home: 0, is_turn: true }
    }

    /// A turn in wide cells.
    pub(in crate::branch) fn wide_turn(q0: f64) -> Self {
        let cells = WIDE_CELLS_PER_TURN;
        let (cell, count) = (TAU / f64::from(cells), cells as usize + 1);
        Self { from: q0, cell, count, home: 0, is_turn: true }
    }

    /// Whether this is a turn in wide cells.
    pub(in crate::branch) fn is_wide(&self) -> bool {
        self.is_turn && self.count < KNOTS
    }

    /// Knots over a range that contains the drawing's coordinate; `None` if the range is empty or too
    /// long for them.
    pub(in crate::branch) fn stretch(q0: f64, [low, high]: [f64; 2]) -> Option<Self> {
        // Two spare knots, because the grid is shifted to have one at the drawing's coordinate.
        let cell = (high - low) / (KNOTS - 2) as f64;
        if !(0.0 < cell && cell <= MAX_CELL) {
            return None;
        }
        let home = (0..KNOTS).find(|&knot| knot as f64 * cell >= q0 - low)?;
        Some(Self { from: q0 - home as f64 * cell, cell, count: KNOTS, home, is_turn: false })
    }

    /// The tracer's own knots from the drawing's coordinate to `end`, filled up to whole registers: no
    /// knots if both coincide, `None` if they are too far apart.
    pub(in crate::branch) fn ray(q0: f64, end: f64) -> Option<Self> {
        let cells = (end - q0).abs() * CELLS_PER_UNIT;
        let counts = (0..=KNOTS).step_by(LANES);
        let count = counts.into_iter().find(|&count| cells <= count.saturating_sub(1) as f64)?;
        let cell = if end < q0 { -1.0 / CELLS_PER_UNIT } else { 1.0 / CELLS_PER_UNIT };
        Some(Self { from: q0, cell, count, home: 0, is_turn: false })
    }

    /// The coordinate of a knot.
    pub(in crate::branch) fn at(&self, knot: usize) -> f64 {
        self.from + self.cell * knot as f64
    }
}

/// A register of knots of a turn, beginning with knot `first`.
#[inline(always)]
pub(in crate::branch) fn knots_at<R: Real>(turn: &Grid, first: usize) -> R {
    R::from_lanes(|lane| {
        let turns = ((first + lane) as f64) / ((turn.count - 1) as f64);
        turn.from + TAU * turns
    })
}

/// Each lane's predecessor; `last` is that of the first lane.
#[inline(always)]
pub(in crate::branch) fn previous<R: Real>(last: f64, lanes: R) -> R {
    R::from_lanes(|i| if i == 0 { last } else { lanes.lane(i - 1) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stretch_contains_all_and_the_drawing_is_a_knot() {
        for (q0, low, high) in [(1.0, 0.5, 2.0), (1.0, 1.0, 2.0), (0.1, -3.0, 0.1), (0.4, 0.3, 0.5)]
        {
            let grid = Grid::stretch(q0, [low, high]).unwrap();
            assert!(grid.at(0) <= low + 1e-15 && grid.at(KNOTS - 1) >= high - 1e-15);
            assert!((grid.at(grid.home) - q0).abs() <= 1e-15);
        }
    }

    #[test]
    fn rays_have_the_knots_of_the_tracer() {
        for (end, count) in [(0.1, 0), (0.2, 8), (0.1 - 0.5, 16), (1.0, 16), (2.0, 32)] {
            let ray = Grid::ray(0.1, end).unwrap();
            assert_eq!(ray.count, count, "{end}");
            assert_eq!(ray.at(2), 0.1 + 2.0 * ray.cell);
        }
        assert_eq!(Grid::ray(0.1, 2.2), None);
        assert_eq!(Grid::ray(0.1, f64::NAN), None);
    }

    #[test]
    fn stretches_that_knots_do_not_fit() {
        for range in [[1.0, 1.0], [-10.0, 1.0], [f64::NAN; 2], [f64::INFINITY, f64::NEG_INFINITY]] {
            assert_eq!(Grid::stretch(1.0, range), None, "{range:?}");
        }
    }
}
