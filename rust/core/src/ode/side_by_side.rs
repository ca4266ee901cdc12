//! Steps of several runs side by side, one in each lane of a register. A lane has the bits that
//! its run finds alone.

use super::lane_step::{COMPONENTS, LaneEnds, LaneState, Steps, Underway, weighted_sum};
use super::pair::stages::blocks;
use super::system::System;
use crate::math::lanes::{LANES, Mask, Real};

/// Rates of a system in every lane.
///
/// A trait: a closure would not be compiled for the level's instructions.
pub(crate) trait LaneRates<R: Real> {
    /// Writes the rates of a state; returns the lanes in which they are known. `is_end`: whether it is
    /// the state at the end of the steps.
    fn rates(&mut self, state: &LaneState<R>, is_end: bool, rates: &mut LaneState<R>) -> R::Mask;
}

/// Work space for the steps in every lane.
pub(crate) struct LaneSteps<R: Real> {
    rates: Vec<LaneState<R>>,
    argument: LaneState<R>,
    new: LaneState<R>,
    ends: LaneEnds,
    /// The lanes whose steps end without more if their errors are small enough, a bit each.
    ordinary: u32,
    /// Stages of each lane, from the first on, whose rates are known.
    known: [usize; LANES],
}

impl<R: Real> LaneSteps<R> {
    pub(crate) fn new() -> Self {
        Self {
            rates: Vec::new(),
            argument: Default::default(),
            new: Default::default(),
            ends: LaneEnds::default(),
            ordinary: 0,
            known: [0; LANES],
        }
    }

    /// The states at the ends of the steps.
    pub(crate) fn new_state(&self) -> &LaneState<R> {
        &self.new
    }

    /// The steps of these lanes may end without more.
    #[inline(always)]
    pub(crate) fn let_end(&mut self, lanes: R::Mask) {
        self.ordinary = lanes.bits();
    }

    /// Finds the planned steps, at most as many as there are lanes: the rates of all stages, and their ends.
    /// Returns the lanes in which these are known and have no event.
    #[inline(always)]
    pub(crate) fn find<S: System>(
        &mut self,
        runs: &[Underway<'_, S>],
        system: &mut impl LaneRates<R>,
    ) -> R::Mask {
        let Some(first) = runs.first() else { return R::Mask::NONE };
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
        self.known = [count; LANES];
        let mut are_all_known = R::ZERO.finite();
        for stage in 1..count {
            let row = if stage == end { tableau.b() } else { tableau.a[stage] };
            let sum = weighted_sum(row, &self.rates);
            let mut at = y;
            for i in 0..COMPONENTS {
                at[i] = y[i] + h * sum[i];
            }
            if stage + 1 == end {
                self.argument = at;
            }
            if stage == end {
                self.new = at;
            }
            let mut found = [R::ZERO; COMPONENTS];
            let mut are_known = system.rates(&at, stage == end, &mut found);
            for number in found {
                are_known = are_known.and(number.finite());
            }
            self.rates[stage] = found;
            are_all_known = are_all_known.and(are_known);
            if !are_known.all() {
                for (lane, known) in self.known.iter_mut().enumerate().take(R::LANES) {
                    if !are_known.lane(lane) {
                        *known = (*known).min(stage);
                    }
                }
            }
        }
        let (argument, new) = (self.argument, self.new);
        let steps = Steps { y, h, rates: &self.rates, argument, new };
        self.ends.find(&steps, runs).and(are_all_known)
    }

    /// Gives a run what was found of its step: its end if that needs no more, else the rates of its stages.
    /// Those that are not known the run finds itself. Returns whether it was its end.
    pub(crate) fn give<S: System>(&self, lane: usize, underway: &mut Underway<'_, S>) -> bool {
        let is_ordinary = self.ordinary >> lane & 1 != 0 && self.ends.give(lane, underway);
        if !is_ordinary {
            let rate = |stage: usize, i: usize| self.rates[stage][i].lane(lane);
            underway.run.give(self.known[lane], rate, |i| self.argument[i].lane(lane));
        }
        is_ordinary
    }
}
