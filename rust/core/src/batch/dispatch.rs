//! Chooses the compiled copy of the worker, by the processor and the caller's limit.

use super::worker::{Job, Worker};
use crate::branch::lanes::uniform::Traced;
use crate::math::lanes::Real;
use crate::math::simd::Simd;
use crate::state::kernel::baseline::Baseline;
use crate::state::kernel::{BLOCK, Level};

/// Work compiled once for each level.
pub(crate) trait ForLevel {
    type Output;
    /// Runs it with blocks of `G` registers, which hold [`BLOCK`] positions.
    fn run<L: Entry, const G: usize>(self) -> Self::Output;
}

/// Work on positions side by side, independent of the solver.
pub(crate) trait Task<R: Real> {
    /// Does it.
    fn run(&mut self);
}

/// A level with the worker's compiled copy.
pub(crate) trait Entry: Level {
    /// See [`Worker::run`].
    fn run<const G: usize>(worker: &mut Worker<'_, Self::Register, G>, job: &mut Job<'_, '_>);
    /// See [`Worker::trace`].
    fn trace<const G: usize>(
        worker: &mut Worker<'_, Self::Register, G>,
        job: &Job<'_, '_>,
        unchecked: bool,
    ) -> Traced;
    /// Does a task with the level's instructions.
    fn call(task: &mut impl Task<Self::Register>);
}

/// Runs the work at the requested level, or at the best one that the processor has.
pub(crate) fn at_level<W: ForLevel>(simd: Simd, work: W) -> W::Output {
    match simd.min(Simd::best()) {
        #[cfg(target_arch = "x86_64")]
        Simd::Avx2 => work.run::<crate::state::kernel::avx2::Avx2, { BLOCK / 8 }>(),
        #[cfg(target_arch = "x86_64")]
        Simd::Avx512 => work.run::<crate::state::kernel::avx512::Avx512, { BLOCK / 8 }>(),
        _ => work.run::<Baseline, { BLOCK / 2 }>(),
    }
}

impl Entry for Baseline {
    #[inline(never)]
    fn run<const G: usize>(worker: &mut Worker<'_, Self::Register, G>, job: &mut Job<'_, '_>) {
        worker.run::<Self>(job, Self::trace);
    }
    #[inline(never)]
    fn trace<const G: usize>(
        worker: &mut Worker<'_, Self::Register, G>,
        job: &Job<'_, '_>,
        unchecked: bool,
    ) -> Traced {
        worker.trace::<Self>(job, unchecked)
    }
    #[inline(never)]
    fn call(task: &mut impl Task<Self::Register>) {
        task.run();
    }
}

#[cfg(target_arch = "x86_64")]
macro_rules! entry {
    ($module:ident, $level:ident, $features:literal) => {
        impl Entry for crate::state::kernel::$module::$level {
            #[inline(always)]
            #[allow(unsafe_code, reason = "only levels that the processor has are used")]
            fn run<const G: usize>(
                worker: &mut Worker<'_, Self::Register, G>,
                job: &mut Job<'_, '_>,
            ) {
                use crate::state::kernel::$module::$level;
                #[target_feature(enable = $features)]
                fn with<const G: usize>(
                    worker: &mut Worker<'_, <$level as Level>::Register, G>,
                    job: &mut Job<'_, '_>,
                ) {
                    worker.run::<$level>(job, <$level as Entry>::trace);
                }
                // SAFETY: `at_level` chooses this only if `Simd::best` found these instructions.
                unsafe { with(worker, job) }
            }
            #[inline(always)]
            #[allow(unsafe_code, reason = "only levels that the processor has are used")]
            fn trace<const G: usize>(
                worker: &mut Worker<'_, Self::Register, G>,
                job: &Job<'_, '_>,
                unchecked: bool,
            ) -> Traced {
                use crate::state::kernel::$module::$level;
                #[inline(never)]
                #[target_feature(enable = $features)]
                fn with<const G: usize>(
                    worker: &mut Worker<'_, <$level as Level>::Register, G>,
                    job: &Job<'_, '_>,
                    unchecked: bool,
                ) -> Traced {
                    worker.trace::<$level>(job, unchecked)
                }
                // SAFETY: `at_level` chooses this only if `Simd::best` found these instructions.
                unsafe { with(worker, job, unchecked) }
            }
            #[inline(always)]
            #[allow(unsafe_code, reason = "the processor has these instructions")]
            fn call(task: &mut impl Task<Self::Register>) {
                use crate::state::kernel::$module::$level;
                #[inline(never)]
                #[target_feature(enable = $features)]
                fn with(task: &mut impl Task<<$level as Level>::Register>) {
                    task.run();
                }
                // SAFETY: `at_level` chooses this only if `Simd::best` found these instructions.
                unsafe { with(task) }
            }
        }
    };
}

#[cfg(target_arch = "x86_64")]
entry!(avx2, Avx2, "avx2");
#[cfg(target_arch = "x86_64")]
entry!(avx512, Avx512, "avx512f,avx512vl,avx512dq");
