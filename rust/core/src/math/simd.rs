//! Vector instruction sets: which ones the machine has, and which one to use.

use std::sync::LazyLock;

/// A vector instruction set.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Simd {
    /// Two numbers at once, on any processor.
    Baseline,
    /// x86-64 with AVX2: four numbers per instruction.
    Avx2,
    /// x86-64 with AVX-512 F, VL and DQ: eight numbers per instruction.
    Avx512,
}

impl Simd {
    /// The best set this machine has.
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

    /// Its name in `ASSUR_SIMD`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Baseline => "baseline",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }

    /// The best set that this machine has and `ASSUR_SIMD` allows (`baseline` or `avx2`; any
    /// other value sets no limit). The variable is read once.
    #[must_use]
    pub fn allowed() -> Self {
        static ALLOWED: LazyLock<Simd> = LazyLock::new(|| {
            let limit = match std::env::var("ASSUR_SIMD").as_deref() {
                Ok("baseline") => Simd::Baseline,
                Ok("avx2") => Simd::Avx2,
                _ => Simd::Avx512,
            };
            Simd::best().min(limit)
        });
        *ALLOWED
    }
}

impl Default for Simd {
    fn default() -> Self {
        Self::allowed()
    }
}
