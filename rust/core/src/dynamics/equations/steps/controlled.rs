//! Steps with error control by embedded pairs: each environment has its own time and step widths, and those
//! that have arrived, or cannot go on, leave the others.

use super::controlled_stage::{Bounds, ControlledStage, FirstStage};
use super::dead_points::{Attempted, DeadPoints};
use super::environment::{Environment, Span};
use super::failures::{has_failed, longest_way, note, note_positions};
use super::lane_accelerations::LaneAccelerations;
use super::states::States;
use super::step_batch::{StepBatch, StepWorker};
use crate::batch::dispatch::Entry;
use crate::batch::motion::Asked;
use crate::dynamics::driver_scales::{sizes_of, small_speeds};
use crate::dynamics::kinetostatics::positions::{DesignPositions, of_rows};
use crate::dynamics::reactions::applied::Values;
use crate::dynamics::variation::Varied;
use crate::ode::Method;
use crate::ode::pair::tableau::Tableau;
use crate::state::status::Status;

/// Part of the greatest way of a driver that its speed alone may take it in a step: accelerations have the rest.
const WAY_BY_SPEED: f64 = 0.9;

/// Relative tolerance of the speeds, and absolute ones of coordinates and speeds.
type Tolerances = (f64, Option<[f64; 2]>);

/// The environments of a design in a chunk.
#[derive(Debug, Default)]
pub(super) struct ControlledSteps {
    /// The last states of all of them.
    pub q: Vec<f64>,
    pub speed: Vec<f64>,
    pub status: Vec<u8>,
    underway: Vec<Environment>,
    states: States,
    /// Those that stay underway, or may turn back at a dead point.
    kept: Vec<usize>,
    dead_points: DeadPoints,
    /// The design's size, and those that the tolerances of its drivers are relative to.
    size: f64,
    sizes: Vec<f64>,
    /// Absolute tolerances of the coordinates.
    tolerances: Vec<f64>,
    relative: f64,
}

