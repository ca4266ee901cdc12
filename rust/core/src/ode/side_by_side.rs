//! The stages of steps of several runs side by side, one in each lane of a register. A lane has the bits that
//! its run finds alone.

use super::pair::stages::blocks;
use super::pair::tableau::{Row, Tableau};
use super::run::{Planned, Run};
use super::system::System;
use crate::math::lanes::{Mask, Real};

/// Components of a state: one block.
pub(crate) const COMPONENTS: usize = 3;

/// A state, or its rates, in every lane.
pub(crate) type LaneState<R> = [R; COMPONENTS];

/// Work space for the stages of a step in every lane.
pub(crate) struct LaneStages<R> {
    rates: Vec<LaneState<R>>,
}

impl<R: Real> LaneStages<R> {
    pub(crate) fn new() -> Self {
        Self { rates: Vec::new() }
    }

    /// Finds the rates of all stages of the planned steps, at most as many as there are lanes, and gives
    /// them to their runs. `evaluate` writes the rates of a state, and returns the lanes in which they are
    /// known; a run finds the others itself.
    #[inline(always)]
    pub(crate) fn give<S: System>(
        &mut self,
        runs: &mut [&mut Run<'_, S>],
        planned: &[Planned],
        mut evaluate: impl FnMut(&LaneState<R>, &mut LaneState<R>) -> R::Mask,
    ) {
        let Some(first) = runs.first() else { return };
        let tableau = first.tableau();
        debug_assert!(blocks(COMPONENTS) == 1, "a state is one block");
        let used = runs.len();
        // The other lanes repeat the first run.
        let of = |lane: usize| if lane < used { lane } else { 0 };
        let y: LaneState<R> =
            std::array::from_fn(|i| R::from_lanes(|lane| runs[of(lane)].state()[i]));
        let h = R::from_lanes(|lane| planned[of(lane)].h);
        let end = tableau.stages;
        let count = tableau.all_stages();
        self.rates.clear();
        self.rates.resize(count, [R::ZERO; COMPONENTS]);
        self.rates[0] = std::array::from_fn(|i| R::from_lanes(|lane| runs[of(lane)].rates()[i]));
        let mut known = [count; crate::math::lanes::LANES];
        let mut argument = y;
        for stage in 1..count {
            let row = if stage == end { tableau.b() } else { tableau.a[stage] };
            let at = combine(row, &self.rates, h, &y);
            if stage + 1 == end {
                argument = at;
            }
            let mut found = [R::ZERO; COMPONENTS];
            let are_known = evaluate(&at, &mut found);
            let are_known =
                found.iter().chain(&at).fold(are_known, |known, x| known.and(x.finite()));
            self.rates[stage] = found;
            if !are_known.all() {
                for (lane, known) in known.iter_mut().enumerate().take(R::LANES) {
                    if !are_known.lane(lane) {
                        *known = (*known).min(stage);
                    }
                }
            }
        }
        for (lane, run) in runs.iter_mut().enumerate() {
            let rate = |stage: usize, i: usize| self.rates[stage][i].lane(lane);
            run.give(known[lane], rate, |i| argument[i].lane(lane));
        }
    }
}

/// y + h Σ wⱼ kⱼ, as `Stages` sums it.
#[inline(always)]
fn combine<R: Real>(row: Row, k: &[LaneState<R>], h: R, y: &LaneState<R>) -> LaneState<R> {
    let mut total = [R::ZERO; COMPONENTS];
    for &(stage, weight) in row {
        let (k, weight) = (&k[stage], R::splat(weight));
        for i in 0..COMPONENTS {
            total[i] += weight * k[i];
        }
    }
    std::array::from_fn(|i| y[i] + h * total[i])
}

impl<S: System> Run<'_, S> {
    /// Its method.
    fn tableau(&self) -> &'static Tableau {
        self.stages().tableau
    }
}
