//! Derivatives of a number by the positions of a curve.

use crate::math::vector::Vector;

/// The derivatives of a number by x and y at each position of a curve.
#[derive(Debug, Clone, Default)]
pub(super) struct Slopes {
    pub by: [Vec<f64>; 2],
    /// The number of positions; after the last the first comes.
    pub count: usize,
}

impl Slopes {
    /// Those of a number that depends on none of so many positions.
    pub(super) fn clear(&mut self, count: usize) {
        self.count = count;
        for list in &mut self.by {
            list.clear();
            list.resize(count, 0.0);
        }
    }

    /// The position after another.
    #[inline]
    pub(super) fn next(&self, t: usize) -> usize {
        if t + 1 == self.count { 0 } else { t + 1 }
    }

    /// Adds a slope at a position.
    #[inline]
    pub(super) fn add(&mut self, t: usize, slope: Vector) {
        self.by[0][t] += slope.x;
        self.by[1][t] += slope.y;
    }

    /// Adds slopes at position `t` and the next.
    #[inline]
    pub(super) fn add_ends(&mut self, t: usize, slopes: [Vector; 2]) {
        self.add(t, slopes[0]);
        self.add(self.next(t), slopes[1]);
    }

    /// Adds a slope by the length of the segment from position `t` to the next, along a unit vector.
    #[inline]
    pub(super) fn add_length(&mut self, t: usize, along: Vector, slope: f64) {
        self.add_ends(t, [along.scale(-slope), along.scale(slope)]);
    }
}
