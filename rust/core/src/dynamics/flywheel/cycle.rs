//! Reduced inertia and work over one period of the driver, as piecewise polynomials.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::dynamics::tables::columns::{check_columns, wrap_to_period};
use crate::dynamics::tables::error::TableError;
use crate::dynamics::tables::passes::is_cancelled;
use crate::dynamics::tables::spline::{EndCondition, Pieces, fit_sections};
use crate::math::polynomial::{roots, value};

/// Greatest fall of the inertia's curve below zero between rows that are not negative, relative to the
/// greatest inertia: tables have three or four digits, and a spline overshoots beside rows of zero.
/// With the flywheel added the inertia must still be positive.
const UNDERSHOOT_RTOL: f64 = 1.0e-3;

/// An extreme value and its coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Extreme {
    /// Coordinate of the driver, rad.
    pub at: f64,
    /// The value.
    pub value: f64,
}

/// Reduced inertia and work over one period, with a constant motor that balances the moments.
#[derive(Debug, Clone, PartialEq)]
pub struct Cycle {
    knots: Vec<f64>,
    moment: Pieces,
    inertia: Pieces,
    /// Work of all moments, motor included, from the start: in powers from each knot.
    work: Vec<[f64; 5]>,
    /// Moment of the motor, N·m: it makes the work of a period zero.
    pub motor: f64,
}

impl Cycle {
    /// Fits a table over one period: coordinates, reduced moment without the motor (N·m), reduced
    /// inertia (kg·m²). Two rows at one coordinate are a jump of the moment; a table with one may
    /// also jump at its seam, between its last row and its first. Once `cancel` is true the result is
    /// not to be used.
    ///
    /// # Errors
    ///
    /// The table is short, not increasing, not periodic, or its inertia is negative or jumps.
    pub fn new(
        knots: &[f64],
        moment: &[f64],
        inertia: &[f64],
        ends: EndCondition,
        cancel: &AtomicBool,
    ) -> Result<Self, TableError> {
        let unread = || TableError::TooShort { count: 0, least: 2 };
        let go_on = || (!cancel.load(Ordering::Relaxed)).then_some(()).ok_or_else(unread);
        let rows = with_seam(knots, moment, inertia);
        go_on()?;
        let (knots, moment, inertia) = (&rows[0][..], &rows[1][..], &rows[2][..]);
        check(knots, [("moment", moment), ("inertia", inertia)])?;
        go_on()?;
        let (merged, smooth) = without_jumps(knots, inertia)?;
        go_on()?;
        let jump = (1..knots.len()).find(|&row| knots[row] == knots[row - 1]);
        if let (Some(row), EndCondition::Periodic) = (jump, ends) {
            return Err(TableError::PeriodicJump { at: knots[row] });
        }
        let whole = 0..merged.len();
        let inertia =
            fit_sections(&merged, &smooth, ends, std::slice::from_ref(&whole), true, cancel)?;
        Self::of_pieces(merged, fit(knots, moment, ends, &[], cancel)?, inertia, cancel)
    }

    /// [`Cycle::new`] with corners at some rows: a separate curve is fitted from each corner to the next.
    /// The first and the last row may be among them. Two rows at one coordinate are a jump.
    ///
    /// # Errors
    ///
    /// Those of [`Cycle::new`].
    pub fn with_corners(
        knots: &[f64],
        moment: &[f64],
        inertia: &[f64],
        ends: EndCondition,
        corners: &[usize],
        cancel: &AtomicBool,
    ) -> Result<Self, TableError> {
        check(knots, [("moment", moment), ("inertia", inertia)])?;
        let fit = |values: &[f64]| fit(knots, values, ends, corners, cancel);
        let mut merged = knots.to_vec();
        merged.dedup();
        Self::of_pieces(merged, fit(moment)?, fit(inertia)?, cancel)
    }

