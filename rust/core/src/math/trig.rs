//! Sine, cosine, arc tangent and arc sine.
//!
//! They use only the operations of [`Real`], so a number gives the same bits alone and in lanes, on
//! every machine; the system's library promises neither. Errors are in ulp, the unit in the last
//! place of the exact value rounded to a double. The bounds have a small margin above the worst
//! error found in some 10^8 samples, most of them near the worst arguments;
//! `tests/python/package/test_trig.py` checks them against 50 digits.
//!
//! The polynomials are minimax in the relative error of the function (Remez exchange at 60 digits,
//! with mpmath). The coefficients were rounded to doubles one by one from the lowest, and the
//! higher ones refitted after each.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, PI};

use super::lanes::{LANES, Mask, Real};
use super::two_over_pi::FRAC_2_PI_BITS;

/// (sin r − r) / r³ in r², |r| ≤ π/4; relative error of sin r 2^-57.9.
const SIN: [f64; 6] = [
    -0.1666666666666663,
    0.00833333333332184,
    -0.0001984126982935895,
    2.755731353881218e-06,
    -2.5050734455467174e-08,
    1.5895438005449688e-10,
];

/// (cos r − 1 + r²/2) / r⁴ in r², |r| ≤ π/4; relative error of cos r 2^-63.9.
const COS: [f64; 6] = [
    0.041666666666666595,
    -0.0013888888888873342,
    2.4801587289002056e-05,
    -2.75573142170319e-07,
    2.087570539598387e-09,
    -1.1358749309738377e-11,
];

/// (atan t − t) / t³ in t², |t| ≤ 1; relative error of atan t 2^-57.5.
const ATAN: [f64; 20] = [
    -0.3333333333333307,
    0.19999999999951754,
    -0.14285714282588358,
    0.11111111007349522,
    -0.09090907007917615,
    0.07692279890134214,
    -0.0666640443210954,
    0.058805298546664095,
    -0.05253526971087977,
    0.04722348970777943,
    -0.042192451286361406,
    0.03664319141544307,
    -0.029905797693023355,
    0.021987140231768273,
    -0.013902636356150676,
    0.0071979253632990375,
    -0.002885628899094812,
    0.0008315659773338085,
    -0.00015221243680522403,
    1.3230122606774063e-05,
];

/// (asin t − t) / t³ in t², |t| ≤ 1/2; relative error of asin t 2^-55.8.
const ASIN: [f64; 12] = [
    0.16666666666665408,
    0.07500000000337156,
    0.044642856828199955,
    0.030381959142605667,
    0.02237175790853889,
    0.01735970698729908,
    0.013885212777740973,
    0.012169364933771833,
    0.006527294338695707,
    0.019530177279440515,
    -0.01622732974067008,
    0.03191443179629825,
];

/// The same for |t| ≤ sin 22.5°; relative error of asin t 2^-57.3.
const SMALL_ASIN: [f64; 10] = [
    0.16666666666666097,
    0.07500000000187196,
    0.04464285693022868,
    0.03038195637924728,
    0.02237177534166961,
    0.01736036075361515,
    0.013869434343324225,
    0.012309447405823617,
    0.006128563008563035,
    0.017589146039703008,
];

/// π/2 in parts of 31, 32, 28 and 53 bits: products of the first three with integers up to 2^21
/// are exact.
const FRAC_PI_2_PARTS: [f64; 4] =
    [1.5707963267341256, 6.077100506303966e-11, 2.0222662487111665e-21, 8.4784276603689e-32];

/// 2^21 π/2, rounded down: up to here the number of quarter turns is at most 2^21.
const MAX_FAST_ANGLE: f64 = 3294198.0;

/// Added to a number below 2^51, it leaves that number, rounded to an integer, in the last bits.
const ROUNDER: f64 = 1.5 * (1_u64 << 52) as f64;

/// π minus its nearest double.
const PI_REST: f64 = 1.2246467991473532e-16;

/// π/2 · 2^63, rounded.
const FRAC_PI_2_BITS: u128 = 0xc90fdaa22168c235;

