//! The lengths that set the scale of a design.

use crate::description::Linkage;
use crate::description::dimension::{Dimension, Dimensions};
use crate::structure::closure::Closure;

/// Index of a value; `None` if the linkage has no such dimension, whose value is then 0.
pub(crate) type Slot = Option<usize>;

/// The dimensions that set the size of a design, each with the axis of the origin to subtract.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Lengths {
    /// Dimensions of points at pairs.
    paired: Vec<(usize, Option<usize>)>,
    /// Dimensions of other points: they set the size only if all others are 0.
    loose: Vec<(usize, Option<usize>)>,
}

impl Lengths {
    pub(crate) fn of(linkage: &Linkage, closure: &Closure, dimensions: &Dimensions) -> Self {
        let at_pair = |joint: usize| closure.is_pair(linkage, joint);
        let ground = |slide: usize| linkage.slides[slide].on == linkage.ground;
        let mut lengths = Self::default();
        for (index, (_, dimension)) in dimensions.iter().enumerate() {
            let (paired, axis) = match dimension {
                Dimension::GroundX { joint } => (at_pair(joint), Some(0)),
                Dimension::GroundY { joint } => (at_pair(joint), Some(1)),
                Dimension::SlideOriginX { slide } if ground(slide) => (true, Some(0)),
                Dimension::SlideOriginY { slide } if ground(slide) => (true, Some(1)),
                Dimension::JointX { joint, .. } | Dimension::JointY { joint, .. } => {
                    (at_pair(joint), None)
                }
                Dimension::Length { link } => (at_pair(linkage.links[link].joints[1]), None),
                dimension if dimension.is_length() => (true, None),
                _ => continue,
            };
            if paired { &mut lengths.paired } else { &mut lengths.loose }.push((index, axis));
        }
        lengths
    }

    /// The greatest length.
    pub(crate) fn size(&self, values: &[f64], origin: [f64; 2]) -> f64 {
        let greatest = |lengths: &[(usize, Option<usize>)]| {
            let taken_off = |from: Option<usize>| from.map_or(0.0, |axis| origin[axis]);
            let lengths = lengths.iter().map(|&(index, from)| values[index] - taken_off(from));
            lengths.fold(0.0, |greatest, length| greater(greatest, length.abs()))
        };
        let paired = greatest(&self.paired);
        if paired > 0.0 { paired } else { greatest(&self.loose) }
    }

    /// The greatest length at pairs of each of several designs, given the column of each dimension.
    pub(crate) fn greatest<'a>(
        &self,
        column: impl Fn(usize) -> &'a [f64],
        origin: [Slot; 2],
        greatest: &mut [f64],
    ) {
        greatest.fill(0.0);
        for &(index, from) in &self.paired {
            let lengths = column(index).iter();
            match from.and_then(|axis| origin[axis]) {
                None => {
                    for (greatest, length) in greatest.iter_mut().zip(lengths) {
                        *greatest = greater(*greatest, length.abs());
                    }
                }
                Some(zero) => {
                    for ((greatest, length), zero) in
                        greatest.iter_mut().zip(lengths).zip(column(zero))
                    {
                        *greatest = greater(*greatest, (length - zero).abs());
                    }
                }
            }
        }
    }
}

/// A single instruction, unlike `f64::max`, which handles NaN on either side.
fn greater(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}

/// The power of two at or below a positive number; 1 for 0, NaN, infinity and negative numbers.
/// Kept within 2^-508 to 2^508, about the range of lengths, so that third analogues by a slide can
/// be divided by its square.
pub(super) fn power_of_two(x: f64) -> f64 {
    if !(x.is_finite() && x > 0.0) {
        return 1.0;
    }
    let exponent = (x.to_bits() >> 52).clamp(515, 1531);
    f64::from_bits(exponent << 52)
}

/// Inverse of a power of two, exact in the range of [`power_of_two`].
pub(super) fn inverse_power(power: f64) -> f64 {
    f64::from_bits((2046 << 52) - power.to_bits())
}

#[cfg(test)]
mod tests {
    use super::{inverse_power, power_of_two};

    #[test]
    fn inverses_are_exact() {
        for x in [1.0, 3.7, 1e-200, 1e200, 0.3] {
            assert_eq!(inverse_power(power_of_two(x)), 1.0 / power_of_two(x));
        }
    }

    #[test]
    fn powers_of_two() {
        for (x, p) in
            [(1.0, 1.0), (1.99, 1.0), (0.3, 0.25), (4.8, 4.0), (0.0, 1.0), (f64::NAN, 1.0)]
        {
            assert!(power_of_two(x) == p, "{x}");
        }
        assert!(power_of_two(1e-150) <= 1e-150 && power_of_two(1e150) <= 1e150);
        assert!(power_of_two(f64::MIN_POSITIVE) > 0.0);
    }
}
