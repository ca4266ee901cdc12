//! One stage of an embedded pair for the environments underway, a register of these at a time.

use super::failures::{longest_way, note, some_failed, without_acceleration};
use super::lane_accelerations::LaneAccelerations;
use super::states::States;
use crate::batch::dispatch::Task;
use crate::dynamics::reactions::lane_rows::Rows;
use crate::math::lanes::{Mask, Real};
use crate::ode::pair::estimate::in_tolerances;
use crate::ode::pair::tableau::{Row, Tableau};
use crate::state::status::Status;

/// How far the drivers of a design may go in a step, and how accurately.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds<'e> {
    pub driven_links: &'e [Option<usize>],
    /// The size of the design, m.
    pub size: f64,
    /// Absolute tolerances of the coordinates.
    pub tolerances: &'e [f64],
    /// Relative tolerance of the speeds.
    pub relative: f64,
}

/// Finds the states at the first stage after the start.
pub(super) struct FirstStage<'e> {
    pub states: &'e mut States,
    pub bounds: Bounds<'e>,
    pub pair: &'static Tableau,
}

impl<R: Real> Task<R> for FirstStage<'_> {
    #[inline(always)]
    fn run(&mut self) {
        let count = self.states.h.len();
        for first in (0..count).step_by(R::LANES) {
            let rows = Rows { first, last: count - 1 };
            self.states.go_on::<R>(rows, self.pair.a[1], self.bounds);
        }
    }
}

/// Finds the rates of a stage, and the states at the next one or, after the last, the errors.
pub(super) struct ControlledStage<'e, R: Real> {
    pub accelerations: LaneAccelerations<'e, R>,
    pub states: &'e mut States,
    pub bounds: Bounds<'e>,
    pub pair: &'static Tableau,
    /// 0 is the start of the first step, `pair.stages` the end of a step.
    pub number: usize,
}

impl<R: Real> Task<R> for ControlledStage<'_, R> {
    #[inline(always)]
    fn run(&mut self) {
        let count = self.accelerations.begin();
        for first in (0..count).step_by(R::LANES) {
            let rows = Rows { first, last: count - 1 };
            self.accelerations.find(rows);
            self.keep_rates(rows);
            if self.number == self.pair.stages {
                let ends = [self.accelerations.design.q, self.accelerations.design.solved.speed];
                self.states.estimate::<R>(rows, ends, self.pair, self.bounds);
            } else if self.number > 0 {
                self.states.go_on::<R>(rows, self.pair.a[self.number + 1], self.bounds);
            }
        }
    }
}

impl<R: Real> ControlledStage<'_, R> {
    #[inline(always)]
    fn keep_rates(&mut self, rows: Rows) {
        let LaneAccelerations { design, equation, .. } = &self.accelerations;
        let n = self.bounds.driven_links.len();
        let States { speed: start, rates, status, turns, .. } = &mut *self.states;
        let [rates_q, rates_speed] = &mut rates[self.number];
        for driver in 0..n {
            let acceleration: R = equation.solution(driver);
            let speed = rows.read::<R>(design.solved.speed, n, driver);
            rows.write(rates_q, n, driver, speed);
            rows.write(rates_speed, n, driver, acceleration);
            if self.number > 0 {
                turns.note_speed(rows, speed, rows.read(start, n, driver));
                turns.note_inertia(rows, driver, || equation.inertia(driver), self.number == 1);
            }
            let is_known = acceleration.finite();
            if !is_known.all() {
                let all = status.iter_mut().zip(design.status).skip(rows.first);
                for (lane, (status, &position)) in all.take(R::LANES).enumerate() {
                    if !is_known.lane(lane) {
                        note(status, without_acceleration(position));
                    }
                }
            }
        }
    }
}

impl States {
    /// Finds the states at a stage, y + h Σ wⱼ kⱼ. Environments whose step cannot be made stay at its start,
    /// which exists.
    #[inline(always)]
    fn go_on<R: Real>(&mut self, rows: Rows, weights: Row, bounds: Bounds<'_>) {
        let n = bounds.driven_links.len();
        let h = rows.read::<R>(&self.h, 1, 0);
        let mut is_fine = R::Mask::NONE.not();
        for driver in 0..n {
            let [mut rate_q, mut rate_speed] = [R::ZERO; 2];
            for &(stage, weight) in weights {
                let [q, speed] = &self.rates[stage];
                let weight = R::splat(weight);
                rate_q += weight * rows.read::<R>(q, n, driver);
                rate_speed += weight * rows.read::<R>(speed, n, driver);
            }
            let start = rows.read::<R>(&self.q, n, driver);
            let q = start + h * rate_q;
            let speed = rows.read::<R>(&self.speed, n, driver) + h * rate_speed;
            let longest = R::splat(longest_way(bounds.driven_links, driver, bounds.size));
            is_fine = is_fine.and((q - start).abs().le(longest)).and(speed.finite());
            rows.write(&mut self.stage_q, n, driver, q);
            rows.write(&mut self.stage_speed, n, driver, speed);
        }
        let last = (rows.first + R::LANES - 1).min(rows.last);
        let status = &mut self.status[rows.first..=last];
        if is_fine.all() && !some_failed(status) {
            return;
        }
        for (lane, status) in status.iter_mut().enumerate() {
            if !is_fine.lane(lane) {
                note(status, Status::BadInput as u8);
            }
            if some_failed(&[*status]) {
                let range = (rows.first + lane) * n..(rows.first + lane + 1) * n;
                self.stage_q[range.clone()].copy_from_slice(&self.q[range.clone()]);
                self.stage_speed[range.clone()].copy_from_slice(&self.speed[range]);
            }
        }
    }

    /// Finds the mean squares of the error estimates of a unit step, in tolerances.
    #[inline(always)]
    fn estimate<R: Real>(
        &mut self,
        rows: Rows,
        ends: [&[f64]; 2],
        pair: &Tableau,
        bounds: Bounds<'_>,
    ) {
        let n = bounds.driven_links.len();
        let relative = [R::ZERO, R::splat(bounds.relative)];
        let mut sums = [R::ZERO; 2];
        for driver in 0..n {
            let absolute = [
                R::splat(bounds.tolerances[driver]),
                rows.read::<R>(&self.speed_tolerance, n, driver),
            ];
            let starts = [&self.q, &self.speed];
            for part in 0..2 {
                let start = rows.read::<R>(starts[part], n, driver);
                let end = rows.read::<R>(ends[part], n, driver);
                let rows_of_weights = [Some(pair.error), pair.coarse_error];
                for (sum, weights) in sums.iter_mut().zip(rows_of_weights) {
                    let mut error = R::ZERO;
                    for &(stage, weight) in weights.unwrap_or_default() {
                        let rate = rows.read::<R>(&self.rates[stage][part], n, driver);
                        error += R::splat(weight) * rate;
                    }
                    let ratio = in_tolerances(error, [absolute[part], relative[part]], start, end);
                    *sum += ratio * ratio;
                }
            }
        }
        let components = R::splat(2.0 * n as f64);
        rows.write(&mut self.fine, 1, 0, sums[0] / components);
        rows.write(&mut self.coarse, 1, 0, sums[1] / components);
    }
}