/// Evaluates a polynomial with an even number of coefficients, lowest first. Terms are grouped in
/// fours (the highest group may be a pair) and the groups summed by Horner's rule in z⁴: a quarter
/// of the latency for a few more multiplications.
#[inline(always)]
fn polynomial<R: Real, const N: usize>(z: R, coefficients: [f64; N]) -> R {
    let z2 = z * z;
    let z4 = z2 * z2;
    let mut i = N - 2;
    let mut sum = pair(&coefficients, i, z);
    if N.is_multiple_of(4) {
        i -= 2;
        sum = pair(&coefficients, i, z) + sum * z2;
    }
    while i > 0 {
        i -= 4;
        sum = (pair(&coefficients, i, z) + pair(&coefficients, i + 2, z) * z2) + sum * z4;
    }
    sum
}

/// A coefficient, and the next one times z. A function: closures are not always inlined into the
/// code of a level.
#[inline(always)]
fn pair<R: Real>(coefficients: &[f64], i: usize, z: R) -> R {
    R::splat(coefficients[i]) + R::splat(coefficients[i + 1]) * z
}

/// Sine and cosine of an angle in radians, any double; NaN for infinities and NaN.
///
/// Error below 0.9 ulp (0.84 found). The sine of −0 is −0.
///
/// Up to 3.29e6, quarter turns are subtracted with π/2 in four parts, whose products are exact
/// (Cody and Waite, *Software Manual for the Elementary Functions*, 1980), and the remainder is a
/// sum of two doubles. No double is nearer to a multiple of π/2 than 2^-61, so the loss there,
/// below 2^-134, does not matter. Larger angles are reduced one by one in integer arithmetic (Payne
/// and Hanek, "Radian reduction for trigonometric functions", *ACM SIGNUM Newsletter* 18(1), 1983),
/// about eight times slower, without changing a bit of the other lanes.
#[inline(always)]
pub fn sin_cos<R: Real>(x: R) -> (R, R) {
    let rounder = R::splat(ROUNDER);
    let [p, q, s, t] = FRAC_PI_2_PARTS;
    let parts = [R::splat(p), R::splat(q), R::splat(s), R::splat(t)];
    // The last two bits are the quadrant.
    let mut shifted = x * R::splat(FRAC_2_PI) + rounder;
    let k = shifted - rounder;
    // Exact: below 1, and a multiple of 2^-53 as both operands are.
    let first = x - k * parts[0];
    // These differences are exact where cancellation leaves the minuend the smaller operand;
    // elsewhere Dekker's difference gives their rounding error exactly.
    let product = k * parts[1];
    let second = first - product;
    let second_error = (first - second) - product;
    let product = k * parts[2];
    let mut r = second - product;
    let mut lo = (((second - r) - product) + second_error) - k * parts[3];
    let near = x.abs().le(R::splat(MAX_FAST_ANGLE));
    if !near.all() {
        [shifted, r, lo] = reduce_far(x, near, [shifted, r, lo]);
    }

    let z = r * r;
    let half = z * R::splat(0.5);
    let top = R::ONE - half; // close enough to cos r to multiply `lo`
    let cos_low = ((R::ONE - top) - half) - r * lo;
    let cos = top + (cos_low + (z * z) * polynomial(z, COS));
    // −sin r: a sum of r and its correction would give +0 for −0.
    let minus_sin = -r - ((r * z) * polynomial(z, SIN) + lo * top);

    let odd = shifted.bit(0);
    let negative = shifted.bit(1);
    let sin_x = R::select(odd, cos, -minus_sin);
    let cos_x = R::select(odd, minus_sin, cos);
    (R::select(negative, -sin_x, sin_x), R::select(negative, -cos_x, cos_x))
}

/// Reduces the lanes that are not `near` by [`reduce_exactly`] and keeps the others.
#[cold]
#[inline(never)]
fn reduce_far<R: Real>(x: R, near: R::Mask, reduced: [R; 3]) -> [R; 3] {
    let mut lanes = [[0.0; 3]; LANES];
    for lane in 0..R::LANES {
        lanes[lane] = if near.lane(lane) {
            reduced.map(|part| part.lane(lane))
        } else {
            reduce_exactly(x.lane(lane))
        };
    }
    [0, 1, 2].map(|part| R::from_lanes(|lane| lanes[lane][part]))
}

