//! The end of a step in every lane: the new state, its error, its continuous extension and its events. A lane
//! has the bits that `Stages`, `Interpolant` and `EventTracker` find for its run alone.

use super::event::SAMPLES;
use super::pair::dense::LEAST_ROWS;
use super::pair::stages::ABRUPT_FRACTION;
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
    error: Numbers,
    fine: Numbers,
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
    /// Finds the ends; returns the lanes with an error up to 1 and no event. The other lanes repeat the first.
    #[inline(always)]
    pub(super) fn find<R: Real, S: System>(
        &mut self,
        steps: &Steps<'_, R>,
        runs: &[Underway<'_, S>],
    ) -> R::Mask {
        let Some(first) = runs.first() else { return R::Mask::NONE };
        let Some(watched) = first.run.watched() else { return R::Mask::NONE };
        debug_assert!(
            runs.iter().all(|one| one.run.watched() == Some(watched)),
            "runs of one design"
        );
        let used = runs.len();
        let of = |lane: usize| if lane < used { lane } else { 0 };
        let tableau = first.run.stages().tableau;
        let scale = LaneScale::of(runs, steps);
        let abrupt_from = R::from_lanes(|lane| runs[of(lane)].run.stages().abrupt_from());
        let (error, fine) = scale.error(tableau, steps, abrupt_from);
        let is_stiff = scale.is_stiff(tableau, steps);
        self.set_rows(tableau, steps);
        let mut is_ordinary = error.le(R::ONE);
        for number in steps.new {
            is_ordinary = is_ordinary.and(number.finite());
        }
        if let Watched::Component(component) = watched {
            let sign = R::from_lanes(|lane| runs[of(lane)].run.first_event().0);
            let start = R::from_lanes(|lane| runs[of(lane)].run.first_event().1);
            let (is_quiet, magnitude) =
                self.keeps_sign(component, sign, start, steps.new[component]);
            is_ordinary = is_ordinary.and(is_quiet);
            self.magnitude = numbers(magnitude);
            self.event_value = numbers(steps.new[component]);
        }
        for i in 0..COMPONENTS {
            self.new[i] = numbers(steps.new[i]);
            self.rates[i] = numbers(steps.rates[tableau.stages][i]);
        }
        (self.error, self.fine) = (numbers(error), numbers(fine));
        self.is_stiff = is_stiff.bits();
        is_ordinary
    }

    /// Gives a run the end of its step.
    pub(super) fn give<S: System>(
        &self,
        lane: usize,
        Underway { run, planned, .. }: &mut Underway<'_, S>,
    ) {
        let ordinary = Ordinary {
            error: self.error[lane],
            is_stiff: self.is_stiff >> lane & 1 != 0,
            event_value: self.event_value[lane],
            magnitude: self.magnitude[lane],
        };
        let of = |list: &'_ [Numbers; COMPONENTS]| list.map(|numbers| numbers[lane]);
        let (new, rates) = (of(&self.new), of(&self.rates));
        run.give_end(planned.t_new, ordinary, self.fine[lane], [&new, &rates], |row, i| {
            self.rows[row][i][lane]
        });
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

/// What the square sums of errors divide by, in every lane.
struct LaneScale<R>(LaneState<R>);

impl<R: Real> LaneScale<R> {
    /// The tolerances at the greater of the states at both ends.
    #[inline(always)]
    fn of<S: System>(runs: &[Underway<'_, S>], steps: &Steps<'_, R>) -> Self {
        let used = runs.len();
        let of = |lane: usize| if lane < used { lane } else { 0 };
        let mut scale = [R::ZERO; COMPONENTS];
        for i in 0..COMPONENTS {
            let absolute = R::from_lanes(|lane| runs[of(lane)].run.tolerance(i)[0]);
            let relative = R::from_lanes(|lane| runs[of(lane)].run.tolerance(i)[1]);
            let greatest = steps.y[i].abs().max(steps.new[i].abs());
            scale[i] = (absolute + relative * greatest).max(R::splat(f64::MIN_POSITIVE));
        }
        Self(scale)
    }

    /// As `Scale::square_sum`.
    #[inline(always)]
    fn square_sum(&self, errors: &LaneState<R>) -> R {
        let mut total = R::ZERO;
        for i in 0..COMPONENTS {
            let ratio = errors[i] / self.0[i];
            total += ratio * ratio;
        }
        total
    }

    /// The mean square of weighted rates.
    #[inline(always)]
    fn mean_square(&self, row: Row, rates: &[LaneState<R>]) -> R {
        self.square_sum(&weighted_sum(row, rates)) / R::splat(COMPONENTS as f64)
    }

    /// The error and the fine estimate, as `Stages::error` finds them.
    #[inline(always)]
    fn error(&self, tableau: &Tableau, steps: &Steps<'_, R>, abrupt_from: R) -> (R, R) {
        let h = steps.h;
        let fine = self.mean_square(tableau.error, steps.rates);
        let error = match tableau.coarse_error {
            None => fine.sqrt(),
            Some(row) => {
                let coarse = self.mean_square(row, steps.rates);
                let error = fine / (fine + R::splat(0.01) * coarse).sqrt();
                R::select(R::ZERO.lt(fine), error, R::ZERO)
            }
        };
        let root = fine.sqrt();
        let kept = root / (h * h * h * h * h).abs();
        let at_least = error.max(R::splat(ABRUPT_FRACTION) * root);
        let error = R::select(abrupt_from.lt(kept), at_least, error);
        // NaN where it overflows: that lane is not ordinary.
        (error * h.abs(), kept)
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
        let (rates, states) = (self.square_sum(&of_rates), self.square_sum(&of_states));
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
