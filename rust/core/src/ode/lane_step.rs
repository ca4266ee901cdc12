//! The end of a step in every lane: the new state, its error, its continuous extension and its events. A lane
//! has the bits that `Stages`, `Interpolant` and `EventTracker` find for its run alone.

use super::event::SAMPLES;
use super::pair::dense::LEAST_ROWS;
use super::pair::estimate::in_tolerances;
use super::pair::tableau::{Row, Tableau};
use super::run::{Ordinary, Planned, Run, Watched};
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

/// A number in every lane, as an array.
type Numbers = [f64; LANES];

/// The ends of steps, lane by lane.
#[derive(Debug, Default)]
pub(super) struct LaneEnds {
    new: [Numbers; COMPONENTS],
    rates: [Numbers; COMPONENTS],
    rows: Vec<[Numbers; COMPONENTS]>,
    /// Mean squares of the estimated errors of a unit step.
    fine: Numbers,
    coarse: Option<Numbers>,
    magnitude: Numbers,
    event_value: Numbers,
    is_stiff: u32,
}

/// What is known of steps before their ends: the states where they begin, their widths, and the rates of all
/// their stages.
pub(super) struct Steps<'a, R> {
    pub y: LaneState<R>,
    pub h: R,
    pub rates: &'a [LaneState<R>],
    /// The argument of the last stage before the new state.
    pub argument: LaneState<R>,
    pub new: LaneState<R>,
}

