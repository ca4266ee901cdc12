//! Machines for Python: reduced inertias and moments, runs and steady states.

use std::num::NonZeroUsize;
use std::time::Duration;

use assur::dynamics::{
    EndCondition, EquilibriumRange, FluctuationTarget, LoadAction, Mean, Point, RunBatch,
    RunOptions, SteadyOptions, TabulatedMachine,
};
use assur::ode::Method;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::{PyTraverseError, PyVisit};

use crate::convert::body::Body;
use crate::convert::event::event;
use crate::convert::friction::PairFriction;
use crate::convert::load::loads;
use crate::convert::motor::motors;
use crate::convert::value::{FEW_ROWS, Values};
use crate::convert::varied::{Varied, VariedKey};
use crate::convert::word::Word;
use crate::detach::{self, catch_panic};
use crate::equations::{self, DirectionKey, Plans, TermKey};
use crate::mechanism::Mechanism;
use crate::reactions::{self, Inputs, Key};
use crate::run::Run;
use crate::run::batch::{self, Source};
use crate::run::calls::with_callbacks;
use crate::run::options::{Tolerances, deadline, options};
use crate::run::outcomes::Runs;
use crate::run::steady_numbers::SteadyNumbers;
use crate::{equilibria, error, error_map, reduce, reserve};

type Flat<'py> = PyReadonlyArray1<'py, f64>;
type Array<'py> = Bound<'py, PyArray1<f64>>;
/// Source of a machine's inertia and loads.
enum Inner {
    Mechanism(Py<Mechanism>, assur::dynamics::Machine),
    Tables(TabulatedMachine),
}

/// A machine: a mechanism with bodies and loads, or tables of inertia and moment; and motors.
#[pyclass(frozen, module = "assur._core")]
pub(crate) struct Machine {
    inner: Inner,
    /// Python functions: those of loads, then those of motors.
    functions: Vec<Py<PyAny>>,
    load_functions: usize,
    plans: Plans,
    /// The numbers that differ from machine to machine of a batch.
    varied: Varied,
}

#[pymethods]
impl Machine {
    /// Reads the dataclasses of loads, bodies by link, motors by driver, and friction by pair, and the numbers
    /// that vary from machine to machine.
    #[new]
    #[pyo3(signature = (mechanism, bodies, loads, motors, friction, varied = Vec::new()))]
    fn new(
        py: Python<'_>,
        mechanism: Py<Mechanism>,
        bodies: Vec<(String, Body)>,
        loads: Vec<Bound<'_, PyAny>>,
        motors: Vec<Option<Bound<'_, PyAny>>>,
        friction: Vec<(String, PairFriction)>,
        varied: Vec<VariedKey<'_>>,
    ) -> PyResult<Self> {
        let core = &mechanism.bind(py).get().inner;
        catch_panic(|| {
            let mut values = Values { mechanism: Some(core), ..Values::default() };
            let (loads, gravity) = self::loads(core, &loads, &mut values)?;
            let load_functions = values.functions.len();
            let motors = self::motors(&motors, &mut values)?;
            let body = |(link, body): &(String, Body)| body.of_link(core, link);
            let bodies = bodies.iter().map(body).collect::<PyResult<_>>()?;
            let of_pair =
                |(name, pair_friction): &(String, PairFriction)| pair_friction.of_pair(core, name);
            let friction = friction.iter().map(of_pair).collect::<PyResult<_>>()?;
            let Values { tables, over, ways, functions, .. } = values;
            let machine = assur::dynamics::Machine {
                bodies,
                loads,
                gravity,
                tables,
                over,
                ways,
                motors,
                friction,
            };
            let varied = Varied::new(&machine, &varied)?;
            Ok((machine, functions, load_functions, varied))
        })
        .map(|(machine, functions, load_functions, varied)| Self {
            inner: Inner::Mechanism(mechanism, machine),
            functions,
            load_functions,
            plans: Plans::default(),
            varied,
        })
    }

