//! One stage of the Runge-Kutta method for the environments of a chunk, a register of these at a time.

use super::bodies::Partials;
use super::equation_batch::EquationBatch;
use super::evaluate::Equation;
use crate::batch::dispatch::Task;
use crate::dynamics::kinetostatics::positions::{DesignPositions, MachineBatch};
use crate::dynamics::reactions::lane_rows::Rows;
use crate::dynamics::reactions::scene::Scene;
use crate::math::lanes::{Mask, Real};
use crate::state::status::Status;

/// Greatest way of a driver from the start of a step to any stage (rad, or in sizes): a longer one skips
/// what is between.
pub(super) const LONGEST: f64 = 1.0;
/// The status where a load has no finite value, or no inertia resists a driver: `assur.Status.NO_VALUE`.
const NO_VALUE: u8 = 8;

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
    pub batch: &'e EquationBatch<'e>,
    pub design: DesignPositions<'e>,
    pub scene: &'e mut Scene<R>,
    pub equation: &'e mut Equation<R>,
    pub effort: &'e [f64],
    /// Speeds at this stage.
    pub speed: &'e [f64],
    pub arrays: &'e mut StageArrays,
    pub status: &'e mut [u8],
    pub dt: f64,
    /// 0 to 3.
    pub number: usize,
}

impl<R: Real> Task<R> for Stage<'_, R> {
    #[inline(always)]
    fn run(&mut self) {
        let MachineBatch { plan, machine, sources, .. } = &self.batch.positions;
        let solved = &{ self.design.solved };
        let count = solved.positions;
        self.scene.place_known(self.design.known);
        for first in (0..count).step_by(R::LANES) {
            let rows = Rows { first, last: count - 1 };
            let partials = Partials { plan, sources, solved, rows, drivers: plan.drivers };
            self.scene.numbers.read(machine, self.design.values.varied, rows);
            self.equation.read_bodies(self.batch, self.scene, partials, self.speed);
            if !plan.load_actions.is_empty() {
                self.scene.read(plan, sources, self.design.guides, solved, rows);
                self.scene.clear_forces();
                self.scene.apply_loads(plan, machine, self.design.values, rows);
                self.equation.add_forces(self.scene, partials);
            }
            self.equation.accelerate(self.effort, rows);
            self.advance(rows, R::LANES.min(count - first));
        }
    }
}

impl<R: Real> Stage<'_, R> {
    /// Adds the slopes of this stage, and finds the state at the next one.
    #[inline(always)]
    fn advance(&mut self, rows: Rows, lanes: usize) {
        let n = self.batch.positions.plan.drivers;
        let whole = R::splat(self.dt);
        // Way to the next stage, and the weight of this one.
        let (way, weight) = match self.number {
            0 => (whole * R::splat(0.5), R::ONE),
            1 => (whole * R::splat(0.5), R::splat(2.0)),
            2 => (whole, R::splat(2.0)),
            _ => (whole / R::splat(6.0), R::ONE),
        };
        for driver in 0..n {
            let read = |values: &[f64]| rows.read::<R>(values, n, driver);
            let (speed, acceleration) = (read(self.speed), self.equation.solution(driver));
            let (mut slope_q, mut slope_speed) = (speed, acceleration);
            if self.number > 0 {
                let sums = (read(&self.arrays.sum_q), read(&self.arrays.sum_speed));
                slope_q = sums.0 + weight * slope_q;
                slope_speed = sums.1 + weight * slope_speed;
            }
            let last = self.number == 3;
            let toward = if last { (slope_q, slope_speed) } else { (speed, acceleration) };
            let start_q = read(&self.arrays.q);
            let next_q = start_q + way * toward.0;
            let next_speed = read(&self.arrays.speed) + way * toward.1;
            let longest = match self.batch.positions.plan.driven_links[driver] {
                Some(_) => LONGEST,
                None => LONGEST * self.design.size,
            };
            let gone = (next_q - start_q).abs();
            let is_fine = gone.le(R::splat(longest)).and(next_speed.finite());
            if !is_fine.all() {
                self.note_failures(rows.first, lanes, next_speed, is_fine);
            }
            let now = rows.first * n..(rows.first + lanes) * n;
            for (values, number) in [
                (&mut self.arrays.sum_q, slope_q),
                (&mut self.arrays.sum_speed, slope_speed),
                (&mut self.arrays.next_q, next_q),
                (&mut self.arrays.next_speed, next_speed),
            ] {
                write_driver(&mut values[now.clone()], n, driver, number);
            }
        }
    }

    /// Notes why environments have no next stage: they go too far, or have no acceleration.
    #[inline(always)]
    fn note_failures(&mut self, first: usize, lanes: usize, next_speed: R, is_fine: R::Mask) {
        for lane in (0..lanes).filter(|&lane| !is_fine.lane(lane)) {
            let row = first + lane;
            let now = if next_speed.lane(lane).is_finite() {
                Status::BadInput as u8
            } else if self.design.status[row] == Status::Singular as u8 {
                Status::Singular as u8
            } else {
                NO_VALUE
            };
            note(&mut self.status[row], now);
        }
    }
}

/// Writes the number of a driver at each position, drivers fastest.
#[inline(always)]
fn write_driver<R: Real>(values: &mut [f64], n: usize, driver: usize, number: R) {
    // Widths known to the compiler are written by few instructions.
    if n == 1 && values.len() == R::LANES {
        for lane in 0..R::LANES {
            values[lane] = number.lane(lane);
        }
    } else if n == 2 && values.len() == 2 * R::LANES {
        for lane in 0..R::LANES {
            values[2 * lane + driver] = number.lane(lane);
        }
    } else {
        for (lane, values) in values.chunks_exact_mut(n).enumerate() {
            values[driver] = number.lane(lane);
        }
    }
}

fn has_failed(status: u8) -> bool {
    status > Status::NearSingular as u8
}

/// Whether an environment has failed.
fn some_failed(status: &[u8]) -> bool {
    // No search that stops at the first: this reads them by vectors.
    status.iter().fold(false, |failed, &status| failed | has_failed(status))
}

/// Keeps the worst status; of failures the first, which causes the others.
pub(super) fn note(status: &mut u8, now: u8) {
    if *status <= Status::NearSingular as u8 {
        *status = now.max(*status);
    }
}
