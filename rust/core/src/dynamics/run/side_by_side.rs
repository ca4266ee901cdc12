//! Runs of one design side by side: the stages of their steps are found in the lanes of registers. Each has
//! its own steps, events and end, and the bits that it has alone.

use std::fmt::Display;
use std::marker::PhantomData;
use std::ops::{ControlFlow, Range};
use std::sync::atomic::AtomicBool;

use super::callbacks::{Callbacks, UnlessCancelled};
use super::equation::Equation;
use super::integrate::{Prepared, conclude, prepare};
use super::lane_equation::{Configuration, LaneEquation};
use super::model::{MechanismModel, ReducedModel};
use super::options::RunOptions;
use super::run_batch::{Outcome, RunBatch};
use super::runner::RunTables;
use super::sample::Samples;
use super::system::RunSystem;
use super::variable::Variable;
use crate::batch::dispatch::{self, Entry, ForLevel, Task};
use crate::dynamics::driver_scales::sizes_of;
use crate::dynamics::machine::Machine;
use crate::math::lanes::{Mask, Real};
use crate::math::simd::Simd;
use crate::ode::error::Error;
use crate::ode::integrator::Integrator;
use crate::ode::lane_step::Underway;
use crate::ode::run::Plan;
use crate::ode::side_by_side::LaneSteps;
use crate::ode::solution::Solution;
use crate::ode::system::System;
use crate::plan::mechanism::Mechanism;

/// Runs that go on together: some end sooner, and the others still fill registers.
const TOGETHER: usize = 32;
/// Runs from which a register is quicker than each alone.
const WORTH_LANES: usize = 2;

impl Machine {
    /// Integrates a range of the runs of a batch without callbacks, in lanes where the machine allows it,
    /// and passes each on to `keep` with its index; see [`Machine::runs`]. It ends early once `cancel` is
    /// true.
    pub fn runs_side_by_side<E: Display>(
        &self,
        mechanism: &Mechanism,
        batch: &RunBatch<'_>,
        range: Range<usize>,
        (cancel, simd): (&AtomicBool, Simd),
        keep: &mut impl FnMut(usize, Outcome<E>) -> ControlFlow<()>,
    ) {
        let tables = RunTables::new(mechanism);
        for (design, of_design) in batch.by_designs(range) {
            let machine = &*self.of(batch.variations, design);
            let dimensions = batch.dimensions_of(design);
            let fits = of_design.len() >= WORTH_LANES
                && batch.limit.is_none()
                && batch.options.along == Variable::Time
                && batch.options.flywheel == 0.0
                && mechanism.q0().len() == 1
                && dimensions.len() == mechanism.dimensions().len()
                && mechanism.dimensions().first_fault(&dimensions).is_none();
            let model = || MechanismModel::new(machine, mechanism, &dimensions, &tables.0);
            let reference = fits.then(model);
            let work = SideBySide {
                machine,
                batch,
                runs: of_design.clone(),
                sizes: &sizes_of(mechanism, &dimensions),
                reference: reference.as_ref(),
                model: &model,
                cancel,
                keep,
                error: PhantomData,
            };
            let mut callbacks = UnlessCancelled::new(cancel);
            let done = dispatch::at_level(simd, work);
            let flow = done.unwrap_or_else(|| {
                let mut flow = ControlFlow::Continue(());
                self.runs(mechanism, batch, of_design, &mut callbacks, &mut |run, outcome| {
                    flow = keep(run, outcome);
                    flow
                });
                flow
            });
            if flow.is_break() {
                return;
            }
        }
    }
}

/// The runs of a design.
struct SideBySide<'b, 'm, M, K, E> {
    machine: &'m Machine,
    batch: &'b RunBatch<'b>,
    runs: Range<usize>,
    sizes: &'b [f64],
    /// The design's positions, if they may be found in lanes.
    reference: Option<&'b MechanismModel<'m>>,
    model: &'b M,
    cancel: &'b AtomicBool,
    keep: &'b mut K,
    error: PhantomData<fn() -> E>,
}

