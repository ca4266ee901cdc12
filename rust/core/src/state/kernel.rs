//! One compiled copy of the solver for each level, that is for each set of vector instructions. All
//! give the same bits, because every operation is rounded separately.

use super::state::{Context, State};
use crate::math::lanes::Real;
use crate::math::pair::Pair;
#[cfg(target_arch = "x86_64")]
use crate::math::registers::{avx2::F64x4, avx512::F64x8};
use crate::math::stride::Stride;
use crate::plan::group::Group;
use crate::plan::tape::{DyadOp, PlaceOp};

/// Most positions in a block: their columns fit the first-level cache, and a turn in steps of 5° is
/// one block.
pub(crate) const BLOCK: usize = 144;

/// The solver of positions compiled for one level.
///
/// `solve` and `group` are separate functions: several callers share `solve`, and smaller functions
/// compile faster.
pub(crate) trait Level: Sized {
    /// Its register.
    type Register: Real;
    /// Number of registers that the longer kernels without checks take at once.
    type Stride: Stride<Self::Register>;
    /// See [`State::run`].
    fn solve<const G: usize>(state: &mut State<Self::Register, G>, cx: &Context<'_>);
    /// See [`State::run_unchecked`].
    fn unchecked<const G: usize>(state: &mut State<Self::Register, G>, cx: &Context<'_>);
    /// See [`State::unchecked_two_legs`].
    fn two_legs<const LEN: usize, const G: usize>(
        state: &mut State<Self::Register, G>,
        cx: &Context<'_>,
        op: &DyadOp,
    );
    /// See [`State::unchecked_standing_guide`].
    fn standing_guide<const LEN: usize, const G: usize>(
        state: &mut State<Self::Register, G>,
        cx: &Context<'_>,
        op: &DyadOp,
    );
    /// See [`State::unchecked_moving_guide`].
    fn moving_guide<const LEN: usize, const G: usize>(
        state: &mut State<Self::Register, G>,
        cx: &Context<'_>,
        op: &DyadOp,
    );
    /// See [`State::unchecked_turning_guide`].
    fn turning_guide<const LEN: usize, const G: usize>(
        state: &mut State<Self::Register, G>,
        cx: &Context<'_>,
        op: &DyadOp,
    );
    /// See [`State::standing_guides`].
    fn standing_guides<const G: usize>(
        state: &mut State<Self::Register, G>,
        cx: &Context<'_>,
        op: &DyadOp,
    );
    /// See [`State::place_of_length`].
    fn place<const LEN: usize, const G: usize>(
        state: &mut State<Self::Register, G>,
        cx: &Context<'_>,
        op: &PlaceOp,
    );
    /// See [`State::solve_group`].
    fn group<const G: usize>(
        state: &mut State<Self::Register, G>,
        cx: &Context<'_>,
        group: &Group,
        index: usize,
    );
}

/// A separately compiled function of a level. `$features`: the target features of its instructions.
macro_rules! compiled {
    (
        $register:ty; $name:ident [$($size:ident)?]
        ($state:ident, $($argument:ident: $type:ty),+) $body:expr
    ) => {
        #[inline(never)]
        fn $name<$(const $size: usize,)? const G: usize>(
            $state: &mut State<$register, G>,
            $($argument: $type),+
        ) {
            $body
        }
    };
    (
        $register:ty, $features:literal; $name:ident [$($size:ident)?]
        ($state:ident, $($argument:ident: $type:ty),+) $body:expr
    ) => {
        #[inline(always)]
        #[allow(unsafe_code, reason = "only levels that the processor has are used")]
        fn $name<$(const $size: usize,)? const G: usize>(
            $state: &mut State<$register, G>,
            $($argument: $type),+
        ) {
            #[inline(never)]
            #[target_feature(enable = $features)]
            fn with<$(const $size: usize,)? const G: usize>(
                $state: &mut State<$register, G>,
                $($argument: $type),+
            ) {
                $body
            }
            // SAFETY: a level is used only if `Simd::best` found its instructions.
            unsafe { with::<$($size,)? G>($state, $($argument),+) }
        }
    };
}

/// A level; in its own module, so that the levels compile in parallel.
macro_rules! level {
    ($module:ident, $level:ident, $register:ty, $stride:ty $(, $features:literal)?) => {
        pub(crate) mod $module {
            use super::{Context, DyadOp, Group, Level, PlaceOp, State};

            pub(crate) struct $level;

            impl Level for $level {
                type Register = $register;
                type Stride = $stride;
                compiled!($register $(, $features)?; solve [] (state, cx: &Context<'_>)
                    state.run::<$level>(cx, cx.tape));
                compiled!($register $(, $features)?; unchecked [] (state, cx: &Context<'_>)
                    state.run_unchecked::<$level>(cx, cx.tape));
                compiled!($register $(, $features)?;
                    two_legs [LEN] (state, cx: &Context<'_>, op: &DyadOp)
                    state.unchecked_two_legs::<$stride, LEN>(cx, op));
                compiled!($register $(, $features)?;
                    standing_guide [LEN] (state, cx: &Context<'_>, op: &DyadOp)
                    state.unchecked_standing_guide::<$stride, LEN>(cx, op));
                compiled!($register $(, $features)?;
                    moving_guide [LEN] (state, cx: &Context<'_>, op: &DyadOp)
                    state.unchecked_moving_guide::<LEN>(cx, op));
                compiled!($register $(, $features)?;
                    turning_guide [LEN] (state, cx: &Context<'_>, op: &DyadOp)
                    state.unchecked_turning_guide::<LEN>(cx, op));
                compiled!($register $(, $features)?;
                    standing_guides [] (state, cx: &Context<'_>, op: &DyadOp)
                    state.standing_guides::<false>(cx, op));
                compiled!($register $(, $features)?;
                    place [LEN] (state, cx: &Context<'_>, op: &PlaceOp)
                    state.place_of_length(cx, op, LEN));
                compiled!($register $(, $features)?;
                    group [] (state, cx: &Context<'_>, group: &Group, index: usize)
                    state.solve_group(cx, group, index));
            }
        }
    };
}

// One number: for single positions.
level!(alone, Alone, f64, f64);
// Two numbers on any processor; the compiler puts them into one register if it can: by SSE2's own
// instructions positions take 0.85 of the time, which is not worth it for the processors that lack AVX2.
level!(baseline, Baseline, super::Pair<f64>, super::Pair<f64>);
#[cfg(target_arch = "x86_64")]
level!(avx2, Avx2, super::Pair<super::F64x4>, super::Pair<super::F64x4>, "avx2");
#[cfg(target_arch = "x86_64")]
level!(avx512, Avx512, super::F64x8, super::Pair<super::F64x8>, "avx512f,avx512vl,avx512dq");
