//! Stores past the caches: where results are more than these hold, a line need not be read before
//! it is written, which is half of what the memory has to do.

use std::mem::MaybeUninit;

use crate::lanes::Real;
use crate::plane::Vector;

/// Numbers from which on they are stored so: 32 MiB, about what the last cache of a machine holds.
pub(super) const LEAST: usize = 4 << 20;

/// Whether points may be stored so here.
#[inline(always)]
pub(super) fn is_aligned(out: &[MaybeUninit<f64>]) -> bool {
    cfg!(target_arch = "x86_64") && out.as_ptr().addr().is_multiple_of(16)
}

/// The lanes of a point, x and y side by side, at a place that is aligned.
#[inline(always)]
pub(super) fn store_pairs<R: Real>(out: &mut [MaybeUninit<f64>], p: Vector<R>) {
    for (lane, pair) in out[..2 * R::LANES].chunks_exact_mut(2).enumerate() {
        store_pair(pair, [p.x.lane(lane), p.y.lane(lane)]);
    }
}

#[cfg(target_arch = "x86_64")]
#[inline(always)]
#[allow(unsafe_code, reason = "only the instruction itself stores so")]
fn store_pair(pair: &mut [MaybeUninit<f64>], [x, y]: [f64; 2]) {
    use std::arch::x86_64::{_mm_set_pd, _mm_stream_pd};
    debug_assert!(pair.len() == 2 && is_aligned(pair));
    // SAFETY: every x86-64 has SSE2; these are two numbers at a multiple of 16 bytes, as every
    // pair is from one on that is.
    unsafe { _mm_stream_pd(pair.as_mut_ptr().cast(), _mm_set_pd(y, x)) };
}

#[cfg(not(target_arch = "x86_64"))]
fn store_pair(pair: &mut [MaybeUninit<f64>], numbers: [f64; 2]) {
    for (place, number) in pair.iter_mut().zip(numbers) {
        *place = MaybeUninit::new(number);
    }
}

/// Such stores are seen by other threads only after this.
#[allow(unsafe_code, reason = "only the instruction itself waits for them")]
pub(super) fn fence() {
    #[cfg(target_arch = "x86_64")]
    // SAFETY: every x86-64 has SSE.
    unsafe {
        std::arch::x86_64::_mm_sfence();
    }
}
