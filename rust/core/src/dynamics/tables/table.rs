//! A function of a coordinate or a speed, given by points.

use std::sync::atomic::AtomicBool;

use super::columns::{check_columns, wrap_to_period};
use super::error::TableError;
use super::spline::{EndCondition, Pieces, fit_sections};

/// A table with a curve through its rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    knots: Vec<f64>,
    pieces: Pieces,
    periodic: bool,
    /// The knots at which it jumps.
    jumps: Vec<f64>,
}

/// A coordinate beyond an end of a table by less than this, relative to its size, is at the end.
const RANGE_RTOL: f64 = 1.0e-12;

/// A piece of a table, shifted by `periods` periods.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Cell {
    piece: usize,
    periods: f64,
    /// Its first knot, shifted by the periods.
    start: f64,
}

/// For callers that never cancel.
static NEVER: AtomicBool = AtomicBool::new(false);

impl Table {
    /// Fits the curve; `periodic`: the table is one period.
    ///
    /// # Errors
    ///
    /// The table is short, not increasing or not finite, or the ends of a period differ.
    pub fn new(
        knots: &[f64],
        values: &[f64],
        ends: EndCondition,
        periodic: bool,
    ) -> Result<Self, TableError> {
        Self::new_unless(knots, values, ends, periodic, &NEVER)
    }

    /// [`Table::new`], without a curve once `cancel` is true: millions of rows take seconds.
    ///
    /// # Errors
    ///
    /// Those of [`Table::new`].
    pub fn new_unless(
        knots: &[f64],
        values: &[f64],
        ends: EndCondition,
        periodic: bool,
        cancel: &AtomicBool,
    ) -> Result<Self, TableError> {
        check_columns(knots, &[("value", values)], periodic, false)?;
        let whole = 0..knots.len();
        let sections = std::slice::from_ref(&whole);
        let pieces = fit_sections(knots, values, ends, sections, periodic, cancel)?;
        Ok(Self { knots: knots.to_vec(), pieces, periodic, jumps: Vec::new() })
    }

    /// [`Table::new`] with a jump at each knot that appears twice, from the first value to the second: a
    /// separate curve is fitted between jumps. In a table of one period the first or the last knot may
    /// appear twice.
    ///
    /// # Errors
    ///
    /// Those of [`Table::new`]; a jump in a periodic spline, or at an end of a table that is not
    /// periodic.
    pub fn with_jumps(
        knots: &[f64],
        values: &[f64],
        ends: EndCondition,
        periodic: bool,
    ) -> Result<Self, TableError> {
        Self::with_jumps_unless(knots, values, ends, periodic, &NEVER)
    }

    /// [`Table::with_jumps`], without a curve once `cancel` is true.
    ///
    /// # Errors
    ///
    /// Those of [`Table::with_jumps`].
    pub fn with_jumps_unless(
        knots: &[f64],
        values: &[f64],
        ends: EndCondition,
        periodic: bool,
        cancel: &AtomicBool,
    ) -> Result<Self, TableError> {
        check_columns(knots, &[("value", values)], periodic, true)?;
        let mut starts: Vec<usize> =
            (1..knots.len()).filter(|&i| knots[i] == knots[i - 1]).collect();
        let jumps: Vec<f64> = starts.iter().map(|&start| knots[start]).collect();
        if jumps.is_empty() {
            return Self::new_unless(knots, values, ends, periodic, cancel);
        }
        let at_end = jumps.iter().find(|&&at| at == knots[0] || at == knots[knots.len() - 1]);
        if let (Some(&at), false) = (at_end, periodic) {
            return Err(TableError::JumpAtEnd { at });
        }
        if ends == EndCondition::Periodic {
            return Err(TableError::PeriodicJump { at: jumps[0] });
        }
        starts.push(knots.len());
        let (mut merged, mut sections, mut from) = (vec![knots[0]], Vec::new(), 0);
        for start in starts {
            // One row alone at an end of the period: only its value counts, which the other end has.
            if start - from > 1 {
                sections.push(from..start);
                merged.extend_from_slice(&knots[from + 1..start]);
            }
            from = start;
        }
        let closed = periodic && at_end.is_none();
        let pieces = fit_sections(knots, values, ends, &sections, closed, cancel)?;
        Ok(Self { knots: merged, pieces, periodic, jumps })
    }

