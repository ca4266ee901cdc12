//! One stage of the Runge-Kutta method for the environments of a chunk, a register of these at a time.

use super::dead_points::Attempted;
use super::failures::{has_failed, longest_way, note, some_failed, without_acceleration};
use super::lane_accelerations::LaneAccelerations;
use super::turns::Turns;
use crate::batch::dispatch::Task;
use crate::dynamics::reactions::lane_rows::Rows;
use crate::math::lanes::{Mask, Real};
use crate::state::status::Status;

/// The states of environments in a step, drivers fastest.
#[derive(Debug, Default)]
pub(super) struct StageArrays {
    /// At the start of the step.
    pub q: Vec<f64>,
    pub speed: Vec<f64>,
    /// At the present stage.
    stage_q: Vec<f64>,
    stage_speed: Vec<f64>,
    /// At the next stage.
    next_q: Vec<f64>,
    next_speed: Vec<f64>,
    /// Weighted sums of speeds and accelerations of the stages so far.
    sum_q: Vec<f64>,
    sum_speed: Vec<f64>,
    /// The last states that are known to exist.
    good_q: Vec<f64>,
    good_speed: Vec<f64>,
    /// What the stages of the step show of drivers that turn back.
    pub turns: Turns,
}

impl StageArrays {
    /// Begins with these states.
    pub(super) fn start(&mut self, q: &[f64], speed: &[f64]) {
        for (array, values) in [
            (&mut self.q, q),
            (&mut self.speed, speed),
            (&mut self.stage_q, q),
            (&mut self.stage_speed, speed),
            (&mut self.next_q, q),
            (&mut self.next_speed, speed),
            (&mut self.sum_q, q),
            (&mut self.sum_speed, speed),
            (&mut self.good_q, q),
            (&mut self.good_speed, speed),
        ] {
            array.clear();
            array.extend_from_slice(values);
        }
    }

    /// The state at the present stage, while the next is computed.
    pub(super) fn take_stage(&mut self) -> [Vec<f64>; 2] {
        [std::mem::take(&mut self.stage_q), std::mem::take(&mut self.stage_speed)]
    }

    /// Goes on to the next stage; takes the memory of the present one back.
    pub(super) fn go_on(&mut self, [q, speed]: [Vec<f64>; 2]) {
        self.stage_q = std::mem::replace(&mut self.next_q, q);
        self.stage_speed = std::mem::replace(&mut self.next_speed, speed);
    }

    /// Takes the present stage back, which has no next one.
    pub(super) fn put_back(&mut self, [q, speed]: [Vec<f64>; 2]) {
        (self.stage_q, self.stage_speed) = (q, speed);
    }

    /// Keeps the states of the environments that have not failed.
    pub(super) fn keep_good(&mut self, q: &[f64], speed: &[f64], status: &[u8]) {
        if !some_failed(status) {
            self.good_q.copy_from_slice(q);
            self.good_speed.copy_from_slice(speed);
            return;
        }
        let n = q.len() / status.len().max(1);
        for (row, &status) in status.iter().enumerate() {
            if !has_failed(status) {
                let range = row * n..(row + 1) * n;
                self.good_q[range.clone()].copy_from_slice(&q[range.clone()]);
                self.good_speed[range.clone()].copy_from_slice(&speed[range]);
            }
        }
    }

    /// The states at the end: of environments that have failed the last ones that exist.
    pub(super) fn last_states(&self, failed: bool) -> [&[f64]; 2] {
        if failed { [&self.good_q, &self.good_speed] } else { [&self.q, &self.speed] }
    }

    /// The step that ends at the present stage.
    pub(super) fn attempted<'a>(&'a self, h: &'a f64) -> Attempted<'a> {
        Attempted {
            start: [&self.q, &self.speed],
            end: [&self.stage_q, &self.stage_speed],
            h: std::slice::from_ref(h),
            tolerance: None,
        }
    }

    /// Begins the next step where the last stage ended; environments that have failed stay where they
    /// were.
    pub(super) fn finish_step(&mut self, status: &[u8], n: usize) {
        if !some_failed(status) {
            self.q.copy_from_slice(&self.stage_q);
            self.speed.copy_from_slice(&self.stage_speed);
            return;
        }
        for (row, &status) in status.iter().enumerate() {
            let range = row * n..(row + 1) * n;
            if has_failed(status) {
                self.stage_q[range.clone()].copy_from_slice(&self.good_q[range.clone()]);
                self.stage_speed[range].fill(0.0);
            } else {
                self.q[range.clone()].copy_from_slice(&self.stage_q[range.clone()]);
                self.speed[range.clone()].copy_from_slice(&self.stage_speed[range]);
            }
        }
    }
}

