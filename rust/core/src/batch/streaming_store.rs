//! Stores past the caches: where results are more than these hold, a line need not be read before
//! it is written, which is half of what the memory has to do.

use std::mem::MaybeUninit;

use crate::math::lanes::Real;
use crate::math::vector::Vector;

/// Numbers from which on they are stored so: 32 MiB, about what the last cache of a machine holds.
pub(crate) const MIN_NUMBERS: usize = 4 << 20;

/// Whether points may be stored so here.
#[inline(always)]
fn is_aligned(out: &[MaybeUninit<f64>]) -> bool {
    cfg!(target_arch = "x86_64") && out.as_ptr().addr().is_multiple_of(16)
}

/// The lanes of a point, x and y side by side. Nothing may touch that memory before a [`fence`],
/// not even this thread; where it is not aligned these are plain stores.
#[inline(always)]
#[allow(unsafe_code, reason = "only the instruction itself stores so")]
pub(crate) fn store_pairs<R: Real>(out: &mut [MaybeUninit<f64>], p: Vector<R>) {
    let out = &mut out[..2 * R::LANES];
    if is_aligned(out) {
        for (lane, pair) in out.as_chunks_mut::<2>().0.iter_mut().enumerate() {
            // SAFETY: the slice is aligned, and so is every pair of it.
            unsafe { store_pair(pair, [p.x.lane(lane), p.y.lane(lane)]) };
        }
        return;
    }
    for (lane, pair) in out.as_chunks_mut::<2>().0.iter_mut().enumerate() {
        *pair = [p.x.lane(lane), p.y.lane(lane)].map(MaybeUninit::new);
    }
}

/// Stores two numbers past the caches.
///
/// # Safety
///
/// The place is at a multiple of 16 bytes.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
#[allow(unsafe_code, reason = "only the instruction itself stores so")]
unsafe fn store_pair(pair: &mut [MaybeUninit<f64>; 2], [x, y]: [f64; 2]) {
    use std::arch::x86_64::{_mm_set_pd, _mm_stream_pd};
    debug_assert!(is_aligned(pair));
    // SAFETY: every x86-64 has SSE2; the place is aligned, as the caller promises.
    unsafe { _mm_stream_pd(pair.as_mut_ptr().cast(), _mm_set_pd(y, x)) };
}

#[cfg(not(target_arch = "x86_64"))]
#[allow(unsafe_code, reason = "the same signature as with the instruction")]
unsafe fn store_pair(pair: &mut [MaybeUninit<f64>; 2], numbers: [f64; 2]) {
    *pair = numbers.map(MaybeUninit::new);
}

/// After this such stores are seen by other threads, and this one may store there again.
#[allow(unsafe_code, reason = "only the instruction itself waits for them")]
pub(crate) fn fence() {
    #[cfg(target_arch = "x86_64")]
    // SAFETY: every x86-64 has SSE.
    unsafe {
        std::arch::x86_64::_mm_sfence();
    }
}
