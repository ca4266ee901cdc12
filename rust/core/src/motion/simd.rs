//! One compiled copy of the executor for each set of vector instructions, chosen when
//! it runs. All give the same bits: each operation is rounded by itself.

use std::sync::LazyLock;

use super::rows::{Job, Worker};

/// A set of vector instructions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Simd {
    /// What every machine of the kind has.
    Baseline,
    /// x86-64 with AVX2: four numbers an instruction.
    Avx2,
    /// x86-64 with AVX-512 F, VL and DQ: eight.
    Avx512,
}

impl Simd {
    /// The best that this machine has.
    #[must_use]
    pub fn best() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            let wide = is_x86_feature_detected!("avx2")
                && is_x86_feature_detected!("fma")
                && is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512vl")
                && is_x86_feature_detected!("avx512dq");
            if wide {
                return Self::Avx512;
            }
            if is_x86_feature_detected!("avx2") {
                return Self::Avx2;
            }
        }
        Self::Baseline
    }

    /// The best that this machine has and the user allows: `ASSUR_SIMD=baseline` (or
    /// `avx2`; anything else: the best there is), read once.
    #[must_use]
    pub fn allowed() -> Self {
        static ALLOWED: LazyLock<Simd> = LazyLock::new(|| {
            let most = match std::env::var("ASSUR_SIMD").as_deref() {
                Ok("baseline") => Simd::Baseline,
                Ok("avx2") => Simd::Avx2,
                _ => Simd::Avx512,
            };
            Simd::best().min(most)
        });
        *ALLOWED
    }
}

impl Default for Simd {
    fn default() -> Self {
        Self::allowed()
    }
}

/// Solves a job with the instructions asked for, as far as the machine has them.
pub(crate) fn solve(simd: Simd, worker: &mut Worker<'_>, job: &mut Job<'_, '_>) {
    match simd.min(Simd::best()) {
        #[cfg(target_arch = "x86_64")]
        #[allow(unsafe_code, reason = "the machine was asked for these instructions")]
        // SAFETY: `best` has asked for these instructions and those of every level below.
        Simd::Avx2 => unsafe { avx2(worker, job) },
        #[cfg(target_arch = "x86_64")]
        #[allow(unsafe_code, reason = "the machine was asked for these instructions")]
        // SAFETY: as above.
        Simd::Avx512 => unsafe { avx512(worker, job) },
        _ => baseline(worker, job),
    }
}

#[inline(never)]
fn baseline(worker: &mut Worker<'_>, job: &mut Job<'_, '_>) {
    worker.run(job);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn avx2(worker: &mut Worker<'_>, job: &mut Job<'_, '_>) {
    worker.run(job);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq")]
fn avx512(worker: &mut Worker<'_>, job: &mut Job<'_, '_>) {
    worker.run(job);
}