/// Reduces an angle above 2^20: a number whose last two bits are the quadrant, and the remainder as
/// a sum of two doubles.
///
/// Only the bits of x · 2/π that matter are computed (Payne and Hanek 1983): bits of 2/π that give
/// multiples of four are skipped, and the next 192 give two bits of the quadrant and 126 correct
/// bits after the point, of which at most 62 cancel.
fn reduce_exactly(x: f64) -> [f64; 3] {
    if !x.is_finite() {
        return [f64::NAN; 3];
    }
    let bits = x.to_bits();
    let significand = u128::from(bits & ((1 << 52) - 1) | 1 << 52);
    // |x| = significand · 2^e. Bit b of 2/π has weight 2^-b; the first one needed is e − 1, at
    // index e − 2 after the 64 zeros.
    let exponent = (bits >> 52 & 0x7ff) as usize;
    let from = exponent + 64 - 1075 - 2;
    let word = |i: usize| {
        let [high, low] = [0, 1].map(|j| u128::from(FRAC_2_PI_BITS[from / 64 + i + j]));
        (high << 64 | low) << (from % 64) >> 64
    };
    let low = significand * word(2);
    let middle = significand * word(1) + (low >> 64);
    let high = significand * word(0) + (middle >> 64);
    let product = high << 64 | middle & u128::from(u64::MAX);

    // The quadrant is the nearest multiple, so the fraction is signed.
    let fraction = (product << 2).cast_signed();
    let quadrant = (product >> 126) as u64 + u64::from(fraction < 0);
    let zeros = fraction.unsigned_abs().leading_zeros();
    let size = fraction.unsigned_abs() << zeros >> 64;
    let angle = size * FRAC_PI_2_BITS;
    let unit = f64::from_bits(u64::from(1023 - 127 - zeros) << 52);
    let head = angle >> 75 << 75;
    let (head, tail) = (head as f64 * unit, (angle - head) as f64 * unit);
    let r = head + tail;
    let lo = tail - (r - head);
    let sign = if (fraction < 0) == (x < 0.0) { 1.0 } else { -1.0 };
    [f64::from_bits(if x < 0.0 { 4 - quadrant } else { quadrant }), sign * r, sign * lo]
}

/// Angle of the point (x, y) in [−π, π], any doubles; signed zeros and infinities as in C and
/// IEEE 754.
///
/// Error below 1.7 ulp (1.63 found), subnormal coordinates and angles included. The worst angles
/// are just below powers of two, where the angle's ulp is half that of the quotient.
///
/// The quotient of the smaller by the larger coordinate takes one division and cannot overflow. Its
/// polynomial is added to 0, π/2 or π, kept as a sum of two doubles.
#[inline(always)]
pub fn atan2<R: Real>(y: R, x: R) -> R {
    let (size_x, size_y) = (x.abs(), y.abs());
    let steep = size_x.lt(size_y);
    let quotient = R::select(steep, -x, size_y) / R::select(steep, size_y, x);
    // For both zero or both infinite; the same value for other equal coordinates.
    let equal = size_y.le(size_x).and(size_x.le(size_y));
    let equal_quotient = R::select(R::ZERO.lt(size_x), R::ONE, R::ZERO).copysign(x);
    let t = R::select(equal, equal_quotient, quotient);
    let z = t * t;
    let correction = (t * z) * polynomial(z, ATAN);
    let half_turns = R::select(steep, R::splat(0.5), R::select(x.bit(63), R::ONE, R::ZERO));
    add(half_turns * R::splat(PI), half_turns * R::splat(PI_REST), t, correction).copysign(y)
}

