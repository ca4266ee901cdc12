//! Double-double arithmetic: a number is the unevaluated sum of two f64, good
//! to about 106 bits.
//!
//! Sources: Dekker, *Numer. Math.* 18 (1971), 224; Knuth, *The Art of Computer
//! Programming* 2, 4.2.2; Hida, Li & Bailey, *Algorithms for quad-double
//! precision floating point arithmetic*, ARITH-15 (2001).

use std::f64::consts::{FRAC_PI_2, LN_10};
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// The unevaluated sum `hi + lo`, |lo| ≤ half a unit in the last place of hi.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Dd {
    pub hi: f64,
    pub lo: f64,
}

/// Exact sum: s + e = a + b, s rounded (Knuth, theorem 4.2.2 B: six operations).
fn two_sum(a: f64, b: f64) -> Dd {
    let s = a + b;
    let back = s - a;
    Dd { hi: s, lo: (a - (s - back)) + (b - back) }
}

/// The same for |a| ≥ |b| (Dekker 1971, (4.7): three operations).
fn quick_two_sum(a: f64, b: f64) -> Dd {
    let s = a + b;
    Dd { hi: s, lo: b - (s - a) }
}

/// Upper 26 bits of a number and the rest (Dekker 1971, (5.6), after Veltkamp).
fn split(a: f64) -> (f64, f64) {
    let t = 134_217_729.0 * a; // 2^27 + 1
    let high = t - (t - a);
    (high, a - high)
}

/// Exact product: p + e = a b, p rounded (Dekker 1971, (5.12)).
fn two_prod(a: f64, b: f64) -> Dd {
    let p = a * b;
    let ((ah, al), (bh, bl)) = (split(a), split(b));
    Dd { hi: p, lo: ((ah * bh - p) + ah * bl + al * bh) + al * bl }
}

impl Dd {
    pub const ZERO: Self = Self { hi: 0.0, lo: 0.0 };
    pub const ONE: Self = Self { hi: 1.0, lo: 0.0 };
    /// π/2 and its remainder after 53 bits (its first 106 bits).
    const HALF_PI: Self = Self { hi: FRAC_PI_2, lo: 6.123233995736766e-17 };

    /// Square root by one Newton step on 1/√a (Hida, Li & Bailey 2001, 3.5, after
    /// Karp & Markstein 1997).
    pub fn sqrt(self) -> Self {
        if self.hi <= 0.0 {
            return Self::ZERO;
        }
        let inverse = 1.0 / self.hi.sqrt();
        let root = self.hi * inverse;
        let rest = self - two_prod(root, root);
        two_sum(root, rest.hi * inverse * 0.5)
    }

    /// Sine and cosine: the multiple of π/2 taken off, then the Taylor series of
    /// both (Hida, Li & Bailey 2001, 3.6, without their table).
    pub fn sin_cos(self) -> (Self, Self) {
        let quarter = (self.hi / FRAC_PI_2).round();
        let r = self - Self::HALF_PI * Self::from(quarter);
        let r2 = r * r;
        // (π/4)^30/30! = 3e-36
        let (mut sin, mut cos) = (Self::ZERO, Self::ZERO);
        for k in (1..=15).rev() {
            let (even, odd) = (f64::from(2 * k * (2 * k - 1)), f64::from(2 * k * (2 * k + 1)));
            // Horner on 1 − r²/(n (n+1)) (1 − …)
            cos = (Self::ONE - cos) * r2 / Self::from(even);
            sin = (Self::ONE - sin) * r2 / Self::from(odd);
        }
        let (sin, cos) = (r * (Self::ONE - sin), Self::ONE - cos);
        match quarter.rem_euclid(4.0) {
            0.0 => (sin, cos),
            1.0 => (cos, -sin),
            2.0 => (-sin, -cos),
            _ => (-cos, sin),
        }
    }

    /// Angle of (x, y): the f64 angle and one Newton step, sin(θ − a) being the
    /// cross product with the direction of a (Hida, Li & Bailey 2001, 3.6).
    pub fn atan2(y: Self, x: Self) -> Self {
        let guess = Self::from(y.hi.atan2(x.hi));
        let (s, c) = guess.sin_cos();
        let length = (x * x + y * y).sqrt();
        guess + (y * c - x * s) / length
    }

    /// From decimal digits with a point, good to about 1e-31.
    pub fn parse(text: &str) -> Self {
        let (negative, digits) = match text.strip_prefix('-') {
            Some(rest) => (true, rest),
            None => (false, text),
        };
        let (mut value, mut divisor, mut after) = (Self::ZERO, Self::ONE, false);
        for character in digits.chars() {
            let Some(digit) = character.to_digit(10) else {
                after = true;
                continue;
            };
            value = value * Self::from(10.0) + Self::from(f64::from(digit));
            if after {
                divisor = divisor * Self::from(10.0);
            }
        }
        let value = value / divisor;
        if negative { -value } else { value }
    }
}

