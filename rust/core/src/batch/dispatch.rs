//! Chooses the compiled copy of the worker, by the processor and the caller's limit.

use super::worker::{Job, Worker};
use crate::math::simd::Simd;
use crate::state::kernel::baseline::Baseline;

/// Solves a job at the requested SIMD level, or at the best one the processor has.
pub(crate) fn run(simd: Simd, worker: &mut Worker<'_>, job: &mut Job<'_, '_>) {
    match simd.min(Simd::best()) {
        #[cfg(target_arch = "x86_64")]
        Simd::Avx2 => avx2(worker, job),
        #[cfg(target_arch = "x86_64")]
        Simd::Avx512 => avx512(worker, job),
        _ => baseline(worker, job),
    }
}

#[inline(never)]
fn baseline(worker: &mut Worker<'_>, job: &mut Job<'_, '_>) {
    worker.run::<Baseline>(job);
}

#[cfg(target_arch = "x86_64")]
macro_rules! entry {
    ($name:ident, $level:ident, $features:literal) => {
        #[inline(always)]
        #[allow(unsafe_code, reason = "the machine was asked for these instructions")]
        fn $name(worker: &mut Worker<'_>, job: &mut Job<'_, '_>) {
            #[target_feature(enable = $features)]
            fn with(worker: &mut Worker<'_>, job: &mut Job<'_, '_>) {
                worker.run::<crate::state::kernel::$name::$level>(job);
            }
            // SAFETY: `run` calls this only if `Simd::best` found these instructions.
            unsafe { with(worker, job) }
        }
    };
}

#[cfg(target_arch = "x86_64")]
entry!(avx2, Avx2, "avx2");
#[cfg(target_arch = "x86_64")]
entry!(avx512, Avx512, "avx512f,avx512vl,avx512dq");
