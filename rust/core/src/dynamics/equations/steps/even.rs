//! Even steps by the classical Runge-Kutta method of order 4 (W. Kutta 1901).

use super::dead_points::DeadPoints;
use super::even_stage::{Stage, StageArrays};
use super::failures::{has_failed, longest_way, note, note_positions};
use super::lane_accelerations::LaneAccelerations;
use super::step_batch::{StepBatch, StepWorker};
use crate::batch::dispatch::Entry;
use crate::batch::motion::Asked;
use crate::dynamics::equations::equation_batch::EquationBatch;
use crate::dynamics::kinetostatics::positions::{DesignPositions, of_rows};
use crate::state::status::Status;

/// Stages of a step; one more shows whether the last state exists.
const STAGES: usize = 4;

/// The environments of a design in a chunk.
#[derive(Debug, Default)]
pub(super) struct EvenSteps {
    pub arrays: StageArrays,
    pub status: Vec<u8>,
    /// Those whose drivers may turn back in the step.
    suspects: Vec<usize>,
    dead_points: DeadPoints,
    /// The size of the design.
    size: f64,
}

impl EvenSteps {
    /// Makes all steps; false if the work was cancelled.
    pub(super) fn run<'b, L: Entry, const G: usize>(
        &mut self,
        batch: &StepBatch<'b>,
        worker: &mut StepWorker<'b, L::Register, G>,
        mut asked: Asked<'_>,
    ) -> bool {
        let n = batch.drivers();
        let range = asked.rows.start * n..asked.rows.end * n;
        self.arrays.start(&batch.request.q[range.clone()], &batch.request.speed[range]);
        self.status.clear();
        self.status.resize(asked.rows.len(), Status::Ok as u8);
        let binds_again = batch.binds_again();
        for _ in 0..batch.request.steps {
            if batch.is_cancelled() {
                return false;
            }
            self.arrays.turns.start(self.status.len(), n);
            for stage in 0..STAGES {
                if !self.stage::<L, G>(batch, worker, &asked, stage) {
                    self.status.fill(Status::BadDimension as u8);
                    return true;
                }
                asked.binds = binds_again;
            }
            self.refuse_dead_points::<L, G>(batch, worker, &asked);
            self.arrays.finish_step(&self.status, n);
        }
        // The last state must exist, too.
        if self.stage::<L, G>(batch, worker, &asked, STAGES) {
            self.arrays.finish_step(&self.status, n);
        }
        true
    }

    /// Marks the environments whose step leads over a dead point.
    fn refuse_dead_points<'b, L: Entry, const G: usize>(
        &mut self,
        batch: &StepBatch<'b>,
        worker: &mut StepWorker<'b, L::Register, G>,
        asked: &Asked<'_>,
    ) {
        let Self { arrays, status, suspects, dead_points, size } = self;
        if !arrays.turns.some_may_turn_back() {
            return;
        }
        let may_end =
            |&index: &usize| arrays.turns.may_turn_back(index) && !has_failed(status[index]);
        suspects.clear();
        suspects.extend((0..status.len()).filter(may_end));
        let steps = arrays.attempted(&batch.request.dt);
        dead_points.note::<L, G>((batch, worker), (asked, *size), (suspects, steps), status);
    }

    /// Computes one stage of a step; false if the design has invalid dimensions.
    fn stage<'b, L: Entry, const G: usize>(
        &mut self,
        batch: &StepBatch<'b>,
        worker: &mut StepWorker<'b, L::Register, G>,
        asked: &Asked<'_>,
        stage: usize,
    ) -> bool {
        let StepWorker { positions, scene, equation, efforts } = worker;
        let Self { arrays, status, size, .. } = self;
        let (request, equations) = (batch.request, &batch.equations);
        let [q, speed] = arrays.take_stage();
        let stage_asked = Asked { q: &q, rows: asked.rows.clone(), ..*asked };
        let is_valid = equations.positions.solve_design::<L, G>(
            positions,
            &stage_asked,
            &speed,
            &mut |design: DesignPositions<'_>| {
                *size = design.size;
                if stage == 0 {
                    refuse_long_steps(&speed, request.dt, (design.size, equations), status);
                }
                note_positions(status, design.status);
                if stage == 0 {
                    arrays.keep_good(&q, &speed, status);
                }
                if stage == STAGES {
                    return;
                }
                let effort = of_rows(request.effort, batch.drivers(), &design.rows);
                let count = design.status.len();
                let effort = batch.efforts(&design.values, [&speed, effort], count, efforts);
                let mut task = Stage {
                    accelerations: LaneAccelerations {
                        batch: equations,
                        design,
                        scene: &mut *scene,
                        equation: &mut *equation,
                        effort,
                    },
                    arrays: &mut *arrays,
                    status: &mut *status,
                    dt: request.dt,
                    number: stage,
                };
                L::call(&mut task);
            },
        );
        if stage == STAGES {
            arrays.put_back([q, speed]);
        } else {
            arrays.go_on([q, speed]);
        }
        is_valid
    }
}

/// Marks the environments whose drivers would go too far in one step.
fn refuse_long_steps(
    speed: &[f64],
    dt: f64,
    (size, batch): (f64, &EquationBatch<'_>),
    status: &mut [u8],
) {
    let links = &batch.positions.plan.driven_links;
    for (speeds, status) in speed.chunks_exact(links.len()).zip(status) {
        for (driver, speed) in speeds.iter().enumerate() {
            // NaN is too long, too.
            let is_short = (speed * dt).abs() <= longest_way(links, driver, size);
            if !is_short {
                note(status, Status::BadInput as u8);
            }
        }
    }
}