/// Angle in [−π, π] of a vector of length 1.
///
/// Error below 3.2 ulp for an exact unit vector; a length of 1 + ε adds at most 0.42 ε. No division:
/// the angle from the nearest multiple of 45° is an arc sine, and its sine a coordinate, or their
/// difference over √2. NaN if both coordinates are.
#[inline(always)]
pub fn unit_angle<R: Real>(x: R, y: R) -> R {
    const SIN_22_5: f64 = 0.3826834323650898;
    const THREE_QUARTERS_PI: f64 = 0.75 * PI;
    let (a, b) = (x.abs(), y.abs());
    let (along_x, along_y) = (b.le(R::splat(SIN_22_5)), a.le(R::splat(SIN_22_5)));
    let between = (b - a) * R::splat(FRAC_1_SQRT_2);
    let sine = R::select(along_x, b, R::select(along_y, a, between));
    let square = sine * sine;
    let arc = sine + (sine * square) * polynomial(square, SMALL_ASIN);
    let left = x.lt(R::ZERO);
    // Quadrant by quadrant: arc, π/4 + arc, π/2 − arc; π/2 + arc, 3π/4 − arc, π − arc.
    let base = R::select(
        along_x,
        R::select(left, R::splat(PI), R::ZERO),
        R::select(
            along_y,
            R::splat(FRAC_PI_2),
            R::select(left, R::splat(THREE_QUARTERS_PI), R::splat(FRAC_PI_4)),
        ),
    );
    let arc = R::select(along_y, -arc, arc);
    (base + R::select(left, -arc, arc)).copysign(y)
}

/// Arc sine; NaN outside [−1, 1].
///
/// Error below 1.3 ulp (1.26 found). The arc sine of −0 is −0.
///
/// Above 1/2 it uses asin x = π/2 − 2 asin √((1 − x)/2) (Cody and Waite, 1980); 1 − x is exact.
#[inline(always)]
pub fn asin<R: Real>(x: R) -> R {
    let size = x.abs();
    let large = R::splat(0.5).lt(size);
    let half = (R::ONE - size) * R::splat(0.5);
    let z = R::select(large, half, size * size);
    let t = R::select(large, R::splat(-2.0) * half.sqrt(), size);
    let correction = (t * z) * polynomial(z, ASIN);
    let quarter_turn = R::select(large, R::splat(FRAC_PI_2), R::ZERO);
    let rest = R::select(large, R::splat(0.5 * PI_REST), R::ZERO);
    add(quarter_turn, rest, t, correction).copysign(x)
}

