//! The objective near a curve: a quadratic function of its positions, and of the numbers of the linkage.
//!
//! Each residual pulls at one or two neighbouring positions P of the curve. So the Hessian W by positions (of Gauss and
//! Newton: without second derivatives of residuals) couples a position with the next alone; what few residuals of the
//! whole curve add is of low rank. With the Jacobian J of the positions by the numbers, H = Jᵀ W J and g = Jᵀ dF/dP.

use super::slopes::Slopes;
use crate::batch::dispatch::{Entry, Task};
use crate::math::lanes::{LANES, Real};
use crate::math::vector::Vector;
use crate::population::adjoint::Jacobian;

/// The objective as a function of the curve's positions.
#[derive(Debug, Clone, Default)]
pub(super) struct ByPositions {
    /// Its derivatives, but for those of residuals of the whole curve.
    pub slopes: Slopes,
    /// Second derivatives by xx, xy, yy of each position.
    own: [Vec<f64>; 3],
    /// The same by the position before (of the first: the last) and each position.
    couplings: [Vec<f64>; 3],
    /// Residuals that depend on all positions.
    pub whole: [Whole; WHOLE],
}

/// How many residuals of the whole curve there are.
pub(super) const WHOLE: usize = 3;

/// A residual of the whole curve.
#[derive(Debug, Clone, Default)]
pub(super) struct Whole {
    pub slopes: Slopes,
    pub weight: f64,
    pub residual: f64,
}

impl ByPositions {
    /// A function of so many positions, zero everywhere.
    pub(super) fn clear(&mut self, count: usize) {
        self.slopes.clear(count);
        for list in self.own.iter_mut().chain(&mut self.couplings) {
            list.clear();
            list.resize(count + 1, 0.0);
        }
        for whole in &mut self.whole {
            whole.slopes.clear(count);
            whole.weight = 0.0;
        }
    }

    /// Adds a function of the place that lies `part` of the way from position `from` to the next: its slope and its
    /// second derivatives by xx, xy, yy.
    pub(super) fn add(&mut self, (from, part): (usize, f64), slope: Vector, second: [f64; 3]) {
        let (to, rest) = (self.slopes.next(from), 1.0 - part);
        self.slopes.add_ends(from, [slope.scale(rest), slope.scale(part)]);
        for (axes, second) in second.into_iter().enumerate() {
            self.own[axes][from] += rest * rest * second;
            self.own[axes][to] += part * part * second;
            self.couplings[axes][from + 1] += part * rest * second;
        }
    }
}

/// Numbers whose products are summed side by side.
const TILE: usize = 4;
/// Entries of a tile's numbers at as many positions as a register has lanes: x of each number, then y.
const BLOCK: usize = 2 * TILE * LANES;

/// Entries of a tile.
#[inline(always)]
fn tile_length(positions: usize) -> usize {
    positions / LANES * BLOCK
}

/// A symmetric matrix, by its entries xx, xy, yy, times a vector.
#[inline(always)]
fn times<R: Real>([xx, xy, yy]: [R; 3], v: Vector<R>) -> Vector<R> {
    Vector::new(xx * v.x + xy * v.y, xy * v.x + yy * v.y)
}

/// The normal equations H d = −g: H above its diagonal, g in the column after it.
#[derive(Debug, Clone, Default)]
pub(super) struct Normal {
    pub matrix: Vec<f64>,
    /// The length of a row.
    pub width: usize,
    /// The number of rows, and the column of g.
    pub count: usize,
    /// J, and W J with the slopes of the function and of residuals of the whole curve as last columns, in blocks: tile
    /// after tile, in it positions.
    jacobian: Vec<f64>,
    weighted: Vec<f64>,
}

impl Normal {
    /// g by a number.
    pub(super) fn slope(&self, number: usize) -> f64 {
        self.matrix[number * self.width + self.count]
    }

    /// Adds `weight` v vᵀ to H and `slope` v to g.
    pub(super) fn add(&mut self, v: &[f64], weight: f64, slope: f64) {
        for (p, row) in self.matrix.chunks_exact_mut(self.width).take(self.count).enumerate() {
            for (h, &other) in row[p..self.count].iter_mut().zip(&v[p..]) {
                *h += weight * v[p] * other;
            }
            row[self.count] += slope * v[p];
        }
    }
}

