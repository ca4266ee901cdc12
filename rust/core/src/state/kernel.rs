//! One compiled copy of the solver for each set of vector instructions. All give the same bits: each
//! operation is rounded by itself.

use super::state::{Context, State};
use crate::math::lanes::Lanes;
use crate::plan::group::Group;

/// The solver of positions compiled for a set of instructions.
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
}

/// The baseline, for which nothing is asked.
pub(crate) mod baseline {
    use super::{Context, Group, Lanes, Level, State};

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
    }
}

/// A level beyond the baseline; in a module of its own, so that the compiler works on the levels
/// side by side.
#[cfg(target_arch = "x86_64")]
macro_rules! level {
    ($module:ident, $level:ident, $features:literal) => {
        pub(crate) mod $module {
            use super::{Context, Group, Lanes, Level, State};

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
            }
        }
    };
}

#[cfg(target_arch = "x86_64")]
level!(avx2, Avx2, "avx2");
#[cfg(target_arch = "x86_64")]
level!(avx512, Avx512, "avx512f,avx512vl,avx512dq");