impl ControlledSteps {
    /// Makes all steps; false if the work was cancelled.
    pub(super) fn run<'b, L: Entry, const G: usize>(
        &mut self,
        batch: &StepBatch<'b>,
        worker: &mut StepWorker<'b, L::Register, G>,
        mut asked: Asked<'_>,
        (method, tolerances): (Method, Tolerances),
    ) -> bool {
        let pair = method.tableau();
        let span = Span::new(batch.request.dt, batch.request.steps);
        self.start(batch, &asked, &span, pair);
        if !self.stage::<L, G>(batch, worker, &asked, (pair, 0), &span) {
            self.status.fill(Status::BadDimension as u8);
            return true;
        }
        asked.binds = batch.binds_again();
        self.set_tolerances(tolerances, span.duration());
        self.leave(batch, &span, |steps, index| !steps.take_status(index));
        while !self.underway.is_empty() {
            if batch.is_cancelled() {
                return false;
            }
            let links = &batch.equations.positions.plan.driven_links;
            let Self { states, size, tolerances, relative, .. } = self;
            let bounds =
                Bounds { driven_links: links, size: *size, tolerances, relative: *relative };
            L::call(&mut FirstStage { states, bounds, pair });
            for number in 1..=pair.stages {
                self.stage::<L, G>(batch, worker, &asked, (pair, number), &span);
            }
            self.refuse_dead_points::<L, G>(batch, worker, &asked);
            self.leave(batch, &span, |steps, index| steps.conclude(index, &span, pair));
        }
        true
    }

    /// Begins with the states of the request.
    fn start(&mut self, batch: &StepBatch<'_>, asked: &Asked<'_>, span: &Span, pair: &Tableau) {
        let (n, rows, request) = (batch.drivers(), &asked.rows, batch.request);
        let range = rows.start * n..rows.end * n;
        let states = [&request.q[range.clone()], &request.speed[range]];
        for (array, values) in [&mut self.q, &mut self.speed].into_iter().zip(states) {
            array.clear();
            array.extend_from_slice(values);
        }
        self.status.clear();
        self.status.resize(rows.len(), Status::Ok as u8);
        self.underway.clear();
        self.underway.extend((0..rows.len()).map(|row| Environment::new(row, span, pair)));
        self.states.start(states, pair.stages + 1, n);
        self.states.effort.clear();
        self.states.effort.extend_from_slice(of_rows(request.effort, n, rows));
        let shape = batch.equations.positions.motion.shape;
        self.states.varied.resize_with(request.variations.len(), Vec::new);
        for (variation, values) in request.variations.iter().zip(&mut self.states.varied) {
            variation.at_rows(rows, shape.designs * shape.positions, values);
        }
    }

    /// Sets the tolerances, those that are not given by the rates at the start.
    fn set_tolerances(&mut self, (relative, absolute): Tolerances, duration: f64) {
        self.relative = relative;
        self.tolerances.clear();
        let States { speed, rates, speed_tolerance, .. } = &mut self.states;
        if let Some([of_q, of_speed]) = absolute {
            self.tolerances.resize(self.sizes.len(), of_q);
            speed_tolerance.fill(of_speed);
            return;
        }
        self.tolerances.extend(self.sizes.iter().map(|size| relative * size));
        let Some([_, accelerations]) = rates.first() else { return };
        let n = self.sizes.len();
        let each = speed.chunks_exact(n).zip(accelerations.chunks_exact(n));
        for ((speed, acceleration), out) in each.zip(speed_tolerance.chunks_exact_mut(n)) {
            small_speeds([speed, acceleration], &self.sizes, duration, out);
            for out in out {
                *out *= relative;
            }
        }
    }

    /// Finds one stage of the attempted steps; false if the design has invalid dimensions.
    fn stage<'b, L: Entry, const G: usize>(
        &mut self,
        batch: &StepBatch<'b>,
        worker: &mut StepWorker<'b, L::Register, G>,
        asked: &Asked<'_>,
        (pair, number): (&'static Tableau, usize),
        span: &Span,
    ) -> bool {
        let StepWorker { positions, scene, equation, efforts } = worker;
        let Self { states, size, sizes, tolerances, relative, .. } = self;
        let equations = &batch.equations;
        let driven_links = &equations.positions.plan.driven_links;
        // While the next states are written.
        let q = std::mem::take(&mut states.stage_q);
        let speed = std::mem::take(&mut states.stage_speed);
        let effort = std::mem::take(&mut states.effort);
        let varied = std::mem::take(&mut states.varied);
        if number < pair.stages {
            states.stage_q.resize(q.len(), 0.0);
            states.stage_speed.resize(q.len(), 0.0);
        }
        let count = states.h.len();
        let rows = asked.rows.start..asked.rows.start + count;
        let stage_asked = Asked { q: &q, rows, ..*asked };
        let is_valid = equations.positions.solve_design::<L, G>(
            positions,
            &stage_asked,
            &speed,
            &mut |design: DesignPositions<'_>| {
                if number == 0 {
                    *size = design.size;
                    *sizes = sizes_of(batch.mechanism(), design.dimensions);
                    refuse_fast(&speed, driven_links, (*size, span), &mut states.status);
                }
                note_positions(&mut states.status, design.status);
                // Of the environments underway, which are not those of the rows.
                let varied = Varied { rows: &varied, ..design.values.varied };
                let values = Values { varied, ..design.values };
                let effort = batch.efforts(&values, [&speed, &effort], count, efforts);
                let mut task = ControlledStage {
                    accelerations: LaneAccelerations {
                        batch: equations,
                        design: DesignPositions { values, ..design },
                        scene: &mut *scene,
                        equation: &mut *equation,
                        effort,
                    },
                    states: &mut *states,
                    bounds: Bounds { driven_links, size: *size, tolerances, relative: *relative },
                    pair,
                    number,
                };
                L::call(&mut task);
            },
        );
        (states.effort, states.varied) = (effort, varied);
        if number == pair.stages {
            (states.stage_q, states.stage_speed) = (q, speed);
        }
        is_valid
    }

    /// Refuses the attempted steps that lead over a dead point.
    fn refuse_dead_points<'b, L: Entry, const G: usize>(
        &mut self,
        batch: &StepBatch<'b>,
        worker: &mut StepWorker<'b, L::Register, G>,
        asked: &Asked<'_>,
    ) {
        let Self { states, kept, dead_points, underway, size, relative, .. } = self;
        let States { q, speed, stage_q, stage_speed, h, status, turns, .. } = states;
        let may_end = |&index: &usize| {
            let may_end = underway[index].is_near_an_end() || turns.may_turn_back(index);
            may_end && !has_failed(status[index])
        };
        kept.clear();
        kept.extend((0..h.len()).filter(may_end));
        let steps = Attempted {
            start: [q, speed],
            end: [stage_q, stage_speed],
            h,
            tolerance: Some(*relative),
        };
        dead_points.note::<L, G>((batch, worker), (asked, *size), (kept, steps), status);
    }

    /// Lets the environments leave that have ended, by `has_ended` or because they have no next step, and
    /// plans the next steps of the others.
    fn leave(
        &mut self,
        batch: &StepBatch<'_>,
        span: &Span,
        mut has_ended: impl FnMut(&mut Self, usize) -> bool,
    ) {
        let (n, links) = (batch.drivers(), &batch.equations.positions.plan.driven_links);
        self.kept.clear();
        for index in 0..self.underway.len() {
            if !has_ended(self, index) && self.plan(index, span, links) {
                self.kept.push(index);
            } else {
                let (from, to) = (index * n, self.underway[index].row * n);
                self.q[to..to + n].copy_from_slice(&self.states.q[from..from + n]);
                self.speed[to..to + n].copy_from_slice(&self.states.speed[from..from + n]);
            }
        }
        for (place, &index) in self.kept.iter().enumerate() {
            self.underway[place] = self.underway[index];
        }
        self.underway.truncate(self.kept.len());
        self.states.keep(&self.kept, n);
    }

    /// Notes the status of an environment's attempted step; returns whether it has not failed.
    fn take_status(&mut self, index: usize) -> bool {
        let status = self.states.status[index];
        note(&mut self.status[self.underway[index].row], status);
        !has_failed(status)
    }

    /// Concludes the attempted step of an environment; returns whether it has come to the end.
    fn conclude(&mut self, index: usize, span: &Span, pair: &Tableau) -> bool {
        let Self { states, underway, .. } = self;
        let environment = &mut underway[index];
        let errors = (states.fine[index], pair.coarse_error.map(|_| states.coarse[index]));
        if !environment.conclude(span, (states.h[index], states.status[index]), errors) {
            return false;
        }
        let has_arrived = environment.has_arrived(span);
        states.accept(index, self.sizes.len());
        self.take_status(index);
        has_arrived
    }

    /// Plans the next step of an environment; false if it has none.
    fn plan(&mut self, index: usize, span: &Span, links: &[Option<usize>]) -> bool {
        let speeds = &self.states.speed[index * links.len()..];
        let each = speeds.iter().take(links.len()).enumerate();
        let most = each.map(|(driver, &speed)| widest(links, driver, self.size, speed));
        match self.underway[index].plan(span, most.fold(f64::INFINITY, f64::min)) {
            Ok(h) => {
                self.states.h[index] = h;
                true
            }
            Err(status) => {
                note(&mut self.status[self.underway[index].row], status);
                false
            }
        }
    }
}

/// The widest step of a driver at some speed, for a design of some size.
fn widest(driven_links: &[Option<usize>], driver: usize, size: f64, speed: f64) -> f64 {
    WAY_BY_SPEED * longest_way(driven_links, driver, size) / speed.abs()
}

/// Marks the environments whose drivers are too fast for any step.
fn refuse_fast(
    speed: &[f64],
    driven_links: &[Option<usize>],
    (size, span): (f64, &Span),
    status: &mut [u8],
) {
    for (speeds, status) in speed.chunks_exact(driven_links.len()).zip(status) {
        for (driver, &speed) in speeds.iter().enumerate() {
            // NaN is too fast, too.
            let is_slow = span.allows(widest(driven_links, driver, size, speed));
            if !is_slow {
                note(status, Status::BadInput as u8);
            }
        }
    }
}