impl<'m, M, K, E> ForLevel for SideBySide<'_, 'm, M, K, E>
where
    M: Fn() -> MechanismModel<'m>,
    K: FnMut(usize, Outcome<E>) -> ControlFlow<()>,
    E: Display,
{
    /// `None` if the runs must be integrated one after another.
    type Output = Option<ControlFlow<()>>;

    fn run<L: Entry, const G: usize>(self) -> Self::Output {
        let mut lanes = Lanes::<L> {
            equation: LaneEquation::new(self.reference?)?,
            steps: LaneSteps::new(),
            total: L::Register::default(),
        };
        let count = self.runs.len().min(TOGETHER);
        let mut models: Vec<_> = (0..count).map(|_| (self.model)()).collect();
        let method = self.batch.options.method;
        let mut integrators: Vec<_> = (0..count).map(|_| Integrator::new(method, 3)).collect();
        let mut first = self.runs.start;
        while first < self.runs.end {
            let group = first..(first + TOGETHER).min(self.runs.end);
            let options: Vec<_> = group.clone().map(|run| self.batch.options_of(run)).collect();
            let outcomes = self.integrate(&mut lanes, &options, &mut models, &mut integrators);
            for (run, outcome) in group.clone().zip(outcomes) {
                if (self.keep)(run, outcome).is_break() {
                    return Some(ControlFlow::Break(()));
                }
            }
            first = group.end;
        }
        Some(ControlFlow::Continue(()))
    }
}

impl<'m, M, K, E: Display> SideBySide<'_, 'm, M, K, E> {
    /// Integrates a group of runs to their ends.
    fn integrate<L: Entry>(
        &self,
        lanes: &mut Lanes<'_, 'm, L>,
        options: &[RunOptions<'_>],
        models: &mut [MechanismModel<'m>],
        integrators: &mut [Integrator],
    ) -> Vec<Outcome<E>> {
        let Self { machine, cancel, sizes, .. } = *self;
        let (mut starts, mut systems, mut prepared) = (Vec::new(), Vec::new(), Vec::new());
        for (model, options) in models.iter_mut().zip(options) {
            model.restart();
            let callbacks = UnlessCancelled::<E>::new(cancel);
            let equation = Equation::new(model, callbacks, &machine.tables, &machine.motors, 1);
            let started = options
                .check(1, &machine.motors)
                .and_then(|()| prepare(equation, options, sizes))
                .map(|(system, needs)| {
                    systems.push(system);
                    prepared.push(needs);
                });
            starts.push(started);
        }
        let options_of_started = options.iter().zip(&starts).filter(|(_, started)| started.is_ok());
        let options_of_started: Vec<_> = options_of_started.map(|(options, _)| *options).collect();
        let solutions = lanes.solve(&mut systems, &prepared, &options_of_started, integrators);
        let mut concluded =
            systems.into_iter().zip(&prepared).zip(&options_of_started).zip(solutions).map(
                |(((system, needs), options), solution)| {
                    conclude(system, options, needs, solution, |samples| lanes.energies(samples))
                },
            );
        let mut outcomes = Vec::with_capacity(starts.len());
        for started in starts {
            match started {
                Ok(()) => outcomes.extend(concluded.next()),
                Err(error) => outcomes.push(Err(error)),
            }
        }
        outcomes
    }
}

/// The equation of motion in lanes, and the steps there.
struct Lanes<'d, 'm, L: Entry> {
    equation: LaneEquation<'d, 'm, L>,
    steps: LaneSteps<L::Register>,
    /// Kinetic and potential energy less work at the ends of the steps.
    total: L::Register,
}

/// The solution of a run, once it has one.
type Solved<S> = Option<Result<Solution, Error<<S as System>::Error>>>;

/// A system that takes what lanes have found.
trait InLane: System {
    /// Takes the configuration at the end of an accepted step, and the total energy there.
    fn take(&mut self, configuration: Configuration, total: f64);
    /// The total energy at the start of the step, and its relative tolerance.
    fn watched(&self) -> [f64; 2];
}

impl<S: ReducedModel, O: Callbacks> InLane for RunSystem<'_, S, O> {
    fn take(&mut self, configuration: Configuration, total: f64) {
        self.take(configuration, total);
    }

    fn watched(&self) -> [f64; 2] {
        self.watched()
    }
}

