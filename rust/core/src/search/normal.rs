//! Rows of linearised residuals, and their normal equations.

use crate::batch::dispatch::{Entry, Task};
use crate::math::lanes::{LANES, Real};
use crate::math::vector::Vector;
use crate::population::adjoint::Jacobian;

/// The derivative of a distance: of the point `part` of the way from position `from` to `to` of the curve, along a
/// unit vector times the square root of its weight.
#[derive(Debug, Clone, Copy)]
pub(super) struct DistanceRow {
    pub from: usize,
    pub to: usize,
    pub part: f64,
    pub along: Vector,
    /// The distance, times the same root.
    pub residual: f64,
}

/// The derivative of the place at a given part of the curve's length: it lies `part` of the way from position
/// `from` to the next.
#[derive(Debug, Clone, Copy)]
pub(super) struct OrderedRow {
    pub from: usize,
    pub part: f64,
    /// Part of the length before it.
    pub length_part: f64,
    /// From the target to it, times the root of the weight.
    pub residual: Vector,
}

/// A segment of the curve, from one position to the next.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct CurveSegment {
    /// Unit vector along it; 0 without a length.
    pub along: Vector,
    /// Derivative of the objective by its length, as far as lengths are weights in it.
    pub by_length: f64,
}

/// What is linearised.
#[derive(Debug, Clone, Default)]
pub(super) struct Rows {
    pub distances: Vec<DistanceRow>,
    pub ordered: Vec<OrderedRow>,
    /// Root of the weight of ordered residuals.
    pub ordered_root: f64,
    pub segments: Vec<CurveSegment>,
}

/// The normal equations H d = −g. H is stored in rows of the Jacobian's width, its lower half by blocks.
#[derive(Debug, Clone, Default)]
pub(super) struct Normal {
    pub h: Vec<f64>,
    pub g: Vec<f64>,
    pub width: usize,
    rows: Vec<f64>,
    residuals: Vec<f64>,
    /// Derivatives of the length before each position.
    lengths: Vec<f64>,
}

impl Normal {
    /// Adds `weight` v vᵀ to H and `slope` v to g.
    pub(super) fn add(&mut self, v: &[f64], weight: f64, slope: f64) {
        for (p, (&entry, row)) in v.iter().zip(self.h.chunks_exact_mut(self.width)).enumerate() {
            for (h, &other) in row[..=p].iter_mut().zip(v) {
                *h += weight * entry * other;
            }
        }
        for (g, &entry) in self.g.iter_mut().zip(v) {
            *g += slope * entry;
        }
    }
}

/// Sets up the normal equations.
pub(super) fn assemble<L: Entry>(rows: &Rows, jacobian: &Jacobian, normal: &mut Normal) {
    let width = jacobian.width;
    let count = rows.distances.len() + 2 * rows.ordered.len();
    normal.width = width;
    normal.rows.resize(count * width, 0.0);
    normal.residuals.clear();
    normal.residuals.extend(rows.distances.iter().map(|row| row.residual));
    for row in &rows.ordered {
        normal.residuals.extend([row.residual.x, row.residual.y]);
    }
    normal.lengths.resize((rows.segments.len() + 1) * width, 0.0);
    normal.h.resize(width * width, 0.0);
    normal.g.resize(width, 0.0);
    L::call(&mut Assemble { rows, jacobian, normal });
}

struct Assemble<'a> {
    rows: &'a Rows,
    jacobian: &'a Jacobian,
    normal: &'a mut Normal,
}

impl<R: Real> Task<R> for Assemble<'_> {
    #[inline(always)]
    fn run(&mut self) {
        let width = self.jacobian.width;
        for column in (0..width).step_by(R::LANES) {
            self.sum_lengths::<R>(column);
            self.write_distances::<R>(column);
            self.write_ordered::<R>(column);
        }
        for column in (0..width).step_by(R::LANES) {
            self.gradient::<R>(column);
            for first in (0..width).step_by(LANES) {
                // Blocks above the diagonal are not used.
                if first + LANES > column {
                    self.products::<R>(first, column);
                }
            }
        }
    }
}