impl LaneEnds {
    /// Finds the ends; returns the lanes in which they are finite and without an event. The other lanes repeat
    /// the first.
    #[inline(always)]
    pub(super) fn find<R: Real, S: System>(
        &mut self,
        steps: &Steps<'_, R>,
        runs: &[Underway<'_, S>],
    ) -> R::Mask {
        let Some(first) = runs.first() else { return R::Mask::NONE };
        let Some(watched) = first.run.watched() else { return R::Mask::NONE };
        debug_assert!(runs.iter().all(|one| one.run.watched() == Some(watched)), "of one design");
        let used = runs.len();
        let of = |lane: usize| if lane < used { lane } else { 0 };
        let tableau = first.run.stages().tableau;
        let scale = LaneScale::of(runs);
        self.fine = numbers(scale.mean_square(steps, &weighted_sum(tableau.error, steps.rates)));
        self.coarse = None;
        if let Some(row) = tableau.coarse_error {
            let sum = weighted_sum(row, steps.rates);
            self.coarse = Some(numbers(scale.mean_square(steps, &sum)));
        }
        self.is_stiff = scale.is_stiff(tableau, steps).bits();
        self.set_rows(tableau, steps);
        let mut are_known = steps.new[0].finite();
        for i in 0..COMPONENTS {
            are_known = are_known.and(steps.new[i].finite());
            self.new[i] = numbers(steps.new[i]);
            self.rates[i] = numbers(steps.rates[tableau.stages][i]);
        }
        if let Watched::Component(component) = watched {
            let sign = R::from_lanes(|lane| runs[of(lane)].run.first_event().0);
            let start = R::from_lanes(|lane| runs[of(lane)].run.first_event().1);
            let end = steps.new[component];
            let (is_quiet, magnitude) = self.keeps_sign(component, sign, start, end);
            are_known = are_known.and(is_quiet);
            self.magnitude = numbers(magnitude);
            self.event_value = numbers(end);
        }
        are_known
    }

    /// Gives a run the end of its step if its error is small enough; returns whether it is.
    pub(super) fn give<S: System>(
        &self,
        lane: usize,
        Underway { run, planned, .. }: &mut Underway<'_, S>,
    ) -> bool {
        let coarse = self.coarse.map(|coarse| coarse[lane]);
        let error = run.error_of(self.fine[lane], coarse, planned.h);
        let is_small = error <= 1.0;
        if is_small {
            let ordinary = Ordinary {
                error,
                is_stiff: self.is_stiff >> lane & 1 != 0,
                event_value: self.event_value[lane],
                magnitude: self.magnitude[lane],
            };
            let of = |list: &'_ [Numbers; COMPONENTS]| list.map(|numbers| numbers[lane]);
            let (new, rates) = (of(&self.new), of(&self.rates));
            run.give_end(planned.t_new, ordinary, [&new, &rates], |row, i| self.rows[row][i][lane]);
        }
        is_small
    }

    /// The rows of the continuous extension, as `Interpolant` has them.
    #[inline(always)]
    fn set_rows<R: Real>(&mut self, tableau: &Tableau, steps: &Steps<'_, R>) {
        let Steps { y, h, rates, new, .. } = steps;
        self.rows.resize(LEAST_ROWS + tableau.extension.len(), Default::default());
        for i in 0..COMPONENTS {
            let change = new[i] - y[i];
            let second = *h * rates[0][i] - change;
            self.rows[0][i] = numbers(y[i]);
            self.rows[1][i] = numbers(change);
            self.rows[2][i] = numbers(second);
            self.rows[3][i] = numbers(change - *h * rates[tableau.stages][i] - second);
        }
        for (r, row) in tableau.extension.iter().enumerate() {
            let sum = weighted_sum(row, rates);
            for i in 0..COMPONENTS {
                self.rows[LEAST_ROWS + r][i] = numbers(*h * sum[i]);
            }
        }
    }

    /// The lanes in which a component keeps a sign over the step and has no dip toward zero between the
    /// samples, and its greatest magnitude there.
    #[inline(always)]
    fn keeps_sign<R: Real>(&self, component: usize, sign: R, start: R, end: R) -> (R::Mask, R) {
        let mut values = [R::ZERO; SAMPLES.len() + 1];
        values[0] = start;
        for (value, theta) in values[1..].iter_mut().zip(SAMPLES) {
            let mut inner = R::ZERO;
            for (row, numbers) in self.rows.iter().enumerate().skip(1).rev() {
                let factor = if row % 2 == 1 { theta } else { 1.0 - theta };
                inner = (R::read(&numbers[component]) + inner) * R::splat(factor);
            }
            *value = R::read(&self.rows[0][component]) + inner;
        }
        values[SAMPLES.len()] = end;
        let mut is_quiet = R::ZERO.lt(sign.abs());
        let mut magnitude = R::ZERO;
        for value in values {
            magnitude = value.abs().max(magnitude);
        }
        for value in &values[1..] {
            is_quiet = is_quiet.and(R::ZERO.lt(*value * sign));
        }
        for i in 1..SAMPLES.len() {
            let (before, here) = (values[i - 1] * sign, values[i] * sign);
            let after = values[i + 1] * sign;
            is_quiet = is_quiet.and(before.lt(here).or(after.lt(here)));
        }
        (is_quiet, magnitude)
    }
}

/// The absolute and the relative tolerance of each component, in every lane.
struct LaneScale<R>([[R; 2]; COMPONENTS]);

impl<R: Real> LaneScale<R> {
    #[inline(always)]
    fn of<S: System>(runs: &[Underway<'_, S>]) -> Self {
        let used = runs.len();
        let of = |lane: usize| if lane < used { lane } else { 0 };
        let mut scale = [[R::ZERO; 2]; COMPONENTS];
        for (i, both) in scale.iter_mut().enumerate() {
            both[0] = R::from_lanes(|lane| runs[of(lane)].run.tolerance(i)[0]);
            both[1] = R::from_lanes(|lane| runs[of(lane)].run.tolerance(i)[1]);
        }
        Self(scale)
    }

    /// As `Scale::square_sum`.
    #[inline(always)]
    fn square_sum(&self, steps: &Steps<'_, R>, errors: &LaneState<R>) -> R {
        let mut total = R::ZERO;
        for i in 0..COMPONENTS {
            let ratio = in_tolerances(errors[i], self.0[i], steps.y[i], steps.new[i]);
            total += ratio * ratio;
        }
        total
    }

    #[inline(always)]
    fn mean_square(&self, steps: &Steps<'_, R>, errors: &LaneState<R>) -> R {
        self.square_sum(steps, errors) / R::splat(COMPONENTS as f64)
    }

    /// As `Stages::is_stiff`.
    #[inline(always)]
    fn is_stiff(&self, tableau: &Tableau, steps: &Steps<'_, R>) -> R::Mask {
        let (last, h) = (tableau.stages - 1, steps.h);
        let (mut of_rates, mut of_states) = ([R::ZERO; COMPONENTS], [R::ZERO; COMPONENTS]);
        for i in 0..COMPONENTS {
            of_rates[i] = steps.rates[last + 1][i] - steps.rates[last][i];
            of_states[i] = steps.new[i] - steps.argument[i];
        }
        let (rates, states) =
            (self.square_sum(steps, &of_rates), self.square_sum(steps, &of_states));
        let limit = R::splat(tableau.stability * tableau.stability) * states;
        R::ZERO.lt(states).and(limit.lt(h * h * rates))
    }
}

/// Σ wⱼ kⱼ, as `Stages` sums it.
#[inline(always)]
pub(super) fn weighted_sum<R: Real>(row: Row, k: &[LaneState<R>]) -> LaneState<R> {
    let mut total = [R::ZERO; COMPONENTS];
    for &(stage, weight) in row {
        let (k, weight) = (&k[stage], R::splat(weight));
        for i in 0..COMPONENTS {
            total[i] += weight * k[i];
        }
    }
    total
}

/// The numbers of the lanes.
#[inline(always)]
fn numbers<R: Real>(register: R) -> Numbers {
    let mut numbers = [0.0; LANES];
    for (lane, number) in numbers.iter_mut().enumerate().take(R::LANES) {
        *number = register.lane(lane);
    }
    numbers
}
