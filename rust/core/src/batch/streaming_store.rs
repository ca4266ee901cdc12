//! Non-temporal stores. When results exceed the caches, a cache line need not be read before it is
//! written, which halves the memory traffic.

use std::mem::MaybeUninit;

use crate::math::lanes::Real;
use crate::math::vector::Vector;

/// Smallest result that is streamed: 32 MiB, about the size of a last-level cache.
pub(crate) const MIN_NUMBERS: usize = 4 << 20;

/// Whether a streaming store may write here.
#[inline(always)]
fn is_aligned(out: &[MaybeUninit<f64>]) -> bool {
    cfg!(target_arch = "x86_64") && out.as_ptr().addr().is_multiple_of(16)
}

/// Streams the lanes of a point, x and y side by side. Nothing may access that memory before a
/// [`fence`], not even this thread; unaligned memory gets plain stores.
#[inline(always)]
#[allow(unsafe_code, reason = "only the instruction itself stores so")]
pub(crate) fn store_pairs<R: Real>(out: &mut [MaybeUninit<f64>], p: Vector<R>) {
    let out = &mut out[..2 * R::LANES];
    if is_aligned(out) {
        for (lane, pair) in out.as_chunks_mut::<2>().0.iter_mut().enumerate() {
            // SAFETY: the slice is aligned to 16 bytes, and so is each pair in it.
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
/// `pair` must be aligned to 16 bytes.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
#[allow(unsafe_code, reason = "only the instruction itself stores so")]
unsafe fn store_pair(pair: &mut [MaybeUninit<f64>; 2], [x, y]: [f64; 2]) {
    use std::arch::x86_64::{_mm_set_pd, _mm_stream_pd};
    debug_assert!(is_aligned(pair));
    // SAFETY: every x86-64 has SSE2, and the caller guarantees the alignment.
    unsafe { _mm_stream_pd(pair.as_mut_ptr().cast(), _mm_set_pd(y, x)) };
}

#[cfg(not(target_arch = "x86_64"))]
#[allow(unsafe_code, reason = "the same signature as with the instruction")]
unsafe fn store_pair(pair: &mut [MaybeUninit<f64>; 2], numbers: [f64; 2]) {
    *pair = numbers.map(MaybeUninit::new);
}

/// Completes the streaming stores: other threads then see them, and this one may store there again.
#[allow(unsafe_code, reason = "only the instruction itself waits for them")]
pub(crate) fn fence() {
    #[cfg(target_arch = "x86_64")]
    // SAFETY: every x86-64 has SSE.
    unsafe {
        std::arch::x86_64::_mm_sfence();
    }
}
