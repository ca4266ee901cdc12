//! Registers compute what single numbers do.

use std::cmp::Ordering;
use std::mem::MaybeUninit;

use super::avx2::F64x4;
use super::avx512::F64x8;
use crate::math::lanes::{Mask, Real};
use crate::math::pair::Pair;
use crate::math::simd::Simd;

/// Numbers that meet every rule of IEEE 754.
const NUMBERS: [f64; 16] = [
    0.0,
    -0.0,
    1.5,
    -2.5,
    0.3,
    -0.3,
    4503599627370495.5,
    -4503599627370497.0,
    1e300,
    -1e-310,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
    3.0,
    -1.0,
    6755399441055745.0,
];

/// Compares every operation of a register with that of a single number, bit by bit.
#[inline(always)]
fn compare<R: Real>() {
    for i in 0..NUMBERS.len() {
        for j in 0..NUMBERS.len() {
            let number = |at: usize, lane: usize| NUMBERS[(at + lane) % NUMBERS.len()];
            let (x, y) =
                (R::from_lanes(|lane| number(i, lane)), R::from_lanes(|lane| number(j, lane)));
            let mut written = [MaybeUninit::new(0.0); 16];
            let (first, last) = written.split_at_mut(R::LANES);
            let [before, after] = x.zip(y);
            let [even, odd] = before.unzip(after);
            let numbers: Vec<f64> = (0..R::LANES).map(|lane| number(i, lane)).collect();
            let read = R::read(&numbers);
            for lane in 0..R::LANES {
                assert_eq!(even.lane(lane).to_bits(), number(i, lane).to_bits());
                assert_eq!(odd.lane(lane).to_bits(), number(j, lane).to_bits());
                assert_eq!(read.lane(lane).to_bits(), number(i, lane).to_bits());
            }
            before.write(first);
            after.write(last);
            for lane in 0..R::LANES {
                let zipped = if lane < R::LANES / 2 { before } else { after };
                let at = 2 * lane % R::LANES;
                assert_eq!(zipped.lane(at).to_bits(), number(i, lane).to_bits());
                assert_eq!(zipped.lane(at + 1).to_bits(), number(j, lane).to_bits());
                // SAFETY: all were initialised.
                let pair = [0, 1].map(|k| unsafe { written[2 * lane + k].assume_init() });
                assert_eq!(
                    pair.map(f64::to_bits),
                    [zipped.lane(at), zipped.lane(at + 1)].map(f64::to_bits)
                );
            }
            for lane in 0..R::LANES {
                let (a, b) = (number(i, lane), number(j, lane));
                assert_eq!(R::splat(a).lane(lane).to_bits(), a.to_bits());
                let pairs = [
                    (x + y, a + b),
                    (x - y, a - b),
                    (x * y, a * b),
                    (x / y, a / b),
                    (-x, -a),
                    (x.sqrt(), a.sqrt()),
                    (x.abs(), a.abs()),
                    (x.max(y), Real::max(a, b)),
                    (x.min(y), Real::min(a, b)),
                    (x.floor(), a.floor()),
                    (x.copysign(y), a.copysign(b)),
                    (R::select(x.lt(y), x, y), if a < b { a } else { b }),
                ];
                for (index, (ours, theirs)) in pairs.into_iter().enumerate() {
                    let same = ours.lane(lane).to_bits() == theirs.to_bits();
                    let nan = ours.lane(lane).is_nan() && theirs.is_nan();
                    assert!(same || nan, "operation {index} of {a} and {b}");
                }
                let masks = [
                    (x.lt(y), a < b),
                    (x.lt(y), x.lt(y).bits() >> lane & 1 != 0),
                    (x.le(y), a <= b),
                    (x.finite(), a.is_finite()),
                    (x.bit(0), a.to_bits() & 1 != 0),
                    (x.bit(1), a.to_bits() & 2 != 0),
                    (x.lt(y).not(), a.partial_cmp(&b) != Some(Ordering::Less)),
                    (x.lt(y).or(x.le(R::ZERO)), a < b || a <= 0.0),
                    (x.lt(y).and(x.le(R::ZERO)), a < b && a <= 0.0),
                ];
                for (index, (ours, theirs)) in masks.into_iter().enumerate() {
                    assert_eq!(ours.lane(lane), theirs, "mask {index} of {a} and {b}");
                    let lanes = || (0..R::LANES).map(|lane| ours.lane(lane));
                    assert_eq!((ours.any(), ours.all()), (lanes().any(|x| x), lanes().all(|x| x)));
                }
            }
        }
    }
}

#[target_feature(enable = "avx2")]
fn avx2() {
    compare::<F64x4>();
}

#[target_feature(enable = "avx512f,avx512vl,avx512dq")]
fn avx512() {
    compare::<F64x8>();
}

#[test]
fn registers_do_what_single_numbers_do() {
    compare::<Pair<f64>>();
    for (simd, run) in [(Simd::Avx2, avx2 as unsafe fn()), (Simd::Avx512, avx512)] {
        if Simd::best() < simd {
            println!("{}: skipped, this processor has no such instructions", simd.name());
            continue;
        }
        // SAFETY: the processor has these instructions.
        unsafe { run() };
    }
}
