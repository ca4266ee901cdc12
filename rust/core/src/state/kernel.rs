//! One compiled copy of the solver for each level, that is for each set of vector instructions. All
//! give the same bits, since each operation is rounded separately.

use super::state::{Context, State};
use crate::math::lanes::Lanes;
use crate::plan::group::Group;

/// The solver of positions compiled for one level.
///
/// `solve` and `group` are separate functions: several callers share `solve`, and smaller functions
/// compile faster.
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

/// The baseline, which every machine has.
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

/// A level above the baseline; in its own module, so that the levels compile in parallel.
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
                    // SAFETY: `solve` is called only if `Simd::best` found these instructions.
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
