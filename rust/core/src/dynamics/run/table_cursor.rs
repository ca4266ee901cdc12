//! Tables over the coordinate, read piece by piece: between two knots the equation of motion is
//! smooth, and steps end at them.

use crate::dynamics::tables::table::{Cell, Table};

/// Knots nearer than this part of their size (or of 1) are one: coordinates that count turns are
/// not better known.
pub(crate) const SAME_KNOT_RTOL: f64 = 1.0e-12;

/// The pieces that tables are in, and the interval that has no knot inside.
#[derive(Debug, Clone)]
pub(crate) struct TableCursor {
    cells: Vec<Cell>,
    pub low: f64,
    pub high: f64,
}

impl TableCursor {
    pub(crate) fn new() -> Self {
        // Nowhere yet.
        Self { cells: Vec::new(), low: f64::INFINITY, high: f64::NEG_INFINITY }
    }

    /// Looks a coordinate up in all tables.
    ///
    /// # Errors
    ///
    /// The table that has nothing there.
    pub(crate) fn look_up(&mut self, tables: &[Table], x: f64) -> Result<(), usize> {
        self.cells.clear();
        // Of a place that is in no pieces nothing is read.
        (self.low, self.high) = (f64::INFINITY, f64::NEG_INFINITY);
        for (which, table) in tables.iter().enumerate() {
            self.cells.push(table.cell(x).ok_or(which)?);
        }
        self.update_interval(tables);
        Ok(())
    }

    /// Goes on to the next piece of every table that has a knot at this end of the interval, and
    /// says where that is: inside the next interval.
    ///
    /// # Errors
    ///
    /// The table that has nothing beyond.
    pub(crate) fn cross(&mut self, tables: &[Table], up: bool) -> Result<f64, usize> {
        let border = if up { self.high } else { self.low };
        let near = SAME_KNOT_RTOL * border.abs().max(1.0);
        for (which, (table, cell)) in tables.iter().zip(&mut self.cells).enumerate() {
            let end = table.ends(*cell)[usize::from(up)];
            if (end - border).abs() <= near {
                *cell = table.next(*cell, up).ok_or(which)?;
            }
        }
        self.update_interval(tables);
        // Knots of several tables that are one may lie apart by a last digit.
        Ok(if up { border.max(self.low) } else { border.min(self.high) })
    }

    fn update_interval(&mut self, tables: &[Table]) {
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
