//! The stages of steps of several runs side by side, one in each lane of a register. A lane has the bits that
//! its run finds alone.

use super::pair::stages::blocks;
use super::pair::tableau::Row;
use super::run::{Planned, Run};
use super::system::System;
use crate::math::lanes::{LANES, Mask, Real};

/// Components of a state: one block.
pub(crate) const COMPONENTS: usize = 3;

/// A state, or its rates, in every lane.
pub(crate) type LaneState<R> = [R; COMPONENTS];

/// A run with the step that it attempts next.
pub(crate) struct Underway<'a, S> {
    /// Its place among all runs.
    pub index: usize,
    pub run: Run<'a, S>,
    pub planned: Planned,
}

/// Rates of a system in every lane.
///
/// A trait: a closure would not be compiled for the level's instructions.
pub(crate) trait LaneRates<R: Real> {
    /// Writes the rates of a state; returns the lanes in which they are known. `is_end`: whether it is
    /// the state at the end of the steps.
    fn rates(&mut self, state: &LaneState<R>, is_end: bool, rates: &mut LaneState<R>) -> R::Mask;
}

/// Work space for the stages of a step in every lane.
pub(crate) struct LaneStages<R> {
    rates: Vec<LaneState<R>>,
}

impl<R: Real> LaneStages<R> {
    pub(crate) fn new() -> Self {
        Self { rates: Vec::new() }
    }

    /// Finds the rates of all stages of the planned steps, at most as many as there are lanes, and gives
    /// them to their runs. Those that are not known the run finds itself.
    #[inline(always)]
    pub(crate) fn give<S: System>(
        &mut self,
        runs: &mut [Underway<'_, S>],
        system: &mut impl LaneRates<R>,
    ) {
        let Some(first) = runs.first() else { return };
        let tableau = first.run.stages().tableau;
        debug_assert!(blocks(COMPONENTS) == 1, "a state is one block");
        let used = runs.len();
        // The other lanes repeat the first run.
        let of = |lane: usize| if lane < used { lane } else { 0 };
        let mut y = [R::ZERO; COMPONENTS];
        let mut rates = [R::ZERO; COMPONENTS];
        for i in 0..COMPONENTS {
            y[i] = R::from_lanes(|lane| runs[of(lane)].run.state()[i]);
            rates[i] = R::from_lanes(|lane| runs[of(lane)].run.rates()[i]);
        }
        let h = R::from_lanes(|lane| runs[of(lane)].planned.h);
        let end = tableau.stages;
        let count = tableau.all_stages();
        self.rates.clear();
        self.rates.resize(count, [R::ZERO; COMPONENTS]);
        self.rates[0] = rates;
        let mut known = [count; LANES];
        let mut argument = y;
        for stage in 1..count {
            let row = if stage == end { tableau.b() } else { tableau.a[stage] };
            let at = combine(row, &self.rates, h, &y);
            if stage + 1 == end {
                argument = at;
            }
            let mut found = [R::ZERO; COMPONENTS];
            let mut are_known = system.rates(&at, stage == end, &mut found);
            for number in found {
                are_known = are_known.and(number.finite());
            }
            self.rates[stage] = found;
            if !are_known.all() {
                for (lane, known) in known.iter_mut().enumerate().take(R::LANES) {
                    if !are_known.lane(lane) {
                        *known = (*known).min(stage);
                    }
                }
            }
        }
        for (lane, Underway { run, .. }) in runs.iter_mut().enumerate() {
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
    let mut state = *y;
    for i in 0..COMPONENTS {
        state[i] = y[i] + h * total[i];
    }
    state
}
