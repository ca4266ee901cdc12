//! One compiled copy of the solver for each level, that is for each set of vector instructions. All
//! give the same bits, since each operation is rounded separately.

use super::state::{Context, State};
use crate::math::lanes::{Lanes, Real};
#[cfg(target_arch = "x86_64")]
use crate::math::pair::Pair;
#[cfg(target_arch = "x86_64")]
use crate::math::registers::{F64x2, F64x4, F64x8};
use crate::plan::group::Group;

/// The solver of positions compiled for one level.
///
/// `solve` and `group` are separate functions: several callers share `solve`, and smaller functions
/// compile faster.
pub(crate) trait Level {
    /// Its register.
    type Register: Real;
    /// See [`State::solve_all`].
    fn solve<const G: usize>(state: &mut State<Self::Register, G>, cx: &Context<'_>);
    /// See [`State::solve_group`].
    fn group<const G: usize>(
        state: &mut State<Self::Register, G>,
        cx: &Context<'_>,
        group: &Group,
        index: usize,
    );
}

/// What every processor has: arrays of numbers, which the compiler puts into registers as well as it
/// can.
pub(crate) mod portable {
    use super::{Context, Group, Lanes, Level, State};

    pub(crate) struct Portable;

    impl Level for Portable {
        type Register = Lanes;
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

/// A level of x86-64; in its own module, so that the levels compile in parallel.
#[cfg(target_arch = "x86_64")]
macro_rules! level {
    ($module:ident, $level:ident, $register:ty, $features:literal) => {
        pub(crate) mod $module {
            use super::{Context, Group, Level, State};

            pub(crate) struct $level;

            impl Level for $level {
                type Register = $register;
                #[inline(always)]
                #[allow(unsafe_code, reason = "the machine was asked for these instructions")]
                fn solve<const G: usize>(state: &mut State<$register, G>, cx: &Context<'_>) {
                    #[target_feature(enable = $features)]
                    fn with<const G: usize>(state: &mut State<$register, G>, cx: &Context<'_>) {
                        state.solve_all(cx, &$level::group);
                    }
                    // SAFETY: `solve` is called only if `Simd::best` found these instructions.
                    unsafe { with(state, cx) }
                }
                #[inline(always)]
                #[allow(unsafe_code, reason = "the machine was asked for these instructions")]
                fn group<const G: usize>(
                    state: &mut State<$register, G>,
                    cx: &Context<'_>,
                    group: &Group,
                    index: usize,
                ) {
                    #[inline(never)]
                    #[target_feature(enable = $features)]
                    fn with<const G: usize>(
                        state: &mut State<$register, G>,
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
level!(baseline, Baseline, super::Pair<super::F64x2>, "sse2");
#[cfg(target_arch = "x86_64")]
level!(avx2, Avx2, super::Pair<super::F64x4>, "avx2");
#[cfg(target_arch = "x86_64")]
level!(avx512, Avx512, super::F64x8, "avx512f,avx512vl,avx512dq");
