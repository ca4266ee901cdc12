//! Lower bounds of the distances of a path's stretches from a line: from few points of each and from running
//! sums, for all stretches side by side.

use std::cell::Cell;

use crate::batch::dispatch::{Entry, ForLevel, Task, at_level};
use crate::math::lanes::{LANES, Real};
use crate::math::simd::Simd;
use crate::math::vector::Vector;

/// Distances by running sums differ from others by at most this part of the size of the path: a stretch of a
/// thousandth of the path has moments and a direction to nine digits.
const RUNNING_SUMS: f64 = 1.0e-6;

/// Rows of the table: x and y of each point, sums of x, y, xx, xy and yy over all points before one
/// (all from the path's first point), and the two bounds.
const POINTS: usize = 0;
const SUMS: usize = 2;
const OF_THREE: usize = 7;
const OF_SUMS: usize = 8;
const ROWS: usize = 9;

thread_local! {
    /// The table of the last path: allocating one takes as long as filling it.
    static TABLE: Cell<Vec<f64>> = const { Cell::new(Vec::new()) };
}

/// Squares of least distances of every stretch of a path with some number of points.
pub(super) struct LineBounds {
    /// All rows, one after another.
    table: Vec<f64>,
    /// Length of a row: registers may read, and write, beyond the last number.
    width: usize,
    count: usize,
    starts: usize,
    /// Error of a distance by running sums.
    pub rounding: f64,
}

impl LineBounds {
    /// The best of all stretches of `count` points, at least one.
    pub(super) fn of(path: &[Vector], count: usize) -> Self {
        let width = path.len() + 1 + LANES;
        let starts = (path.len() + 1).saturating_sub(count);
        // Every number is written before it is read, except the sums over no points.
        let mut table = TABLE.take();
        table.resize(ROWS * width, 0.0);
        for k in 0..5 {
            table[(SUMS + k) * width] = 0.0;
        }
        let mut bounds = Self { table, width, count, starts, rounding: 0.0 };
        bounds.add(path);
        at_level(Simd::best(), &mut bounds);
        bounds
    }

    /// From any line, by the first, middle and last point of each stretch: half of the least altitude
    /// of their triangle (a little less, for rounding).
    pub(super) fn of_three(&self) -> &[f64] {
        &self.row(OF_THREE)[..self.starts]
    }

    /// From the line of least squares by running sums: the farthest of the ends and the middle.
    pub(super) fn of_sums(&self) -> &[f64] {
        &self.row(OF_SUMS)[..self.starts]
    }

    /// Sets points and sums.
    fn add(&mut self, path: &[Vector]) {
        let origin = path.first().copied().unwrap_or(Vector::ZERO);
        let (mut sum, mut size) = ([0.0; 5], 0.0);
        for (index, &point) in path.iter().enumerate() {
            let Vector { x, y } = point - origin;
            self.table[POINTS * self.width + index] = x;
            self.table[(POINTS + 1) * self.width + index] = y;
            for (k, term) in [x, y, x * x, x * y, y * y].into_iter().enumerate() {
                sum[k] += term;
                self.table[(SUMS + k) * self.width + index + 1] = sum[k];
            }
            size = if x.abs() + y.abs() > size { x.abs() + y.abs() } else { size };
        }
        self.rounding = RUNNING_SUMS * size;
    }

    #[inline(always)]
    fn row(&self, row: usize) -> &[f64] {
        &self.table[row * self.width..(row + 1) * self.width]
    }

    /// A register of points from the one at an index on.
    #[inline(always)]
    fn point<R: Real>(&self, index: usize) -> Vector<R> {
        Vector::new(R::read(&self.row(POINTS)[index..]), R::read(&self.row(POINTS + 1)[index..]))
    }

    #[inline(always)]
    fn set<R: Real>(&mut self, row: usize, start: usize, numbers: R) {
        let out = &mut self.table[row * self.width + start..][..R::LANES];
        for (lane, out) in out.iter_mut().enumerate() {
            *out = numbers.lane(lane);
        }
    }
}

impl Drop for LineBounds {
    fn drop(&mut self) {
        TABLE.set(std::mem::take(&mut self.table));
    }
}

impl<R: Real> Task<R> for &mut LineBounds {
    #[inline(always)]
    fn run(&mut self) {
        let parts = R::splat(1.0 / self.count as f64);
        for start in (0..self.starts).step_by(R::LANES) {
            let last = start + self.count - 1;
            let from = self.point::<R>(start);
            let to = self.point(last);
            let (a, b) = (self.point(start + self.count / 2) - from, to - from);
            let twice_area = a.cross(b);
            let longest2 = a.norm2().max(b.norm2()).max((b - a).norm2());
            let altitude2 = twice_area * twice_area / longest2;
            // The triangle may be a point.
            let least2 = (altitude2 * R::splat(0.25 - 1.0e-9)).max(R::ZERO);
            self.set(OF_THREE, start, least2);

            let mut sums = [R::ZERO; 5];
            for (k, sum) in sums.iter_mut().enumerate() {
                let column = self.row(SUMS + k);
                *sum = R::read(&column[last + 1..]) - R::read(&column[start..]);
            }
            let [x, y, xx, xy, yy] = sums;
            let mean = Vector::new(x * parts, y * parts);
            let (xx, xy, yy) = (xx - x * mean.x, xy - x * mean.y, yy - y * mean.y);
            // The axis of the greater moment: tan 2α = 2 xy/(xx − yy).
            let half = R::splat(0.5) * (xx - yy);
            let radius = (half * half + xy * xy).sqrt();
            let is_flat = R::ZERO.lt(half);
            let along = Vector::new(
                R::select(is_flat, radius + half, xy),
                R::select(is_flat, xy, radius - half),
            );
            let mut most = R::ZERO;
            for point in [from, self.point(start + (self.count - 1) / 2), to] {
                most = along.cross(point - mean).abs().max(most);
            }
            // Without a direction the bound is 0.
            let far2 = (most * most / along.norm2()).max(R::ZERO);
            self.set(OF_SUMS, start, far2);
        }
    }
}

impl ForLevel for &mut LineBounds {
    type Output = ();

    fn run<L: Entry, const G: usize>(mut self) {
        L::call(&mut self);
    }
}