    /// The value at `x`; NaN beyond a table that is not periodic.
    #[must_use]
    pub fn at(&self, x: f64) -> f64 {
        self.value_and_slope(x).map_or(f64::NAN, |pair| pair[0])
    }

    /// Value and slope at `x`; `None` beyond a table that is not periodic.
    pub(crate) fn value_and_slope(&self, x: f64) -> Option<[f64; 2]> {
        let within = if self.periodic && x.is_finite() {
            wrap_to_period(x, self.knots[0], self.width())[0]
        } else {
            x
        };
        self.cell(within).map(|cell| self.read(cell, within))
    }

    /// The coordinates of its rows.
    #[must_use]
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// The knots at which it jumps, within one period.
    #[must_use]
    pub fn jumps(&self) -> &[f64] {
        &self.jumps
    }

    /// Its period, if it has one.
    #[must_use]
    pub fn period(&self) -> Option<f64> {
        self.periodic.then(|| self.width())
    }

    /// The first and the last knot.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        [self.knots[0], self.knots[self.knots.len() - 1]]
    }

    /// The greatest value of its rows except the last.
    pub(crate) fn size(&self) -> f64 {
        self.pieces.iter().map(|piece| piece[0].abs()).fold(0.0, f64::max)
    }

    fn width(&self) -> f64 {
        let [first, last] = self.range();
        last - first
    }

    /// The piece that contains `x`; at a knot the one behind it.
    pub(crate) fn cell(&self, x: f64) -> Option<Cell> {
        let [first, last] = self.range();
        // Rounding beyond an end counts as the end.
        let slack = RANGE_RTOL * (last - first).max(first.abs()).max(last.abs());
        let within = self.periodic || (first - slack..=last + slack).contains(&x);
        if !x.is_finite() || !within {
            return None;
        }
        let periods = if self.periodic { ((x - first) / self.width()).floor() } else { 0.0 };
        let within = x - self.width() * periods;
        let after = self.knots.partition_point(|&knot| knot <= within);
        Some(self.cell_of(after.clamp(1, self.pieces.len()) - 1, periods))
    }

    fn cell_of(&self, piece: usize, periods: f64) -> Cell {
        Cell { piece, periods, start: self.knots[piece] + periods * self.width() }
    }

    /// The knots at the ends of a piece; each end is the next piece's start, to the last bit.
    pub(crate) fn ends(&self, cell: Cell) -> [f64; 2] {
        let end = self.next(cell, true).map(|next| next.start);
        [cell.start, end.unwrap_or(self.range()[1])]
    }

    /// The next piece (`up`) or the previous one.
    pub(crate) fn next(&self, cell: Cell, up: bool) -> Option<Cell> {
        let last = self.pieces.len() - 1;
        let Cell { piece, periods, .. } = cell;
        match up {
            true if piece < last => Some(self.cell_of(piece + 1, periods)),
            false if piece > 0 => Some(self.cell_of(piece - 1, periods)),
            true => self.periodic.then(|| self.cell_of(0, periods + 1.0)),
            false => self.periodic.then(|| self.cell_of(last, periods - 1.0)),
        }
    }

    /// Value and slope of a piece, also a little beyond it.
    #[inline]
    pub(crate) fn read(&self, cell: Cell, x: f64) -> [f64; 2] {
        let [a, b, c, d] = self.pieces[cell.piece];
        let x = x - cell.start;
        [a + x * (b + x * (c + x * d)), b + x * (2.0 * c + x * (3.0 * d))]
    }

    /// Approximate number of knots in an interval of this length.
    pub(crate) fn knots_in(&self, length: f64) -> f64 {
        let knots = self.knots.len() as f64;
        if self.periodic { knots * (1.0 + length / self.width()) } else { knots }
    }

    /// The knots inside an interval, ascending.
    pub(crate) fn knots_within(&self, [low, high]: [f64; 2]) -> Vec<f64> {
        let mut knots = Vec::new();
        let [first, last] = self.range();
        let mut cell = self.cell(if self.periodic { low } else { low.clamp(first, last) });
        while let Some(current) = cell {
            let [start, end] = self.ends(current);
            if start > high {
                break;
            }
            knots.push(start);
            cell = self.next(current, true);
            if cell.is_none() {
                knots.push(end);
            }
        }
        knots.retain(|knot| *knot > low && *knot < high);
        knots
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_knot_given_twice_is_a_jump() {
        let linear = EndCondition::Linear;
        let knots = [0.0, 1.0, 1.0, 3.0];
        let table =
            Table::with_jumps(&knots, &[0.0, 2.0, 5.0, 0.0], linear, true).expect("a table");
        assert_eq!((table.knots(), table.jumps()), (&[0.0, 1.0, 3.0][..], &[1.0][..]));
        assert_eq!([0.5, 1.0, 2.0, 3.5].map(|x| table.at(x)), [1.0, 5.0, 2.5, 1.0]);
        assert_eq!(table.read(table.cell(0.5).expect("a piece"), 1.0)[0], 2.0);
        let seam = Table::with_jumps(&[0.0, 0.0, 3.0], &[1.0, 4.0, 1.0], linear, true);
        let seam = seam.expect("a table");
        assert_eq!((seam.knots(), seam.jumps()), (&[0.0, 3.0][..], &[0.0][..]));
        assert_eq!([0.0, 1.0, 3.0].map(|x| seam.at(x)), [4.0, 3.0, 4.0]);
        let last = Table::with_jumps(&[0.0, 3.0, 3.0], &[4.0, 1.0, 4.0], linear, true);
        assert_eq!([0.0, 1.0, 3.0].map(|x| last.as_ref().expect("a table").at(x)), [4.0, 3.0, 4.0]);
        let natural = |knots: &[f64], periodic| {
            Table::with_jumps(knots, &[0.0, 2.0, 5.0, 0.0], EndCondition::Natural, periodic)
        };
        assert!(natural(&knots, false).is_ok());
        assert!(natural(&[0.0, 1.0, 1.0, 1.0], false).is_err());
        assert!(natural(&[0.0, 0.0, 1.0, 2.0], false).is_err());
        let periodic = EndCondition::Periodic;
        assert!(Table::with_jumps(&knots, &[0.0, 2.0, 5.0, 0.0], periodic, true).is_err());
    }

    #[test]
    fn pieces_are_adjacent() {
        let knots = [0.0, 1.0, 3.0];
        let table =
            Table::new(&knots, &[1.0, 2.0, 1.0], EndCondition::Linear, true).expect("a table");
        assert_eq!(table.at(0.5), 1.5);
        assert_eq!(table.at(-1.0), 1.5);
        let cell = table.cell(7.5).expect("periodic");
        assert_eq!(table.ends(cell), [7.0, 9.0]);
        assert_eq!(table.read(cell, 8.0), [1.5, -0.5]);
        let next = table.next(cell, true).expect("periodic");
        assert_eq!(table.ends(next), [9.0, 10.0]);
        assert_eq!(table.next(next, false), Some(cell));
        assert_eq!(table.knots_within([0.5, 6.5]), [1.0, 3.0, 4.0, 6.0]);
        let once =
            Table::new(&knots, &[1.0, 2.0, 5.0], EndCondition::Linear, false).expect("a table");
        assert!(once.at(3.1).is_nan());
        assert_eq!(once.at(3.0), 5.0);
        assert_eq!(once.next(once.cell(2.0).expect("inside"), true), None);
        assert_eq!(once.knots_within([-9.0, 9.0]), knots);
    }
}