impl Assemble<'_> {
    /// The derivatives of a coordinate at a position by the numbers from `column` on.
    #[inline(always)]
    fn at<R: Real>(&self, position: usize, axis: usize, column: usize) -> R {
        R::read(&self.jacobian.row(position, axis)[column..])
    }

    /// Derivatives of the lengths before all positions.
    #[inline(always)]
    fn sum_lengths<R: Real>(&mut self, column: usize) {
        let width = self.jacobian.width;
        let positions = self.jacobian.positions();
        let mut sum = R::ZERO;
        sum.put(&mut self.normal.lengths[column..]);
        for (t, segment) in self.rows.segments.iter().enumerate() {
            let next = if t + 1 == positions { 0 } else { t + 1 };
            let along = Vector::<R>::splat(segment.along);
            let x = self.at::<R>(next, 0, column) - self.at(t, 0, column);
            let y = self.at::<R>(next, 1, column) - self.at(t, 1, column);
            sum += along.x * x + along.y * y;
            sum.put(&mut self.normal.lengths[(t + 1) * width + column..]);
        }
    }

    #[inline(always)]
    fn write_distances<R: Real>(&mut self, column: usize) {
        let width = self.jacobian.width;
        for (index, row) in self.rows.distances.iter().enumerate() {
            let along = Vector::<R>::splat(row.along);
            let from =
                along.x * self.at(row.from, 0, column) + along.y * self.at(row.from, 1, column);
            let value = if row.part == 0.0 {
                from
            } else {
                let to =
                    along.x * self.at(row.to, 0, column) + along.y * self.at(row.to, 1, column);
                from + R::splat(row.part) * (to - from)
            };
            value.put(&mut self.normal.rows[index * width + column..]);
        }
    }

    /// With α = (s L − ℓ) / l, l the length of the segment and ℓ that before it: dα = (s dL − dℓ − α dl) / l.
    #[inline(always)]
    fn write_ordered<R: Real>(&mut self, column: usize) {
        let width = self.jacobian.width;
        let positions = self.jacobian.positions();
        let root = R::splat(self.rows.ordered_root);
        let length = |lengths: &[f64], t: usize| R::read(&lengths[t * width + column..]);
        let total = length(&self.normal.lengths, self.rows.segments.len());
        for (index, row) in self.rows.ordered.iter().enumerate() {
            let (from, segment) = (row.from, &self.rows.segments[row.from]);
            let next = if from + 1 == positions { 0 } else { from + 1 };
            let before = length(&self.normal.lengths, from);
            let own = length(&self.normal.lengths, from + 1) - before;
            let part = R::splat(row.part);
            let shift = R::splat(row.length_part) * total - before - part * own;
            for axis in 0..2 {
                let along = if axis == 0 { segment.along.x } else { segment.along.y };
                let start = self.at::<R>(from, axis, column);
                let value = start + part * (self.at::<R>(next, axis, column) - start);
                let value = (value + R::splat(along) * shift) * root;
                let place = (self.rows.distances.len() + 2 * index + axis) * width;
                value.put(&mut self.normal.rows[place + column..]);
            }
        }
    }

    /// g = Σ residual · row, and what follows from lengths that are weights.
    #[inline(always)]
    fn gradient<R: Real>(&mut self, column: usize) {
        let width = self.jacobian.width;
        let mut sum = R::ZERO;
        for (residual, row) in
            self.normal.residuals.iter().zip(self.normal.rows.chunks_exact(width))
        {
            sum += R::splat(*residual) * R::read(&row[column..]);
        }
        for (t, segment) in self.rows.segments.iter().enumerate() {
            let lengths = &self.normal.lengths[t * width + column..];
            let own = R::read(&lengths[width..]) - R::read(lengths);
            sum += R::splat(segment.by_length) * own;
        }
        sum.put(&mut self.normal.g[column..]);
    }

    /// A block of H: eight rows from `first` on, as many columns as lanes.
    #[inline(always)]
    fn products<R: Real>(&mut self, first: usize, column: usize) {
        let width = self.jacobian.width;
        let mut sums = [R::ZERO; LANES];
        for row in self.normal.rows.chunks_exact(width) {
            let columns = R::read(&row[column..]);
            for (sum, &entry) in sums.iter_mut().zip(&row[first..first + LANES]) {
                *sum += R::splat(entry) * columns;
            }
        }
        for (index, sum) in sums.into_iter().enumerate() {
            sum.put(&mut self.normal.h[(first + index) * width + column..]);
        }
    }
}
