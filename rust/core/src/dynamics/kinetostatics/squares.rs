//! The greatest and the mean square of a reaction over the positions of a design, without storing values.

use crate::math::lanes::{LANES, Mask, Real};
use crate::math::vector::Vector;

/// Squares of the positions so far, lane by lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Squares<R: Real> {
    most: R,
    /// Position k belongs to the sum k modulo [`LANES`] for every length of a register, so that the mean has
    /// the same bits on every processor.
    sums: [R; LANES],
    /// Where a position has no value.
    undefined: R::Mask,
    /// Where a value is infinite.
    infinite: R::Mask,
}

impl<R: Real> Squares<R> {
    pub(super) const NONE: Self = Self {
        most: R::ZERO,
        sums: [R::ZERO; LANES],
        undefined: R::Mask::NONE,
        infinite: R::Mask::NONE,
    };

    /// Adds the values of the `register`-th positions, on the lanes that are `used`.
    #[inline(always)]
    pub(super) fn add(&mut self, value: Vector<R>, register: usize, used: R::Mask) {
        let square = value.norm2();
        let is_finite = value.x.finite().and(value.y.finite());
        let infinity = R::splat(f64::INFINITY);
        let is_infinite = infinity.le(value.x.abs()).or(infinity.le(value.y.abs()));
        self.undefined = self.undefined.or(used.and(is_finite.not()));
        self.infinite = self.infinite.or(used.and(is_infinite));
        let square = R::select(used, square, R::ZERO);
        self.most = self.most.max(square);
        self.sums[register % (LANES / R::LANES)] += square;
    }

    /// Marks positions without a value.
    #[inline(always)]
    pub(super) fn drop(&mut self, undefined: R::Mask) {
        self.undefined = self.undefined.or(undefined);
    }

    #[inline(always)]
    pub(super) fn is_infinite(&self) -> bool {
        self.infinite.any()
    }

    /// The greatest square and the mean of `count` positions; NaN if one has no value.
    #[inline(always)]
    pub(super) fn greatest_and_mean(&self, count: usize) -> [f64; 2] {
        if self.undefined.any() {
            return [f64::NAN; 2];
        }
        let (mut most, mut sum) = (0.0_f64, 0.0);
        for lane in 0..R::LANES {
            most = most.max(self.most.lane(lane));
        }
        for register in &self.sums[..LANES / R::LANES] {
            for lane in 0..R::LANES {
                sum += register.lane(lane);
            }
        }
        [most, sum / count as f64]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::pair::Pair;

    /// The greatest and the mean square of some values, `R` at a time.
    fn squares_of<R: Real>(values: &[[f64; 2]]) -> [f64; 2] {
        let mut squares = Squares::<R>::NONE;
        for (register, block) in values.chunks(R::LANES).enumerate() {
            let entry = |axis: usize| R::from_lanes(|lane| block[lane.min(block.len() - 1)][axis]);
            let used = R::from_lanes(|lane| lane as f64).lt(R::splat(block.len() as f64));
            squares.add(Vector::new(entry(0), entry(1)), register, used);
        }
        squares.greatest_and_mean(values.len())
    }

    #[test]
    fn registers_of_any_length_give_the_same_bits() {
        let values: Vec<[f64; 2]> =
            (0..29).map(|k| [f64::from(k * k % 17).sin(), 1.0 / f64::from(k + 1)]).collect();
        let alone = squares_of::<f64>(&values);
        assert_eq!(squares_of::<Pair<f64>>(&values).map(f64::to_bits), alone.map(f64::to_bits));
        assert_eq!(
            squares_of::<Pair<Pair<f64>>>(&values).map(f64::to_bits),
            alone.map(f64::to_bits)
        );
        let squares: Vec<f64> = values.iter().map(|[x, y]| x * x + y * y).collect();
        let most = squares.iter().copied().fold(0.0, f64::max);
        let mean = squares.iter().sum::<f64>() / 29.0;
        assert!(alone[0] == most && (alone[1] - mean).abs() < 1e-15);
    }

    #[test]
    fn one_missing_value_leaves_none() {
        assert!(squares_of::<Pair<f64>>(&[[1.0, 2.0], [f64::NAN, 0.0], [3.0, 0.0]])[0].is_nan());
        assert!(squares_of::<Pair<f64>>(&[[1.0, 2.0], [3.0, f64::NAN], [3.0, 0.0]])[1].is_nan());
        // A great force has a value, even if its square overflows.
        assert_eq!(squares_of::<Pair<f64>>(&[[1.0e200, 0.0], [1.0, 1.0]])[0], f64::INFINITY);
    }
}