/// Sets up the normal equations.
pub(super) fn assemble<L: Entry>(
    function: &mut ByPositions,
    jacobian: &Jacobian,
    normal: &mut Normal,
) {
    for list in &mut function.couplings {
        list[0] = list[function.slopes.count];
    }
    normal.count = jacobian.numbers;
    normal.width = (normal.count + 1 + WHOLE).next_multiple_of(LANES);
    normal.matrix.resize(normal.count.next_multiple_of(TILE) * normal.width, 0.0);
    let tiles = (normal.count + 1 + WHOLE).div_ceil(TILE);
    let length = tiles * tile_length(jacobian.positions);
    normal.jacobian.resize(length, 0.0);
    normal.weighted.resize(length, 0.0);
    L::call(&mut Assemble { function, jacobian, normal });
    for (index, whole) in function.whole.iter().enumerate() {
        if whole.weight > 0.0 {
            let column = normal.count + 1 + index;
            let by_number = |row: &[f64]| row[column];
            let rows = normal.matrix.chunks_exact(normal.width).take(normal.count);
            let v: Vec<f64> = rows.map(by_number).collect();
            normal.add(&v, whole.weight, whole.weight * whole.residual);
        }
    }
}

struct Assemble<'a> {
    function: &'a ByPositions,
    jacobian: &'a Jacobian,
    normal: &'a mut Normal,
}

impl<R: Real> Task<R> for Assemble<'_> {
    #[inline(always)]
    fn run(&mut self) {
        for t in (0..self.jacobian.positions).step_by(R::LANES) {
            self.weigh::<R>(t);
        }
        let tiles = (self.normal.count + 1 + WHOLE).div_ceil(TILE);
        for row in 0..self.normal.count.div_ceil(TILE) {
            for column in row..tiles {
                self.multiply::<R>(row, column);
            }
        }
    }
}

impl Assemble<'_> {
    /// Fills the blocks at the positions from `t` on.
    #[inline(always)]
    fn weigh<R: Real>(&mut self, t: usize) {
        let ByPositions { slopes, own, couplings, whole } = self.function;
        let read = |lists: &[Vec<f64>; 3], t: usize| {
            [R::read(&lists[0][t..]), R::read(&lists[1][t..]), R::read(&lists[2][t..])]
        };
        let (own, before, after) = (read(own, t), read(couplings, t), read(couplings, t + 1));
        let length = tile_length(self.jacobian.positions);
        // Where x of a number lies; its y is as many registers behind as a tile has numbers.
        let place = |number: usize| {
            number / TILE * length + t / LANES * BLOCK + number % TILE * LANES + t % LANES
        };
        let put = |v: Vector<R>, at: usize, blocks: &mut [f64]| {
            let blocks = &mut blocks[at..][..TILE * LANES + R::LANES];
            v.x.put(blocks);
            v.y.put(&mut blocks[TILE * LANES..]);
        };
        let Normal { jacobian: plain, weighted, .. } = &mut *self.normal;
        for number in 0..self.jacobian.numbers {
            let [last, this, next] = self.jacobian.neighbours::<R>(number, t);
            let sum = times(own, this) + times(before, last) + times(after, next);
            put(this, place(number), plain);
            put(sum, place(number), weighted);
        }
        let columns = std::iter::once(slopes).chain(whole.iter().map(|whole| &whole.slopes));
        for (index, Slopes { by: [x, y], .. }) in columns.enumerate() {
            let slopes = Vector::new(R::read(&x[t..]), R::read(&y[t..]));
            put(slopes, place(self.jacobian.numbers + index), weighted);
        }
    }

    /// The products of two tiles. Each lane of the longest register has a sum of its own, so that all levels add in
    /// the same order.
    #[inline(always)]
    fn multiply<R: Real>(&mut self, row: usize, column: usize) {
        let length = tile_length(self.jacobian.positions);
        let rows = &self.normal.jacobian[row * length..][..length];
        let columns = &self.normal.weighted[column * length..][..length];
        let mut products = [[[0.0; LANES]; TILE]; TILE];
        for first in (0..LANES).step_by(R::LANES) {
            let mut sums = [[R::ZERO; TILE]; TILE];
            let rows = rows.as_chunks::<BLOCK>().0;
            let columns = columns.as_chunks::<BLOCK>().0;
            for (rows, columns) in rows.iter().zip(columns) {
                for axis in 0..2 {
                    let register = |of: &[f64; BLOCK], number: usize| {
                        R::read(&of[(axis * TILE + number) * LANES + first..])
                    };
                    let others: [R; TILE] = std::array::from_fn(|q| register(columns, q));
                    for (p, sums) in sums.iter_mut().enumerate() {
                        let own = register(rows, p);
                        for (sum, other) in sums.iter_mut().zip(others) {
                            *sum += own * other;
                        }
                    }
                }
            }
            for (products, sums) in products.iter_mut().zip(sums) {
                for (product, sum) in products.iter_mut().zip(sums) {
                    sum.put(&mut product[first..]);
                }
            }
        }
        for (p, products) in products.iter_mut().enumerate() {
            let first = (TILE * row + p) * self.normal.width + TILE * column;
            for (entry, lanes) in self.normal.matrix[first..].iter_mut().zip(products) {
                *entry = sum_lanes(lanes);
            }
        }
    }
}

