//! The columns of a table over a coordinate, and its period.

use super::error::TableError;

/// Largest difference between the ends of a table, relative to its greatest value: tables are
/// rounded.
const PERIODIC_RTOL: f64 = 1.0e-9;

/// Reduces `x` to the period that begins at `start`; returns it and the number of periods taken
/// off. The remainder of a division is exact, so `x` may be of any size.
pub(crate) fn wrap_to_period(x: f64, start: f64, period: f64) -> [f64; 2] {
    if (start..start + period).contains(&x) {
        return [x, 0.0];
    }
    let since = x - start;
    let rest = since.rem_euclid(period);
    [start + rest, ((since - rest) / period).round()]
}

/// Checks that the coordinates increase (with `jumps`: some may be there twice), and that periodic
/// columns have equal ends.
pub(crate) fn check_columns(
    knots: &[f64],
    columns: &[(&'static str, &[f64])],
    periodic: bool,
    jumps: bool,
) -> Result<(), TableError> {
    let all = || std::iter::once(("phi", knots)).chain(columns.iter().copied());
    let count = all().map(|(_, column)| column.len()).min().unwrap_or(0);
    if let Some((quantity, column)) = columns.iter().find(|(_, c)| c.len() != knots.len()) {
        let (given, needed) = (column.len(), knots.len());
        return Err(TableError::Unequal { quantity, given, needed });
    }
    if count < 2 {
        return Err(TableError::TooShort { count, least: 2 });
    }
    for (quantity, column) in all() {
        if let Some(row) = column.iter().position(|x| !x.is_finite()) {
            return Err(TableError::NotFinite { row, quantity, value: column[row] });
        }
    }
    let is_back = |row: usize| {
        if jumps { knots[row] < knots[row - 1] } else { knots[row] <= knots[row - 1] }
    };
    if let Some(row) = (1..count).find(|&row| is_back(row)) {
        let (value, before) = (knots[row], knots[row - 1]);
        return Err(TableError::NotIncreasing { row, value, before });
    }
    if let Some(row) = (2..count).find(|&row| knots[row] == knots[row - 2]) {
        return Err(TableError::Tripled { at: knots[row] });
    }
    for &(quantity, column) in columns.iter().filter(|_| periodic) {
        let (first, last) = (column[0], column[count - 1]);
        let greatest = column.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        if (first - last).abs() > PERIODIC_RTOL * greatest {
            return Err(TableError::NotPeriodic { quantity, first, last });
        }
    }
    Ok(())
}