impl<L: Entry> Lanes<'_, '_, L> {
    /// Kinetic and potential energies of samples; NaN where they are not known.
    fn energies(&mut self, samples: &Samples) -> Vec<[f64; 2]> {
        let mut energies = vec![[f64::NAN; 2]; samples.len()];
        L::call(&mut Energies { lanes: self, samples, out: &mut energies });
        energies
    }

    /// Gives runs what was found of their steps.
    fn give<S: InLane>(&self, runs: &mut [Underway<'_, S>]) {
        for (lane, underway) in runs.iter_mut().enumerate() {
            if self.steps.give(lane, underway) {
                let (end, total) = (self.equation.end(lane), self.total.lane(lane));
                underway.run.system_mut().take(end, total);
            }
        }
    }

    /// Integrates all systems to their ends.
    fn solve<S: InLane>(
        &mut self,
        systems: &mut [S],
        prepared: &[Prepared],
        options: &[RunOptions<'_>],
        integrators: &mut [Integrator],
    ) -> Vec<Result<Solution, Error<S::Error>>> {
        let needs = prepared.iter().zip(options);
        let ode_options: Vec<_> = needs.map(|(needs, options)| needs.options(options)).collect();
        let mut solved: Vec<Solved<S>> = systems.iter().map(|_| None).collect();
        let mut underway = Vec::new();
        let each = systems.iter_mut().zip(integrators).zip(prepared).zip(&ode_options);
        for (index, (((system, integrator), needs), options)) in each.enumerate() {
            let [from, to] = needs.range;
            let start = integrator.begin(system, from, &needs.start, to, options);
            match start.and_then(|mut run| Ok((run.plan()?, run))) {
                Ok((Plan::Attempt(planned), run)) => {
                    underway.push(Underway { index, run, planned });
                }
                Ok((Plan::End(end), mut run)) => solved[index] = Some(Ok(run.finish_in_room(end))),
                Err(error) => solved[index] = Some(Err(error)),
            }
        }
        while !underway.is_empty() {
            for runs in underway.chunks_mut(L::Register::LANES) {
                if runs.len() >= WORTH_LANES {
                    L::call(&mut FindSteps { lanes: &mut *self, runs });
                    self.give(runs);
                }
            }
            underway.retain_mut(|Underway { index, run, planned }| {
                let next = run.attempt(*planned).and_then(|()| run.plan());
                solved[*index] = match next {
                    Ok(Plan::Attempt(next)) => {
                        *planned = next;
                        return true;
                    }
                    Ok(Plan::End(end)) => Some(Ok(run.finish_in_room(end))),
                    Err(error) => Some(Err(error)),
                };
                false
            });
        }
        solved.into_iter().flatten().collect()
    }
}

/// Finds the next steps of some runs.
struct FindSteps<'t, 'a, 'd, 'm, L: Entry, S> {
    lanes: &'t mut Lanes<'d, 'm, L>,
    runs: &'t mut [Underway<'a, S>],
}

impl<L: Entry, S: InLane> Task<L::Register> for FindSteps<'_, '_, '_, '_, L, S> {
    #[inline(always)]
    fn run(&mut self) {
        let (Lanes { equation, steps, total }, runs) = (&mut *self.lanes, &*self.runs);
        let known = steps.find(runs, equation);
        let watched =
            |lane: usize| runs[if lane < runs.len() { lane } else { 0 }].run.system().watched();
        let before = L::Register::from_lanes(|lane| watched(lane)[0]);
        let relative = L::Register::from_lanes(|lane| watched(lane)[1]);
        let [after, allowed] = equation.balance(steps.new_state(), relative);
        // Without a finite energy there is nothing to check.
        let drifts = L::Register::ONE.lt((after - before).abs() / allowed);
        steps.let_end(known.and(drifts.not()));
        *total = after;
    }
}

/// Finds the energies of samples.
struct Energies<'t, 'd, 'm, L: Entry> {
    lanes: &'t mut Lanes<'d, 'm, L>,
    samples: &'t Samples,
    out: &'t mut [[f64; 2]],
}

impl<L: Entry> Task<L::Register> for Energies<'_, '_, '_, L> {
    #[inline(always)]
    fn run(&mut self) {
        let Samples { q, speed, .. } = self.samples;
        self.lanes.equation.energies(q, speed, self.out);
    }
}