    /// A machine given by tables of inertia and moment over the angle.
    #[staticmethod]
    fn from_table(
        py: Python<'_>,
        phi: Flat<'_>,
        moment: Flat<'_>,
        inertia: Flat<'_>,
        spline: Word<EndCondition>,
        periodic: bool,
        motor: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        catch_panic(|| {
            let [phi, moment, inertia] = [phi, moment, inertia].map(|a| a.as_array().to_vec());
            let tables = detach::run(py, phi.len() < FEW_ROWS, |cancel| {
                TabulatedMachine::reduced(&phi, [&inertia, &moment], spline.0, periodic, cancel)
            })?;
            let tables = tables.map_err(|error| error_map::table(&error, "", None))?.into();
            let mut values = Values { tables, ..Values::default() };
            let motors = motors(&[motor], &mut values)?;
            let Values { tables, functions, .. } = values;
            let inner = Inner::Tables(TabulatedMachine { tables, motors });
            Ok(Self {
                inner,
                functions,
                load_functions: 0,
                plans: Plans::default(),
                varied: Varied::default(),
            })
        })
    }

    fn __traverse__(&self, visit: PyVisit<'_>) -> Result<(), PyTraverseError> {
        self.functions.iter().try_for_each(|function| visit.call(function))
    }

    /// Tables over the coordinate: where they begin and end, and whether they are periodic.
    #[getter]
    fn tables(&self) -> Vec<([f64; 2], bool)> {
        let tables = self.own_tables();
        tables.iter().map(|table| (table.range(), table.period().is_some())).collect()
    }

