//! Values over the driver's coordinate.

use super::error::TableError;
use super::polynomial::value;
use super::spline::{Ends, Pieces, spline};

/// A table over the first driver's coordinate, with a curve through its rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    knots: Vec<f64>,
    pieces: Pieces,
    periodic: bool,
}

impl Table {
    /// Lays the curve; `periodic`: one period of it is given.
    ///
    /// # Errors
    ///
    /// A table that is short, not growing, or no numbers; a period whose ends differ.
    pub fn new(
        knots: &[f64],
        values: &[f64],
        ends: Ends,
        periodic: bool,
    ) -> Result<Self, TableError> {
        super::turn::check_columns(knots, &[("value", values)], periodic)?;
        Ok(Self { knots: knots.to_vec(), pieces: spline(knots, values, ends)?, periodic })
    }

    /// The value at a coordinate; no number beyond a table that is not periodic.
    #[must_use]
    pub fn at(&self, q: f64) -> f64 {
        let (first, last) = (self.knots[0], self.knots[self.knots.len() - 1]);
        let within = if self.periodic {
            let period = last - first;
            q - period * ((q - first) / period).floor()
        } else if q >= first && q <= last {
            q
        } else {
            return f64::NAN;
        };
        let after = self.knots.partition_point(|&knot| knot <= within);
        let piece = after.clamp(1, self.knots.len() - 1) - 1;
        value(&self.pieces[piece], within - self.knots[piece])
    }
}

/// A number that a load or motor has.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// Always the same.
    Number(f64),
    /// Over the first driver's coordinate.
    Table(Table),
    /// Given from outside at every position: which of the numbers.
    Given(usize),
}

impl Value {
    /// The number at a coordinate, with those given from outside.
    pub(super) fn at(&self, q: f64, given: &[f64]) -> f64 {
        match self {
            Self::Number(number) => *number,
            Self::Table(table) => table.at(q),
            Self::Given(which) => given.get(*which).copied().unwrap_or(f64::NAN),
        }
    }
}
