//! Hermite interpolation of a group's unknown between two knots.

use super::knot::Taylor2;
use crate::math::lanes::{Mask, Real};
use crate::math::vector::Vector;
use crate::plan::dyad::Unknown;

/// A polynomial of the fifth degree in the distance from a knot.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HermiteCell {
    /// Coefficients, the constant first.
    pub coefficients: [f64; 6],
    /// Unit vector at the knot's angle.
    pub unit: Vector,
}

impl HermiteCell {
    /// The Hermite polynomial through values and two derivatives at both ends of a cell of width
    /// `h`; Taylor's of the second degree without a second end.
    #[inline(always)]
    pub(crate) fn new(a: &Taylor2, b: Option<&Taylor2>, h: f64, unit: Vector) -> Self {
        let coefficients = match b {
            Some(&b) => coefficients(*a, b, h),
            None => [a[0], a[1], 0.5 * a[2], 0.0, 0.0, 0.0],
        };
        Self { coefficients, unit }
    }

    /// The cell of an unknown between two knots of a trace.
    pub(crate) fn between(unknown: Unknown, a: &Taylor2, b: Option<&Taylor2>, h: f64) -> Self {
        let unit = match unknown {
            Unknown::Class(_) => Vector::at_angle(a[0]),
            Unknown::Slide(_) => Vector::ONE,
        };
        Self::new(a, b, h, unit)
    }

    /// The unknown at a distance from the knot.
    pub(crate) fn value(&self, step: f64) -> f64 {
        self.coefficients.iter().rev().fold(0.0, |sum, c| sum * step + c)
    }
}

/// Coefficients of the Hermite polynomial through values and two derivatives at both ends of a cell of
/// width `h`; those of the first end's Taylor polynomial where one of them is not finite.
#[inline(always)]
pub(crate) fn coefficients<R: Real>(a: [R; 3], b: [R; 3], h: f64) -> [R; 6] {
    let ([value, rate, second], [end, end_rate, end_second]) = (a, b);
    let (half, inv_h) = (R::splat(0.5), 1.0 / h);
    let inv_h3 = inv_h * inv_h * inv_h;
    let d0 = end - (value + R::splat(h) * (rate + R::splat(0.5 * h) * second));
    let d1 = R::splat(h) * (end_rate - rate - R::splat(h) * second);
    let d2 = R::splat(h * h) * (end_second - second);
    let differences = [d0, d1, d2];
    let all = [
        value,
        rate,
        half * second,
        combine(differences, [10.0, -4.0, 0.5], inv_h3),
        combine(differences, [-15.0, 7.0, -1.0], inv_h3 * inv_h),
        combine(differences, [6.0, -3.0, 0.5], inv_h3 * inv_h * inv_h),
    ];
    let mut finite = R::Mask::NONE.not();
    for c in all {
        finite = finite.and(c.finite());
    }
    let [c0, c1, c2, rest @ ..] = all;
    let [mut c3, mut c4, mut c5] = rest;
    for c in [&mut c3, &mut c4, &mut c5] {
        *c = R::select(finite, *c, R::ZERO);
    }
    [c0, c1, c2, c3, c4, c5]
}

/// A weighted sum of differences times a factor. (A closure would not be compiled with the vector
/// instructions of its level.)
#[inline(always)]
fn combine<R: Real>([d0, d1, d2]: [R; 3], [x, y, z]: [f64; 3], factor: f64) -> R {
    (R::splat(x) * d0 + R::splat(y) * d1 + R::splat(z) * d2) * R::splat(factor)
}

/// A unit vector at an angle of less than a quarter turn. Its direction is good to 1e-9 at π/4
/// (Taylor polynomials), its length to the last bit (one Newton step for 1/√). The iteration
/// corrects a direction to second order, but a wrong length only to first.
#[inline(always)]
pub(crate) fn small_rotation<R: Real>(angle: R) -> Vector<R> {
    let x2 = angle * angle;
    let (mut cosine, mut sine) = (R::splat(COSINE[0]), R::splat(SINE[0]));
    for (c, s) in COSINE[1..].iter().zip(&SINE[1..]) {
        cosine = cosine * x2 + R::splat(*c);
        sine = sine * x2 + R::splat(*s);
    }
    let turn = Vector::new(cosine, sine * angle);
    turn.scale(R::splat(1.5) - R::splat(0.5) * turn.norm2())
}

/// ∓1/10!, … −1/2!, 1.
const COSINE: [f64; 6] = [-1.0 / 3_628_800.0, 1.0 / 40_320.0, -1.0 / 720.0, 1.0 / 24.0, -0.5, 1.0];
/// ∓1/11!, … −1/3!, 1.
const SINE: [f64; 6] =
    [-1.0 / 39_916_800.0, 1.0 / 362_880.0, -1.0 / 5040.0, 1.0 / 120.0, -1.0 / 6.0, 1.0];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cell_interpolates_both_ends() {
        // sin and its derivatives at 0.3 and 0.5.
        let sine = |x: f64| [x.sin(), x.cos(), -x.sin()];
        let cell = HermiteCell::new(&sine(0.3), Some(&sine(0.5)), 0.2, Vector::ONE);
        for part in [0.0, 0.05, 0.1, 0.2] {
            assert!((cell.value(part) - (0.3_f64 + part).sin()).abs() < 2e-9, "{part}");
        }
        assert!((cell.value(0.2) - 0.5_f64.sin()).abs() < 1e-15);
    }

    #[test]
    fn small_rotations_are_cosine_and_sine() {
        for angle in [0.0_f64, 1e-3, -0.4, 0.785] {
            let turn = small_rotation(angle);
            assert!((turn.x - angle.cos()).abs() < 2e-10 && (turn.y - angle.sin()).abs() < 2e-10);
            assert!((turn.norm() - 1.0).abs() < 4e-16, "{angle}");
        }
    }
}