    /// The coordinates of the rows of these tables.
    #[getter]
    fn rows<'py>(&self, py: Python<'py>) -> Vec<Array<'py>> {
        self.own_tables().iter().map(|table| PyArray1::from_slice(py, table.knots())).collect()
    }

    /// The coordinates at which each of these tables jumps.
    #[getter]
    fn jumps(&self) -> Vec<Vec<f64>> {
        self.own_tables().iter().map(|table| table.jumps().to_vec()).collect()
    }

    /// Whether loads follow other coordinates than the first driver's and may not be smooth over it, and
    /// whether they follow the direction of one.
    #[getter]
    fn follows(&self) -> (bool, bool) {
        match &self.inner {
            Inner::Mechanism(_, machine) => (machine.has_stations(), !machine.ways.is_empty()),
            Inner::Tables(_) => (false, false),
        }
    }

    /// The places between two coordinates where such loads are not smooth: a coordinate is at a knot of a
    /// table over it, or turns back.
    fn stations(
        &self,
        py: Python<'_>,
        dimensions: Vec<f64>,
        start: f64,
        end: f64,
    ) -> PyResult<Vec<f64>> {
        self.of_mechanism(py, |core, machine| machine.stations(core, &dimensions, [start, end]))
    }

    /// Where pairs with friction reverse between two coordinates.
    fn reversals(
        &self,
        py: Python<'_>,
        dimensions: Vec<f64>,
        start: f64,
        end: f64,
    ) -> PyResult<Vec<f64>> {
        self.of_mechanism(py, |core, machine| machine.reversals(core, &dimensions, [start, end]))
    }

    /// The first table over another coordinate that does not cover a position of a design: its ends, and
    /// the value there.
    fn uncovered(
        &self,
        py: Python<'_>,
        dimensions: Vec<f64>,
        q: Vec<f64>,
    ) -> PyResult<Option<(f64, f64, f64)>> {
        let uncovered =
            self.of_mechanism(py, |core, machine| machine.uncovered(core, &dimensions, &q))?;
        Ok(uncovered.map(|([from, to], at)| (from, to, at)))
    }

    /// The actions of its loads on links, in the order of reactions: the load's index among those that are not
    /// gravity, the link, the joint of the link where it acts, if any, and whether it acts with a couple.
    #[getter]
    fn load_actions(&self) -> Vec<(usize, &str, Option<&str>, bool)> {
        let Inner::Mechanism(mechanism, machine) = &self.inner else { return Vec::new() };
        let core = &mechanism.get().inner;
        let linkage = core.linkage();
        let actions =
            machine.load_actions(core).into_iter().map(|LoadAction { load, link, at, .. }| {
                let acted_link = &linkage.links[link];
                let joint = match at {
                    Some(Point::Joint(joint)) if acted_link.joints.contains(&joint) => Some(joint),
                    _ => None,
                };
                let joint = joint.map(|joint| linkage.joints[joint].name.as_str());
                (load, acted_link.name.as_str(), joint, at.is_none())
            });
        actions.collect()
    }

    /// Python functions of the loads.
    #[getter]
    fn load_functions(&self, py: Python<'_>) -> Vec<Py<PyAny>> {
        let functions = &self.functions[..self.load_functions];
        functions.iter().map(|function| function.clone_ref(py)).collect()
    }

    /// Python functions of loads, then those of motors.
    #[getter]
    fn functions(&self, py: Python<'_>) -> Vec<Py<PyAny>> {
        self.functions.iter().map(|function| function.clone_ref(py)).collect()
    }

    /// Reduces the inertia and loads of designs to the drivers, each at the same number of
    /// positions. `dimensions`: the first of every design, then the second; the others design by
    /// design. `function_values`: of the loads' Python functions at every position; `report`:
    /// the shape of the designs, for the exception of the first that failed; `sense`: in which sense each
    /// driver is about to move where all rest, or empty.
    #[allow(clippy::too_many_arguments, reason = "flat arrays")]
    fn reduce<'py>(
        &self,
        py: Python<'py>,
        dimensions: Flat<'py>,
        q: Flat<'py>,
        speed: Flat<'py>,
        function_values: Flat<'py>,
        sense: Vec<f64>,
        threads: Option<usize>,
        report: Vec<usize>,
    ) -> PyResult<reduce::Arrays<'py>> {
        let (mechanism, machine) = match &self.inner {
            Inner::Mechanism(mechanism, machine) => (mechanism, machine),
            Inner::Tables(tabulated) => {
                let q = q.as_slice()?;
                return catch_panic(|| Ok(reduce::arrays(py, &[tabulated.reduce(q)], None)));
            }
        };
        let mechanism = &mechanism.get().inner;
        let inputs = [&dimensions, &q, &speed, &function_values];
        let variations = self.varied.variations();
        let of = (mechanism, machine, &variations[..]);
        reduce::reduce(py, of, inputs, &sense, threads, &report)
    }

    /// The requested `reactions` of designs at positions; the other arguments are those of `reduce`.
    /// `squares`: only the greatest and the mean square of each design; then the `rows` are the designs, else
    /// designs × positions. `sense` (of the drivers at rest) and `solution`: see `ReactionRequest`.
    #[allow(clippy::too_many_arguments, reason = "flat arrays")]
    fn reactions<'py>(
        &self,
        py: Python<'py>,
        dimensions: Flat<'py>,
        q: Flat<'py>,
        per_design: bool,
        speed: Flat<'py>,
        acceleration: Flat<'py>,
        function_values: Flat<'py>,
        reactions: Vec<Key>,
        rows: usize,
        squares: bool,
        friction: (Vec<f64>, usize),
        threads: Option<NonZeroUsize>,
        report: Vec<usize>,
    ) -> PyResult<reactions::Found<'py>> {
        self.varied.refuse()?;
        let Inner::Mechanism(mechanism, machine) = &self.inner else {
            return Err(error::input("a machine of a table has no joints", None));
        };
        let mechanism = &mechanism.get().inner;
        let inputs = Inputs {
            dimensions,
            q,
            per_design,
            speed,
            acceleration,
            function_values,
            rows,
            squares,
            friction,
        };
        reactions::reactions(py, mechanism, machine, &inputs, &reactions, threads, &report)
    }

    /// The requested `terms` of the equations of motion of designs at positions, in the layout of
    /// `reactions`. `rates`: speeds, accelerations and efforts of the drivers. `function_values`: of all
    /// `functions`. `by`: directions in which the terms are differentiated.
    #[allow(clippy::too_many_arguments, reason = "flat arrays")]
    #[pyo3(signature = (
        dimensions, q, per_design, rates, has_motors, function_values, terms, rows, sense, threads,
        report, by = None
    ))]
    fn equations<'py>(
        &self,
        py: Python<'py>,
        dimensions: Flat<'py>,
        q: Flat<'py>,
        per_design: bool,
        rates: (Flat<'py>, Flat<'py>, Flat<'py>),
        has_motors: bool,
        function_values: Flat<'py>,
        terms: Vec<TermKey>,
        rows: usize,
        sense: Vec<f64>,
        threads: Option<NonZeroUsize>,
        report: Vec<usize>,
        by: Option<Vec<DirectionKey>>,
    ) -> PyResult<reactions::Found<'py>> {
        let Inner::Mechanism(mechanism, machine) = &self.inner else {
            return Err(error::input("a machine of a table has no mechanism", None));
        };
        let mechanism = &mechanism.get().inner;
        let (speed, acceleration, effort) = rates;
        let inputs = equations::Inputs {
            dimensions,
            q,
            per_design,
            speed,
            acceleration,
            effort,
            has_motors,
            function_values,
            sense,
            rows,
        };
        let plan = self.plans.of_terms(mechanism, machine, &terms, by.is_some());
        let variations = self.varied.variations();
        let of = (mechanism, machine, plan, &variations[..]);
        equations::equations(py, of, &inputs, (&terms, by.as_deref()), threads, &report)
    }

    /// Steps environments in time; see `assur.Machine.step`. `state`: coordinates, speeds and efforts.
    #[allow(clippy::too_many_arguments, reason = "flat arrays")]
    fn step<'py>(
        &self,
        py: Python<'py>,
        dimensions: Flat<'py>,
        state: (Flat<'py>, Flat<'py>, Flat<'py>),
        has_motors: bool,
        rows: usize,
        steps: equations::Steps,
        holds: bool,
        threads: Option<NonZeroUsize>,
    ) -> PyResult<equations::Stepped<'py>> {
        let Inner::Mechanism(mechanism, machine) = &self.inner else {
            return Err(error::input("a machine of a table has no mechanism", None));
        };
        let mechanism = &mechanism.get().inner;
        let (q, speed, effort) = state;
        let environments =
            equations::Environments { dimensions, q, speed, effort, has_motors, holds, rows };
        let plan = self.plans.of_accelerations(mechanism, machine);
        let variations = self.varied.variations();
        let of = (mechanism, machine, plan, &variations[..]);
        equations::step(py, of, &environments, steps, threads)
    }

    /// Positions of rest of one design.
    fn equilibria<'py>(
        &self,
        py: Python<'py>,
        dimensions: Flat<'py>,
        ends: [f64; 2],
        is_turn: bool,
        intervals: u32,
    ) -> PyResult<equilibria::Found<'py>> {
        self.varied.refuse()?;
        let range = EquilibriumRange { ends, is_turn, intervals };
        let dimensions = dimensions.as_slice()?;
        let equilibria = detach::run(py, false, |cancel| match &self.inner {
            Inner::Mechanism(mechanism, machine) => {
                machine.equilibria(&mechanism.get().inner, dimensions, range, cancel)
            }
            Inner::Tables(tabulated) => tabulated.equilibria(range),
        })?;
        Ok(equilibria::arrays(py, &equilibria))
    }

    /// Integrates a run over time or, with `along_q`, over the coordinate.
    #[allow(clippy::too_many_arguments, reason = "the parameters of a run")]
    fn run(
        &self,
        py: Python<'_>,
        dimensions: Vec<f64>,
        along_q: bool,
        start: (f64, Vec<f64>, Vec<f64>),
        end: f64,
        method: Word<Method>,
        tolerances: Tolerances,
        limits: (f64, u64, Option<f64>),
        breaks: Vec<f64>,
        events: Vec<Bound<'_, PyAny>>,
    ) -> PyResult<Run> {
        self.varied.refuse()?;
        let core = match &self.inner {
            Inner::Mechanism(mechanism, _) => Some(&mechanism.get().inner),
            Inner::Tables(_) => None,
        };
        let mut event_functions = Vec::new();
        let events = events
            .iter()
            .map(|object| event(core, &dimensions, object, &mut event_functions))
            .collect::<PyResult<Vec<_>>>()?;
        let (t, q, speed) = start;
        let (max_step, max_steps, seconds) = limits;
        let options = RunOptions {
            q: &q,
            speed: &speed,
            end,
            events: &events,
            deadline: deadline(seconds),
            ..options(along_q, t, method.0, tolerances, (max_step, max_steps), &breaks)
        };
        let run =
            with_callbacks(py, &self.functions, event_functions, |calls| match &self.inner {
                Inner::Mechanism(mechanism, machine) => {
                    machine.run(&mechanism.get().inner, &dimensions, &options, calls)
                }
                Inner::Tables(tabulated) => tabulated.run(&options, calls),
            })?;
        run.map(Run::new).map_err(error_map::run)
    }

    /// Integrates runs of designs, the same number of each. `designs`: their dimensions, the first of
    /// every design, then the second, and how many there are. `states`: the initial time, coordinates and
    /// speeds (runs × drivers), and where each run ends. `keeping`: whether only the ends, and threads.
    #[allow(clippy::too_many_arguments, reason = "the parameters of runs")]
    fn runs(
        &self,
        py: Python<'_>,
        designs: (Flat<'_>, usize),
        along_q: bool,
        states: (f64, Flat<'_>, Flat<'_>, Flat<'_>),
        method: (Word<Method>, Tolerances),
        limits: (f64, u64, Option<f64>),
        breaks: Vec<f64>,
        events: Vec<Bound<'_, PyAny>>,
        keeping: (bool, Option<usize>),
    ) -> PyResult<Runs> {
        let ((dimensions, designs), (only_ends, threads)) = (designs, keeping);
        let (core, source) = match &self.inner {
            Inner::Mechanism(mechanism, machine) => {
                let core = &mechanism.get().inner;
                (Some(core), Source::Mechanism(core, machine))
            }
            Inner::Tables(tabulated) => (None, Source::Tables(tabulated)),
        };
        let dimensions = reserve::copied(&dimensions)?;
        let (t, q, speed, ends) = states;
        let [q, speed, ends] = [q, speed, ends].map(|array| reserve::copied(&array));
        let (q, speed, ends) = (q?, speed?, ends?);
        let mut functions = Vec::new();
        let events =
            batch::events_of_designs(core, (&dimensions, designs), &events, &mut functions)?;
        let (max_step, max_steps, seconds) = limits;
        let steps = (max_step, max_steps);
        let options = options(along_q, t, method.0.0, method.1, steps, &breaks);
        let limit = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
        let (dimensions, q, speed, ends, events) = (&dimensions, &q, &speed, &ends, &events);
        let variations = &self.varied.variations();
        let runs =
            RunBatch { dimensions, designs, q, speed, ends, events, variations, limit, options };
        if self.functions.is_empty() && functions.is_empty() {
            return batch::in_threads(py, source, &runs, only_ends, threads);
        }
        let kept = with_callbacks(py, &self.functions, functions, |calls| {
            batch::one_by_one(source, &runs, only_ends, calls)
        })??;
        Runs::new(py, kept)
    }

    /// The steady state from `q` over a span, with a given flywheel or one sized for a fluctuation.
    /// `mean`: definition of the mean speed. Returns the run over one period and its numbers.
    #[allow(clippy::too_many_arguments, reason = "the parameters of a steady state")]
    fn steady(
        &self,
        py: Python<'_>,
        dimensions: Vec<f64>,
        q: f64,
        span: f64,
        speed: Option<f64>,
        mean: Word<Mean>,
        method: Word<Method>,
        relative: f64,
        limits: (u64, Option<f64>),
        breaks: Vec<f64>,
        flywheel: f64,
        fluctuation: Option<f64>,
    ) -> PyResult<(Run, SteadyNumbers)> {
        self.varied.refuse()?;
        let options = SteadyOptions {
            q,
            span,
            speed,
            mean: mean.0,
            method: method.0,
            relative,
            max_steps: limits.0,
            deadline: deadline(limits.1),
            breaks: &breaks,
            flywheel,
        };
        let target = fluctuation.map(|fluctuation| FluctuationTarget { fluctuation, mean: mean.0 });
        let steady = with_callbacks(py, &self.functions, Vec::new(), |calls| match &self.inner {
            Inner::Mechanism(mechanism, machine) => {
                machine.steady(&mechanism.get().inner, &dimensions, &options, target, calls)
            }
            Inner::Tables(tabulated) => tabulated.steady(&options, target, calls),
        })?;
        let steady = steady.map_err(error_map::steady)?;
        let numbers = SteadyNumbers::of(&steady);
        Ok((Run::new(steady.run), numbers))
    }
}

impl Machine {
    /// Short work on the mechanism and its loads, without the GIL; empty for a machine of tables.
    fn of_mechanism<T: Default + Send>(
        &self,
        py: Python<'_>,
        work: impl Fn(&assur::Mechanism, &assur::dynamics::Machine) -> T + Sync,
    ) -> PyResult<T> {
        self.varied.refuse()?;
        match &self.inner {
            Inner::Mechanism(mechanism, machine) => {
                let core = &mechanism.get().inner;
                detach::run(py, true, |_| work(core, machine))
            }
            Inner::Tables(_) => Ok(T::default()),
        }
    }

    /// Its tables over the driver's coordinate.
    fn own_tables(&self) -> &[assur::dynamics::Table] {
        match &self.inner {
            Inner::Mechanism(_, machine) => &machine.tables,
            Inner::Tables(machine) => &machine.tables,
        }
    }
}