/// The stage of the environments of a chunk.
pub(super) struct Stage<'e, R: Real> {
    pub accelerations: LaneAccelerations<'e, R>,
    pub arrays: &'e mut StageArrays,
    pub status: &'e mut [u8],
    pub dt: f64,
    /// 0 to 3.
    pub number: usize,
}

impl<R: Real> Task<R> for Stage<'_, R> {
    #[inline(always)]
    fn run(&mut self) {
        let count = self.accelerations.begin();
        for first in (0..count).step_by(R::LANES) {
            let rows = Rows { first, last: count - 1 };
            self.accelerations.find(rows);
            self.advance(rows);
        }
    }
}

impl<R: Real> Stage<'_, R> {
    /// Adds the slopes of this stage, and finds the state at the next one.
    #[inline(always)]
    fn advance(&mut self, rows: Rows) {
        let drivers = self.accelerations.batch.positions.plan.drivers;
        if drivers == 2 {
            self.advance_drivers::<2>(rows, 0, 2);
            return;
        }
        for driver in 0..drivers {
            self.advance_drivers::<1>(rows, driver, drivers);
        }
    }

    /// The same for `N` of `n` drivers.
    #[inline(always)]
    fn advance_drivers<const N: usize>(&mut self, rows: Rows, first: usize, n: usize) {
        let LaneAccelerations { batch, design, equation, .. } = &self.accelerations;
        let plan = batch.positions.plan;
        let size = design.size;
        let whole = R::splat(self.dt);
        // Way to the next stage, and the weight of this one.
        let (way, weight) = match self.number {
            0 => (whole * R::splat(0.5), R::ONE),
            1 => (whole * R::splat(0.5), R::splat(2.0)),
            2 => (whole, R::splat(2.0)),
            _ => (whole / R::splat(6.0), R::ONE),
        };
        let [mut sum_q, mut sum_speed, mut next_q, mut next_speed] = [[R::ZERO; N]; 4];
        for i in 0..N {
            let driver = first + i;
            let read = |values: &[f64]| rows.read::<R>(values, n, driver);
            let (speed, acceleration) = (read(design.solved.speed), equation.solution(driver));
            let (mut slope_q, mut slope_speed) = (speed, acceleration);
            if self.number > 0 {
                let sums = (read(&self.arrays.sum_q), read(&self.arrays.sum_speed));
                slope_q = sums.0 + weight * slope_q;
                slope_speed = sums.1 + weight * slope_speed;
            }
            let last = self.number == 3;
            let toward = if last { (slope_q, slope_speed) } else { (speed, acceleration) };
            let start_q = read(&self.arrays.q);
            next_q[i] = start_q + way * toward.0;
            let start_speed = read(&self.arrays.speed);
            next_speed[i] = start_speed + way * toward.1;
            (sum_q[i], sum_speed[i]) = (slope_q, slope_speed);
            let turns = &mut self.arrays.turns;
            turns.note_speed(rows, next_speed[i], start_speed);
            turns.note_inertia(rows, driver, || equation.inertia(driver), self.number == 0);
            let longest = longest_way(&plan.driven_links, driver, size);
            let gone = (next_q[i] - start_q).abs();
            let is_fine = gone.le(R::splat(longest)).and(next_speed[i].finite());
            if !is_fine.all() {
                let lanes = R::LANES.min(rows.last + 1 - rows.first);
                let status = &mut self.status[rows.first..rows.first + lanes];
                note_failures(status, &design.status[rows.first..], next_speed[i], is_fine);
            }
        }
        for (values, numbers) in [
            (&mut self.arrays.sum_q, sum_q),
            (&mut self.arrays.sum_speed, sum_speed),
            (&mut self.arrays.next_q, next_q),
            (&mut self.arrays.next_speed, next_speed),
        ] {
            rows.write_some(values, n, first, numbers);
        }
    }
}

/// Notes why environments, at positions with statuses, have no next stage: they go too far, or have no
/// acceleration.
#[inline(always)]
fn note_failures<R: Real>(status: &mut [u8], positions: &[u8], next_speed: R, is_fine: R::Mask) {
    for (lane, (status, &position)) in status.iter_mut().zip(positions).enumerate() {
        if is_fine.lane(lane) {
            continue;
        }
        let goes_too_far = next_speed.lane(lane).is_finite();
        let now =
            if goes_too_far { Status::BadInput as u8 } else { without_acceleration(position) };
        note(status, now);
    }
}
