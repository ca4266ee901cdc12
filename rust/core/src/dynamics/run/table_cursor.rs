//! Current pieces of the tables over the coordinate: between two knots the equation of motion is
//! smooth, and steps end at the knots.

use crate::dynamics::tables::table::{Cell, Table};

/// Knots closer than this, relative to their size (or to the coordinate's unit), count as one:
/// coordinates that count turns are not more accurate.
pub(crate) const SAME_KNOT_RTOL: f64 = 1.0e-12;

/// Distance within which another coordinate is the same as this one; `unit` is that of the coordinate.
pub(crate) fn same_within(x: f64, unit: f64) -> f64 {
    SAME_KNOT_RTOL * x.abs().max(unit)
}

/// Largest number of table knots in a run along the coordinate: they are all listed beforehand.
pub(crate) const MAX_KNOTS: f64 = 1.0e7;
/// Coordinates beyond this many units are too coarse for a table's knots.
pub(crate) const MAX_COORDINATE: f64 = 1.0e9;

/// The current piece of every table, and the interval between their nearest knots.
#[derive(Debug, Clone)]
pub(crate) struct TableCursor {
    cells: Vec<Cell>,
    /// That of the coordinate.
    unit: f64,
    pub low: f64,
    pub high: f64,
}

impl TableCursor {
    pub(crate) fn new(unit: f64) -> Self {
        // An empty interval: no piece yet.
        Self { cells: Vec::new(), unit, low: f64::INFINITY, high: f64::NEG_INFINITY }
    }

    /// Looks up a coordinate in all tables.
    ///
    /// # Errors
    ///
    /// Index of the table that does not cover it.
    pub(crate) fn look_up(&mut self, tables: &[Table], x: f64) -> Result<(), usize> {
        self.cells.clear();
        // On an error the interval stays empty.
        (self.low, self.high) = (f64::INFINITY, f64::NEG_INFINITY);
        for (which, table) in tables.iter().enumerate() {
            self.cells.push(table.cell(x).ok_or(which)?);
        }
        self.update_interval(tables);
        Ok(())
    }

    /// Moves every table that has a knot at this end of the interval to its next piece. Returns the
    /// knot's coordinate, inside the new interval.
    ///
    /// # Errors
    ///
    /// Index of the table that ends there.
    pub(crate) fn cross(&mut self, tables: &[Table], up: bool) -> Result<f64, usize> {
        let border = if up { self.high } else { self.low };
        let near = same_within(border, self.unit);
        for (which, (table, cell)) in tables.iter().zip(&mut self.cells).enumerate() {
            let end = table.ends(*cell)[usize::from(up)];
            if (end - border).abs() <= near {
                *cell = table.next(*cell, up).ok_or(which)?;
            }
        }
        self.update_interval(tables);
        // Coinciding knots of several tables may differ by rounding.
        Ok(if up { border.max(self.low) } else { border.min(self.high) })
    }

    pub(crate) fn update_interval(&mut self, tables: &[Table]) {
        (self.low, self.high) = (f64::NEG_INFINITY, f64::INFINITY);
        for (table, &cell) in tables.iter().zip(&self.cells) {
            let [low, high] = table.ends(cell);
            (self.low, self.high) = (self.low.max(low), self.high.min(high));
        }
    }

    /// Value and slope of every table.
    #[inline]
    pub(crate) fn read(&self, tables: &[Table], x: f64, readings: &mut [[f64; 2]]) {
        for ((reading, table), &cell) in readings.iter_mut().zip(tables).zip(&self.cells) {
            *reading = table.read(cell, x);
        }
    }
}