    fn of_pieces(
        knots: Vec<f64>,
        moment: Pieces,
        inertia: Pieces,
        cancel: &AtomicBool,
    ) -> Result<Self, TableError> {
        let mut cycle = Self { knots, moment, inertia, work: Vec::new(), motor: 0.0 };
        cycle.integrate_work();
        // The motor balances the mean moment.
        cycle.motor = -cycle.total_work() / cycle.period();
        cycle.integrate_work();
        let [least, greatest] = cycle.extremes(1.0, 0.0, cancel);
        // NaN must fail too.
        let is_positive = least.value >= -UNDERSHOOT_RTOL * greatest.value;
        if !is_positive {
            return Err(TableError::Negative { value: least.value, at: least.at, in_row: false });
        }
        Ok(cycle)
    }

    fn integrate_work(&mut self) {
        self.work.clear();
        let mut sum = 0.0;
        for (piece, ends) in self.moment.iter().zip(self.knots.windows(2)) {
            let [a, b, c, d] = *piece;
            let work = [sum, a + self.motor, b / 2.0, c / 3.0, d / 4.0];
            sum = value(&work, ends[1] - ends[0]);
            self.work.push(work);
        }
    }

    fn total_work(&self) -> f64 {
        let last = self.knots.len() - 1;
        value(&self.work[last - 1], self.knots[last] - self.knots[last - 1])
    }

    /// Coordinate of the first row, rad.
    #[must_use]
    pub fn start(&self) -> f64 {
        self.knots[0]
    }

    /// Length of the period, rad.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.knots[self.knots.len() - 1] - self.knots[0]
    }

    /// The knots, rad.
    #[must_use]
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// The piece at a coordinate, the distance from its knot, and the whole periods before.
    pub(crate) fn locate(&self, phi: f64) -> (usize, f64, f64) {
        let [phi, periods] = wrap_to_period(phi, self.start(), self.period());
        let after = self.knots.partition_point(|&knot| knot <= phi);
        let piece = after.clamp(1, self.knots.len() - 1) - 1;
        (piece, phi - self.knots[piece], periods)
    }

    /// Reduced inertia, kg·m².
    #[must_use]
    pub fn inertia(&self, phi: f64) -> f64 {
        let (piece, x, _) = self.locate(phi);
        value(&self.inertia[piece], x)
    }

    /// Reduced moment without the motor, N·m.
    #[must_use]
    pub fn moment(&self, phi: f64) -> f64 {
        let (piece, x, _) = self.locate(phi);
        value(&self.moment[piece], x)
    }

    /// Work of all moments since the start of the period, J.
    #[must_use]
    pub fn work(&self, phi: f64) -> f64 {
        let (piece, x, _) = self.locate(phi);
        value(&self.work[piece], x)
    }

    /// Inertia and work in a piece, at a distance from its knot.
    pub(crate) fn inertia_and_work(&self, piece: usize, x: f64) -> [f64; 2] {
        [value(&self.inertia[piece], x), value(&self.work[piece], x)]
    }

    pub(crate) fn least_inertia(&self, cancel: &AtomicBool) -> Extreme {
        self.extremes(1.0, 0.0, cancel)[0]
    }

    /// Least and greatest value of `speed2 · I − work · W` over the period: its derivative is a
    /// cubic in every piece.
    pub(crate) fn extremes(&self, speed2: f64, work: f64, cancel: &AtomicBool) -> [Extreme; 2] {
        let combined = |piece: usize, x: f64| {
            let [inertia, energy] = self.inertia_and_work(piece, x);
            speed2 * inertia - work * energy
        };
        let first = Extreme { at: self.start(), value: combined(0, 0.0) };
        let [mut least, mut greatest] = [first; 2];
        for (piece, ends) in self.knots.windows(2).enumerate() {
            if is_cancelled(piece, cancel) {
                break;
            }
            let mut consider = |x: f64| {
                let here = Extreme { at: ends[0] + x, value: combined(piece, x) };
                if here.value < least.value {
                    least = here;
                }
                if here.value > greatest.value {
                    greatest = here;
                }
            };
            let width = ends[1] - ends[0];
            // The end of the last piece is the start of the first.
            consider(0.0);
            let ([_, i1, i2, i3], [_, w1, w2, w3, w4]) = (self.inertia[piece], self.work[piece]);
            let slope = [
                speed2 * i1 - work * w1,
                2.0 * (speed2 * i2 - work * w2),
                3.0 * (speed2 * i3 - work * w3),
                -4.0 * work * w4,
            ];
            roots(&slope, width, consider);
        }
        [least, greatest]
    }
}