/// `high` + `low` + `t` + `correction`, where `high` is zero or greater than |`t`|, so that
/// Dekker's sum gives the rounding error of the first addition exactly.
#[inline(always)]
fn add<R: Real>(high: R, low: R, t: R, correction: R) -> R {
    let sum = high + t;
    let error = t - (sum - high);
    sum + (error + (low + correction))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::pair::Lanes;
    use std::f64::consts::FRAC_PI_4;

    const TINY: f64 = 5e-324;
    const INFINITY: f64 = f64::INFINITY;

    /// Equal bits, or both NaN.
    fn same(a: f64, b: f64) -> bool {
        a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
    }

    /// Doubles of all exponents and both signs, some of moderate size.
    fn numbers(count: usize) -> Vec<f64> {
        let mut state = 0x9e3779b97f4a7c15_u64;
        let mut next = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            f64::from_bits(state)
        };
        (0..count)
            .map(|i| match i % 4 {
                0 => next(),
                1 => next() % 1.0,
                2 => next() % 10.0,
                _ => next() % 1e8,
            })
            .collect()
    }

    #[track_caller]
    fn assert_sin_cos(x: f64, sin: f64, cos: f64) {
        let got = sin_cos(x);
        assert!(same(got.0, sin) && same(got.1, cos), "{x}: {got:?}");
    }

    #[test]
    fn sine_and_cosine_of_special_numbers() {
        assert_sin_cos(0.0, 0.0, 1.0);
        assert_sin_cos(-0.0, -0.0, 1.0);
        assert_sin_cos(TINY, TINY, 1.0);
        assert_sin_cos(-TINY, -TINY, 1.0);
        assert_sin_cos(FRAC_PI_2, 1.0, 0.5 * PI_REST);
        assert_sin_cos(PI, PI_REST, -1.0);
        for x in [INFINITY, -INFINITY, f64::NAN] {
            assert_sin_cos(x, f64::NAN, f64::NAN);
        }
        // The double nearest to a multiple of π/2, relative to its size (mpmath).
        assert_sin_cos(6381956970095103.0 * 2.0_f64.powi(797), 1.0, -4.687165924254628e-19);
    }

    #[test]
    fn both_reductions_agree_where_they_meet() {
        for x in (0..4000).map(|i| 1048577.0 + 561.3 * f64::from(i)) {
            let [shifted, r, lo] = reduce_exactly(x);
            let (sin, cos) = (r + lo).sin_cos();
            let (sin, cos) = if shifted.bit(0) { (cos, -sin) } else { (sin, cos) };
            let sign = if shifted.bit(1) { -1.0 } else { 1.0 };
            let got = sin_cos(x);
            assert!((got.0 - sign * sin).abs() < 4e-16 && (got.1 - sign * cos).abs() < 4e-16);
        }
    }

    #[test]
    fn arc_tangent_of_special_numbers() {
        let expected = [
            (0.0, 0.0, 0.0),
            (0.0, -0.0, PI),
            (0.0, 1.0, 0.0),
            (0.0, -1.0, PI),
            (0.0, TINY, 0.0),
            (0.0, -TINY, PI),
            (0.0, INFINITY, 0.0),
            (0.0, -INFINITY, PI),
            (TINY, 0.0, FRAC_PI_2),
            (TINY, -0.0, FRAC_PI_2),
            (1.0, -0.0, FRAC_PI_2),
            (1.0, INFINITY, 0.0),
            (1.0, -INFINITY, PI),
            (INFINITY, 1.0, FRAC_PI_2),
            (INFINITY, -0.0, FRAC_PI_2),
            (INFINITY, INFINITY, FRAC_PI_4),
            (INFINITY, -INFINITY, 3.0 * FRAC_PI_4),
            (TINY, TINY, FRAC_PI_4),
            (TINY, -TINY, 3.0 * FRAC_PI_4),
            (f64::MAX, f64::MAX, FRAC_PI_4),
            (f64::MAX, TINY, FRAC_PI_2),
            (TINY, f64::MAX, 0.0),
            (TINY, -f64::MAX, PI),
            (TINY, 1.0, TINY),
            (3.0 * TINY, 0.5, 6.0 * TINY),
        ];
        for (y, x, angle) in expected {
            assert!(same(atan2(y, x), angle), "{y} {x}: {}", atan2(y, x));
            assert!(same(atan2(-y, x), -angle), "{} {x}: {}", -y, atan2(-y, x));
        }
        for x in [0.0, 1.0, -INFINITY, f64::NAN] {
            assert!(atan2(x, f64::NAN).is_nan() && atan2(f64::NAN, x).is_nan());
        }
    }

    #[test]
    fn arc_sine_of_special_numbers() {
        for (x, angle) in [(0.0, 0.0), (TINY, TINY), (1.0, FRAC_PI_2)] {
            assert!(same(asin(x), angle) && same(asin(-x), -angle), "{x}: {}", asin(x));
        }
        for x in [1.0 + f64::EPSILON, -1.5, INFINITY, -INFINITY, f64::NAN] {
            assert!(asin(x).is_nan(), "{x}");
        }
    }

    /// Small, large and infinite numbers share a vector here.
    #[test]
    fn lanes_equal_scalars_bit_for_bit() {
        let mut all = numbers(8000);
        all.splice(
            8..8,
            [0.0, -0.0, INFINITY, -INFINITY, f64::NAN, f64::MAX, TINY, MAX_FAST_ANGLE],
        );
        let reversed: Vec<f64> = all.iter().rev().copied().collect();
        for (x, y) in all.chunks_exact(LANES).zip(reversed.chunks_exact(LANES)) {
            let xs: Lanes = Lanes::from_lanes(|i| x[i]);
            let ys: Lanes = Lanes::from_lanes(|i| y[i]);
            let (sin, cos) = sin_cos(xs);
            let (angle, arc) = (atan2(ys, xs), asin(xs));
            for i in 0..LANES {
                let (sin_alone, cos_alone) = sin_cos(x[i]);
                assert!(same(sin.lane(i), sin_alone) && same(cos.lane(i), cos_alone), "{}", x[i]);
                assert!(same(angle.lane(i), atan2(y[i], x[i])), "{} {}", y[i], x[i]);
                assert!(same(arc.lane(i), asin(x[i])), "{}", x[i]);
            }
        }
    }
}
