//! The rows of arrays that are in the lanes of a register.

use crate::math::lanes::Real;
use crate::math::vector::Vector;

/// The positions in the lanes: from `first` on, a multiple of the lanes; those beyond the last position
/// repeat it.
#[derive(Clone, Copy)]
pub(crate) struct Rows {
    pub first: usize,
    pub last: usize,
}

impl Rows {
    /// The number `offset` of each position's `width` numbers.
    #[inline(always)]
    pub(crate) fn read<R: Real>(self, values: &[f64], width: usize, offset: usize) -> R {
        let first = self.first * width;
        if R::PARTS > 1 {
            return R::of_parts(&values[R::PARTS * (first + offset)..]);
        }
        // Widths known to the compiler are read by few instructions.
        match (values.get(first..first + R::LANES * width), width) {
            (Some(all), 1) => R::read(all),
            (Some(all), 2) => R::read(all).unzip(R::read(&all[R::LANES..]))[offset],
            _ => R::from_lanes(|lane| values[(self.first + lane).min(self.last) * width + offset]),
        }
    }
}

impl Rows {
    /// Writes the number `offset` of each position's `width` numbers.
    #[inline(always)]
    pub(crate) fn write<R: Real>(self, values: &mut [f64], width: usize, offset: usize, number: R) {
        let lanes = R::LANES.min(self.last + 1 - self.first);
        let values = &mut values[self.first * width..(self.first + lanes) * width];
        if width == 1 && values.len() == R::LANES {
            for lane in 0..R::LANES {
                values[lane] = number.lane(lane);
            }
        } else {
            for (lane, values) in values.chunks_exact_mut(width).enumerate() {
                values[offset] = number.lane(lane);
            }
        }
    }
}

impl Rows {
    /// Writes the numbers from `first` on of each position's `width` numbers.
    #[inline(always)]
    pub(crate) fn write_some<R: Real, const N: usize>(
        self,
        values: &mut [f64],
        width: usize,
        first: usize,
        numbers: [R; N],
    ) {
        if let ([x, y], 2) = (&numbers[..], width)
            && let Some(all) = values.get_mut(2 * self.first..2 * (self.first + R::LANES))
        {
            let [before, after] = x.zip(*y);
            for lane in 0..R::LANES {
                all[lane] = before.lane(lane);
                all[R::LANES + lane] = after.lane(lane);
            }
            return;
        }
        for (offset, &number) in (first..).zip(&numbers) {
            self.write(values, width, offset, number);
        }
    }

    /// A speed or acceleration of one of `n` drivers: for each position, or the same for all.
    #[inline(always)]
    pub(crate) fn read_drive<R: Real>(self, values: &[f64], n: usize, driver: usize) -> R {
        if values.len() == R::PARTS * n {
            return R::of_parts(&values[R::PARTS * driver..]);
        }
        self.read(values, n, driver)
    }

    /// The rate of a quantity with these first derivatives, at speeds of the drivers.
    #[inline(always)]
    pub(crate) fn rate<R: Real>(self, derivatives: &[f64], speeds: &[R]) -> R {
        let mut rate = R::ZERO;
        for (driver, &speed) in speeds.iter().enumerate() {
            rate += self.solved::<R>(derivatives, speeds.len(), driver) * speed;
        }
        rate
    }

    /// The sum of the absolute values that each driver adds to such a rate.
    #[inline(always)]
    pub(crate) fn rate_size<R: Real>(self, derivatives: &[f64], speeds: &[R]) -> R {
        let mut sum = R::ZERO;
        for (driver, &speed) in speeds.iter().enumerate() {
            sum += self.solved::<R>(derivatives, speeds.len(), driver).abs() * speed.abs();
        }
        sum
    }

    /// The same for the velocity of a point.
    #[inline(always)]
    pub(crate) fn velocity_size<R: Real>(self, derivatives: &[f64], speeds: &[R]) -> R {
        let mut sum = R::ZERO;
        for (driver, &speed) in speeds.iter().enumerate() {
            let rate = self.pairs::<R>(derivatives, speeds.len(), driver);
            sum += rate.size() * speed.abs();
        }
        sum
    }

    /// Number `entry` of `width` of each solved position, in blocks.
    #[inline(always)]
    pub(crate) fn solved<R: Real>(self, column: &[f64], width: usize, entry: usize) -> R {
        R::of_block(column, self.first, width, entry)
    }

    /// The entry `offset` of `width` pairs of each solved position: all its first numbers come before the
    /// second ones.
    #[inline(always)]
    pub(crate) fn pairs<R: Real>(self, column: &[f64], width: usize, offset: usize) -> Vector<R> {
        Vector::new(
            self.solved(column, 2 * width, offset),
            self.solved(column, 2 * width, width + offset),
        )
    }
}