/// Fits a period from each corner or jump to the next.
fn fit(
    knots: &[f64],
    values: &[f64],
    ends: EndCondition,
    corners: &[usize],
    cancel: &AtomicBool,
) -> Result<Pieces, TableError> {
    let last = knots.len() - 1;
    let mut cuts: Vec<usize> = [0]
        .into_iter()
        .chain(corners.iter().copied().filter(|&row| row > 0 && row < last))
        .chain((1..knots.len()).filter(|&i| knots[i] == knots[i - 1]).flat_map(|i| [i - 1, i]))
        .chain([last])
        .collect();
    cuts.sort_unstable();
    cuts.dedup();
    let sections: Vec<_> = cuts
        .windows(2)
        .filter(|cut| knots[cut[0]] < knots[cut[1]])
        .map(|cut| Range { start: cut[0], end: cut[1] + 1 })
        .collect();
    let has_corner = corners.iter().any(|&row| row == 0 || row == last);
    let closed = !has_corner && knots[0] < knots[1] && knots[last - 1] < knots[last];
    fit_sections(knots, values, ends, &sections, closed, cancel)
}

/// The coordinates, moments and inertias of a period. Where the moment jumps, and its ends differ, it
/// jumps at the seam too: the first row then appears twice, first with the last moment.
pub(crate) fn with_seam(knots: &[f64], moment: &[f64], inertia: &[f64]) -> [Vec<f64>; 3] {
    let mut rows = [knots, moment, inertia].map(<[f64]>::to_vec);
    let jumps: Vec<usize> = (1..knots.len()).filter(|&i| knots[i] == knots[i - 1]).collect();
    let at_seam = jumps.first() == Some(&1) || jumps.last() == Some(&(knots.len() - 1));
    let (Some(first), Some(last)) = (moment.first(), moment.last()) else { return rows };
    if !jumps.is_empty() && !at_seam && !inertia.is_empty() && first != last {
        rows[0].insert(0, knots[0]);
        rows[1].insert(0, *last);
        rows[2].insert(0, inertia[0]);
    }
    rows
}

/// The rows of an inertia, with one of two at the same coordinate: they must be equal.
///
/// # Errors
///
/// An inertia that jumps.
pub(crate) fn without_jumps(
    knots: &[f64],
    inertia: &[f64],
) -> Result<(Vec<f64>, Vec<f64>), TableError> {
    let is_second = |row: usize| row > 0 && knots[row] == knots[row - 1];
    let jump = (0..knots.len().min(inertia.len()))
        .find(|&row| is_second(row) && inertia[row] != inertia[row - 1]);
    if let Some(row) = jump {
        let (before, behind) = (inertia[row - 1], inertia[row]);
        return Err(TableError::InertiaJumps { at: knots[row], before, behind });
    }
    let rows = knots.iter().copied().zip(inertia.iter().copied()).enumerate();
    Ok(rows.filter(|&(row, _)| !is_second(row)).map(|(_, pair)| pair).unzip())
}

fn check(knots: &[f64], columns: [(&'static str, &[f64]); 2]) -> Result<(), TableError> {
    check_columns(knots, &columns, true, true)?;
    let inertia = columns[1].1;
    if let Some(row) = inertia.iter().position(|&x| x < 0.0) {
        return Err(TableError::Negative { value: inertia[row], at: knots[row], in_row: true });
    }
    Ok(())
}