/// The sum of eight numbers, by halves.
#[inline(always)]
fn sum_lanes(lanes: &mut [f64; LANES]) -> f64 {
    let mut half = LANES / 2;
    while half > 0 {
        for lane in 0..half {
            lanes[lane] += lanes[lane + half];
        }
        half /= 2;
    }
    lanes[0]
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;
    use crate::math::random::Random;
    use crate::population::adjoint::jacobian;
    use crate::population::course::{Angles, Course, sweep};
    use crate::population::random::RandomLinkages;
    use crate::state::kernel::baseline::Baseline;

    const POSITIONS: usize = 24;

    /// The same from dense matrices, residual after residual.
    #[test]
    fn equations_are_those_of_dense_matrices() {
        let random = &mut Random::new(2, 0);
        let (mut angles, mut course) = (Angles::default(), Course::default());
        let linkage = RandomLinkages { joints: [9, 9], most_cosine: 0.97 }
            .make::<Baseline>(random, &mut course);
        angles.set::<Baseline>(2.5, false, (POSITIONS, 8));
        assert!(sweep::<Baseline>(&linkage, &angles, (0, 1.0), &mut course));
        let mut derivatives = Jacobian::default();
        jacobian::<Baseline>(&linkage, &angles, &course, &mut vec![], &mut derivatives);
        let count = derivatives.numbers;
        let j = DMatrix::from_fn(2 * POSITIONS, count, |row, number| {
            let [_, at, _] = derivatives.neighbours::<f64>(number, row / 2);
            if row % 2 == 0 { at.x } else { at.y }
        });
        let mut function = ByPositions::default();
        function.clear(POSITIONS);
        let (mut h, mut g) = (DMatrix::zeros(count, count), DVector::zeros(count));
        let mut add = |row: &DVector<f64>, weight: f64, residual: f64| {
            let by_numbers = j.transpose() * row;
            h += weight * &by_numbers * by_numbers.transpose();
            g += weight * residual * by_numbers;
        };
        for index in 0..40 {
            let (from, part) = (random.index(POSITIONS), random.unit());
            let (weight, residual) = (random.unit(), random.normal());
            let [x, y] = random.direction();
            let mut row = DVector::zeros(2 * POSITIONS);
            for (t, share) in [(from, 1.0 - part), ((from + 1) % POSITIONS, part)] {
                row[2 * t] = share * x;
                row[2 * t + 1] = share * y;
            }
            add(&row, weight, residual);
            let slope = Vector::new(x, y).scale(weight * residual);
            function.add((from, part), slope, [weight * x * x, weight * x * y, weight * y * y]);
            if let Some(whole) = function.whole.get_mut(index) {
                let row = DVector::from_fn(2 * POSITIONS, |_, _| random.normal());
                for t in 0..POSITIONS {
                    whole.slopes.add(t, Vector::new(row[2 * t], row[2 * t + 1]));
                }
                (whole.weight, whole.residual) = (0.3, residual);
                add(&row, 0.3, residual);
            }
        }
        let mut normal = Normal::default();
        assemble::<Baseline>(&mut function, &derivatives, &mut normal);
        for p in 0..count {
            assert!((normal.slope(p) - g[p]).abs() < 1e-12 * g.amax());
            for q in p..count {
                let own = normal.matrix[p * normal.width + q];
                assert!((own - h[(p, q)]).abs() < 1e-12 * h.amax(), "{p} {q}");
            }
        }
    }
}