impl From<f64> for Dd {
    fn from(hi: f64) -> Self {
        Self { hi, lo: 0.0 }
    }
}

impl From<Dd> for f64 {
    fn from(x: Dd) -> Self {
        x.hi + x.lo
    }
}

/// Sum with both corrections (Hida, Li & Bailey 2001, 3.2, the accurate form:
/// relative error 2 u² also where the heads cancel).
impl Add for Dd {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (s, t) = (two_sum(self.hi, other.hi), two_sum(self.lo, other.lo));
        let s = quick_two_sum(s.hi, s.lo + t.hi);
        quick_two_sum(s.hi, s.lo + t.lo)
    }
}

impl Neg for Dd {
    type Output = Self;
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl Sub for Dd {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + (-other)
    }
}

/// Product (Dekker 1971, `mul2`; Hida, Li & Bailey 2001, 3.3).
impl Mul for Dd {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let p = two_prod(self.hi, other.hi);
        quick_two_sum(p.hi, p.lo + (self.hi * other.lo + self.lo * other.hi))
    }
}

/// Quotient by long division with two corrections (Hida, Li & Bailey 2001, 3.4).
impl Div for Dd {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.hi / other.hi;
        let rest = self - other * Self::from(first);
        let second = rest.hi / other.hi;
        let rest = rest - other * Self::from(second);
        quick_two_sum(first, second) + Self::from(rest.hi / other.hi)
    }
}

impl AddAssign for Dd {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Dd {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

const PI: &str = "3.14159265358979323846264338327950288";
/// A few u² (u² = 4.9e-32).
const TOLERANCE: f64 = 4e-31;

fn assert_near(x: Dd, digits: &str) {
    let expected = Dd::parse(digits);
    let error = f64::from(x - expected).abs();
    assert!(error <= TOLERANCE * expected.hi.abs().max(1.0), "{x:?} {digits} {error:e}");
}

#[test]
fn sums_and_products_are_exact() {
    let tiny = 2.0_f64.powi(-80);
    assert_eq!(Dd::ONE + Dd::from(tiny), Dd { hi: 1.0, lo: tiny });
    let x = 1.0 + f64::EPSILON;
    assert_eq!(
        two_prod(x, x),
        Dd { hi: 1.0 + 2.0 * f64::EPSILON, lo: f64::EPSILON * f64::EPSILON }
    );
    let cancelled = (Dd::ONE + Dd::from(tiny)) - Dd::ONE;
    assert_eq!(cancelled, Dd::from(tiny));
}

#[test]
fn quotient_and_root() {
    assert_near(Dd::ONE / Dd::from(3.0), "0.333333333333333333333333333333333333");
    assert_near(Dd::from(22.0) / Dd::from(-7.0), "-3.14285714285714285714285714285714286");
    assert_near(Dd::from(2.0).sqrt(), "1.41421356237309504880168872420969808");
    assert_near(Dd::from(1e10).sqrt(), "100000.0");
    assert_eq!(Dd::ZERO.sqrt(), Dd::ZERO);
}

#[test]
fn sine_and_cosine() {
    for (x, sin, cos) in [
        (1.0, "0.841470984807896506652502321630298999", "0.540302305868139717400936607442976603"),
        (0.5, "0.479425538604203000273287935215571388", "0.877582561890372716116281582603829652"),
        (2.0, "0.909297426825681695396019865911744842", "-0.416146836547142386997568229500762189"),
        (
            -3.0,
            "-0.141120008059867222100744802808110279",
            "-0.989992496600445457271572794731261302",
        ),
        (
            10.0,
            "-0.544021110889369813404747661851377281",
            "-0.839071529076452452258863947824064834",
        ),
    ] {
        let (s, c) = Dd::from(x).sin_cos();
        assert_near(s, sin);
        assert_near(c, cos);
    }
}

#[test]
fn angles() {
    let d = Dd::from;
    assert_near(Dd::atan2(d(1.0), d(1.0)) * d(4.0), PI);
    assert_near(Dd::atan2(d(0.0), d(-2.0)), PI);
    assert_near(Dd::atan2(d(1.0), d(2.0)), "0.463647609000806116214256231461214402");
    assert_near(Dd::HALF_PI + Dd::HALF_PI, PI);
    // The angle of a direction gives the direction back.
    let (s, c) = Dd::atan2(d(-0.3), d(0.1)).sin_cos();
    assert!(f64::from(s * d(0.1) + c * d(0.3)).abs() < TOLERANCE);
}

#[test]
fn parsing_keeps_thirty_digits() {
    let ln_10 = Dd::parse("2.30258509299404568401799145468436421");
    assert_eq!(ln_10.hi, LN_10);
    assert!((ln_10.lo - -2.1707562233822494e-16).abs() < 1e-31);
    assert_eq!(Dd::parse("-0.125"), Dd::from(-0.125));
}
