//! One compiled copy of the executor for each set of vector instructions, chosen when
//! it runs. All give the same bits: each operation is rounded by itself.

use super::worker::{Job, Worker};
use crate::math::lanes::Lanes;
use crate::math::simd::Simd;
use crate::plan::group::Group;
use crate::state::state::{Context, State};

/// The executor compiled for a set of instructions.
///
/// Positions are a function of their own, as both the way and the rows call it, and so are groups
/// above class II: the compiler has less to do at once.
pub(crate) trait Level {
    /// See [`State::solve_all`].
    fn solve<const G: usize>(state: &mut State<Lanes, G>, cx: &Context<'_>);
    /// See [`State::solve_group`].
    fn group<const G: usize>(
        state: &mut State<Lanes, G>,
        cx: &Context<'_>,
        group: &Group,
        index: usize,
    );
    /// See [`Worker::run`].
    fn run(worker: &mut Worker<'_>, job: &mut Job<'_, '_>);
}

/// Solves a job with the instructions asked for, as far as the machine has them.
pub(crate) fn solve(simd: Simd, worker: &mut Worker<'_>, job: &mut Job<'_, '_>) {
    match simd.min(Simd::best()) {
        #[cfg(target_arch = "x86_64")]
        Simd::Avx2 => avx2::Avx2::run(worker, job),
        #[cfg(target_arch = "x86_64")]
        Simd::Avx512 => avx512::Avx512::run(worker, job),
        _ => baseline::Baseline::run(worker, job),
    }
}

/// The baseline, for which nothing is asked.
mod baseline {
    use super::{Context, Group, Job, Lanes, Level, State, Worker};

    pub(crate) struct Baseline;

    impl Level for Baseline {
        #[inline(never)]
        fn solve<const G: usize>(state: &mut State<Lanes, G>, cx: &Context<'_>) {
            state.solve_all(cx, &Self::group);
        }
        #[inline(never)]
        fn group<const G: usize>(
            state: &mut State<Lanes, G>,
            cx: &Context<'_>,
            group: &Group,
            index: usize,
        ) {
            state.solve_group(cx, group, index);
        }
        #[inline(never)]
        fn run(worker: &mut Worker<'_>, job: &mut Job<'_, '_>) {
            worker.run::<Self>(job);
        }
    }
}

/// A level beyond the baseline; in a module of its own, so that the compiler works on the levels
/// side by side.
#[cfg(target_arch = "x86_64")]
macro_rules! level {
    ($module:ident, $level:ident, $features:literal) => {
        mod $module {
            use super::{Context, Group, Job, Lanes, Level, State, Worker};

            pub(crate) struct $level;

            impl Level for $level {
                #[inline(always)]
                #[allow(unsafe_code, reason = "the machine was asked for these instructions")]
                fn solve<const G: usize>(state: &mut State<Lanes, G>, cx: &Context<'_>) {
                    #[target_feature(enable = $features)]
                    fn with<const G: usize>(state: &mut State<Lanes, G>, cx: &Context<'_>) {
                        state.solve_all(cx, &$level::group);
                    }
                    // SAFETY: `solve` comes here only if `Simd::best` has found them.
                    unsafe { with(state, cx) }
                }
                #[inline(always)]
                #[allow(unsafe_code, reason = "the machine was asked for these instructions")]
                fn group<const G: usize>(
                    state: &mut State<Lanes, G>,
                    cx: &Context<'_>,
                    group: &Group,
                    index: usize,
                ) {
                    #[inline(never)]
                    #[target_feature(enable = $features)]
                    fn with<const G: usize>(
                        state: &mut State<Lanes, G>,
                        cx: &Context<'_>,
                        group: &Group,
                        index: usize,
                    ) {
                        state.solve_group(cx, group, index);
                    }
                    // SAFETY: as above.
                    unsafe { with(state, cx, group, index) }
                }
                #[inline(always)]
                #[allow(unsafe_code, reason = "the machine was asked for these instructions")]
                fn run(worker: &mut Worker<'_>, job: &mut Job<'_, '_>) {
                    #[target_feature(enable = $features)]
                    fn with(worker: &mut Worker<'_>, job: &mut Job<'_, '_>) {
                        worker.run::<$level>(job);
                    }
                    // SAFETY: as above.
                    unsafe { with(worker, job) }
                }
            }
        }
    };
}

#[cfg(target_arch = "x86_64")]
level!(avx2, Avx2, "avx2");
#[cfg(target_arch = "x86_64")]
level!(avx512, Avx512, "avx512f,avx512vl,avx512dq");
