//! Registers of many entries, one entry after another: each has a register for so many lanes of positions.

use crate::math::lanes::{LANES, Real};
use crate::math::vector::Vector;

/// Reads number `entry` of `width` of the rows from `row` on.
#[inline(always)]
pub(super) fn read_numbers<R: Real>(
    numbers: &mut [R],
    column: &[f64],
    row: usize,
    (width, entry): (usize, usize),
) {
    if R::LANES == LANES {
        // Registers begin where blocks do.
        let blocks = column[row * width..].chunks_exact(LANES * width);
        for (number, block) in numbers.iter_mut().zip(blocks) {
            *number = R::read(&block[entry * LANES..][..LANES]);
        }
        return;
    }
    for (g, number) in numbers.iter_mut().enumerate() {
        *number = R::of_block(column, row + g * R::LANES, width, entry);
    }
}

/// The same for both numbers of vectors.
#[inline(always)]
pub(super) fn read_vectors<R: Real>(vectors: &mut [Vector<R>], column: &[f64], row: usize) {
    if R::LANES == LANES {
        let blocks = column[row * 2..].chunks_exact(LANES * 2);
        for (vector, block) in vectors.iter_mut().zip(blocks) {
            *vector = Vector::new(R::read(&block[..LANES]), R::read(&block[LANES..]));
        }
        return;
    }
    for (g, vector) in vectors.iter_mut().enumerate() {
        let row = row + g * R::LANES;
        *vector = Vector::new(R::of_block(column, row, 2, 0), R::of_block(column, row, 2, 1));
    }
}

/// The registers of an entry.
#[inline(always)]
pub(super) fn entry<T>(values: &[T], index: usize, registers: usize) -> &[T] {
    &values[index * registers..][..registers]
}

/// The same, to be written.
#[inline(always)]
pub(super) fn entry_mut<T>(values: &mut [T], index: usize, registers: usize) -> &mut [T] {
    &mut values[index * registers..][..registers]
}

/// Makes room for `count` values at least.
#[inline(always)]
pub(super) fn grow<T: Clone + Default>(values: &mut Vec<T>, count: usize) {
    if values.len() < count {
        values.resize(count, T::default());
    }
}
