//! The equations of motion of a machine for Python.

use std::num::NonZeroUsize;
use std::sync::OnceLock;

use assur::dynamics::{
    Direction, EquationPlan, EquationRequest, Machine, StepMethod, StepRequest, Term, Variation,
};
use assur::ode::Method;
use assur::{Arrays, Control, Coordinates, Mechanism};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::convert::word::{Word, Words};
use crate::error_map;
use crate::memory::filled;
use crate::reactions::Found;
use crate::run::options::Tolerances;

type Flat<'py> = PyReadonlyArray1<'py, f64>;

/// Positions of a slider-crank up to which a call need not check for signals.
const FEW_POSITIONS: u64 = 20_000;

/// A position in dual numbers, one direction after another, takes about as long as so many.
const COST_OF_DUALS: u64 = 50;

/// A term without its index.
#[derive(Clone, Copy)]
enum Kind {
    MassMatrix,
    MassRates,
    Bias,
    Gravity,
    Effort,
    Acceleration,
    Jacobian,
}

impl Words for Kind {
    const WHAT: &'static str = "term";
    const KNOWN: &'static [(&'static str, Self)] = &[
        ("mass matrix", Self::MassMatrix),
        ("mass rates", Self::MassRates),
        ("bias", Self::Bias),
        ("gravity", Self::Gravity),
        ("effort", Self::Effort),
        ("acceleration", Self::Acceleration),
        ("jacobian", Self::Jacobian),
    ];
}

/// A term as Python names it: its kind, and the index of the joint of a Jacobian.
#[derive(FromPyObject)]
pub(crate) struct TermKey(Word<Kind>, usize);

impl TermKey {
    /// Whether it is a Jacobian.
    fn is_of_a_joint(&self) -> bool {
        matches!(self.0.0, Kind::Jacobian)
    }

    fn term(&self) -> Term {
        match self.0.0 {
            Kind::MassMatrix => Term::MassMatrix,
            Kind::MassRates => Term::MassRates,
            Kind::Bias => Term::Bias,
            Kind::Gravity => Term::Gravity,
            Kind::Effort => Term::Effort,
            Kind::Acceleration => Term::Acceleration,
            Kind::Jacobian => Term::Jacobian(self.1),
        }
    }
}

/// The compiled equations of motion of a machine: without Jacobians of joints, with all of them, for
/// derivatives, for accelerations alone.
#[derive(Default)]
pub(crate) struct Plans([OnceLock<EquationPlan>; 4]);

impl Plans {
    /// Those for some terms, or for their derivatives.
    pub(crate) fn of_terms(
        &self,
        mechanism: &Mechanism,
        machine: &Machine,
        terms: &[TermKey],
        derives: bool,
    ) -> &EquationPlan {
        if derives {
            return self.0[2].get_or_init(|| EquationPlan::for_derivatives(mechanism, machine));
        }
        if let [TermKey(Word(Kind::Acceleration), _)] = terms {
            return self.of_accelerations(mechanism, machine);
        }
        let joints = terms.iter().any(TermKey::is_of_a_joint);
        self.0[usize::from(joints)].get_or_init(|| {
            let all = if joints { mechanism.linkage().joints.len() } else { 0 };
            EquationPlan::new(mechanism, machine, (0..all).collect())
        })
    }

    /// Those for accelerations alone.
    pub(crate) fn of_accelerations(
        &self,
        mechanism: &Mechanism,
        machine: &Machine,
    ) -> &EquationPlan {
        self.0[3].get_or_init(|| EquationPlan::for_accelerations(mechanism, machine))
    }
}

/// The arrays of a request: dimensions, coordinates, speeds, accelerations, efforts, values of functions.
pub(crate) struct Inputs<'py> {
    pub dimensions: Flat<'py>,
    pub q: Flat<'py>,
    pub per_design: bool,
    pub speed: Flat<'py>,
    pub acceleration: Flat<'py>,
    pub effort: Flat<'py>,
    pub has_motors: bool,
    pub function_values: Flat<'py>,
    pub sense: Vec<f64>,
    /// Designs × positions.
    pub rows: usize,
}

/// A direction in which terms are differentiated, without its index.
#[derive(Clone, Copy)]
enum Way {
    Coordinate,
    Speed,
    Acceleration,
    Effort,
    Dimension,
}

impl Words for Way {
    const WHAT: &'static str = "direction";
    const KNOWN: &'static [(&'static str, Self)] = &[
        ("q", Self::Coordinate),
        ("speed", Self::Speed),
        ("acceleration", Self::Acceleration),
        ("effort", Self::Effort),
        ("dimension", Self::Dimension),
    ];
}

/// A direction as Python names it: its kind, and the index of a driver or a dimension.
#[derive(FromPyObject)]
pub(crate) struct DirectionKey(Word<Way>, usize);

impl DirectionKey {
    fn direction(&self) -> Direction {
        match self.0.0 {
            Way::Coordinate => Direction::Coordinate(self.1),
            Way::Speed => Direction::Speed(self.1),
            Way::Acceleration => Direction::Acceleration(self.1),
            Way::Effort => Direction::Effort(self.1),
            Way::Dimension => Direction::Dimension(self.1),
        }
    }
}

/// A machine on its mechanism with its compiled equations, and the numbers that vary.
type Planned<'a> = (&'a Mechanism, &'a Machine, &'a EquationPlan, &'a [Variation<'a>]);

/// See `assur.Machine.dynamics` and `acceleration`; with directions, the terms' derivatives in them.
pub(crate) fn equations<'py>(
    py: Python<'py>,
    (mechanism, machine, plan, variations): Planned<'_>,
    inputs: &Inputs<'py>,
    (keys, by): (&[TermKey], Option<&[DirectionKey]>),
    threads: Option<NonZeroUsize>,
    report: &[usize],
) -> PyResult<Found<'py>> {
    let by: Option<Vec<Direction>> = by.map(|by| by.iter().map(DirectionKey::direction).collect());
    // All are the package's own arrays, which no other code changes meanwhile.
    let q = inputs.q.as_slice()?;
    let terms: Vec<Term> = keys.iter().map(TermKey::term).collect();
    let request = EquationRequest {
        dimensions: inputs.dimensions.as_slice()?,
        coordinates: if inputs.per_design {
            Coordinates::PerDesign(q)
        } else {
            Coordinates::Shared(q)
        },
        signs: mechanism.signs(),
        speed: inputs.speed.as_slice()?,
        acceleration: inputs.acceleration.as_slice()?,
        effort: inputs.effort.as_slice()?,
        has_motors: inputs.has_motors,
        external: inputs.function_values.as_slice()?,
        sense: &inputs.sense,
        variations,
        terms: &terms,
    };
    let (rows, drivers) = (inputs.rows, mechanism.q0().len());
    let directions = by.as_ref().map_or(1, Vec::len);
    let widths = terms.iter().map(|term| term.width(drivers) * directions);
    let cost = plan.cost(mechanism).saturating_mul(if by.is_some() { COST_OF_DUALS } else { 1 });
    let is_short = (rows as u64).saturating_mul(cost) < FEW_POSITIONS;
    let fill = |arrays: Arrays<'_>, control: &Control<'_>| match &by {
        Some(by) => machine.equation_derivatives(mechanism, plan, &request, by, arrays, control),
        None => machine.equations(mechanism, plan, &request, arrays, control),
    };
    let (values, status, log) = filled(py, rows, widths, is_short, threads, fill)?;
    let failure =
        log.first().map(|first| error_map::first_failure(&first, report, rows).into_value(py));
    Ok((values, status, failure))
}

/// Coordinates and speeds after steps, and the statuses.
pub(crate) type Stepped<'py> = (Vec<Bound<'py, PyArray1<f64>>>, Bound<'py, PyArray1<u8>>);

/// Steps of a slider-crank up to which a call need not check for signals.
const FEW_STEPS: u64 = 100_000;
/// As many environments take about as long as one.
const LIKE_ONE: u64 = 32;
/// A step with error control takes as long as so many at times: it may end at a dead point, which narrow ones
/// approach.
const COST_OF_CONTROL: u64 = 256;

/// Time of a step, number of steps, and of methods with error control the pair with its tolerances.
pub(crate) type Steps = (f64, u64, Option<(Word<Method>, Tolerances)>);

/// The environments that make steps: dimensions, coordinates, speeds and efforts.
pub(crate) struct Environments<'py> {
    pub dimensions: Flat<'py>,
    pub q: Flat<'py>,
    pub speed: Flat<'py>,
    pub effort: Flat<'py>,
    pub has_motors: bool,
    pub holds: bool,
    /// Designs × environments.
    pub rows: usize,
}

/// See `assur.Machine.step`.
pub(crate) fn step<'py>(
    py: Python<'py>,
    (mechanism, machine, plan, variations): Planned<'_>,
    environments: &Environments<'py>,
    (dt, steps, pair): Steps,
    threads: Option<NonZeroUsize>,
) -> PyResult<Stepped<'py>> {
    let (method, cost_of_method) = match pair {
        None => (StepMethod::Even, 1),
        Some((Word(pair), (relative, absolute))) => {
            (StepMethod::Controlled { pair, relative, absolute }, COST_OF_CONTROL)
        }
    };
    let request = StepRequest {
        dimensions: environments.dimensions.as_slice()?,
        signs: mechanism.signs(),
        q: environments.q.as_slice()?,
        speed: environments.speed.as_slice()?,
        effort: environments.effort.as_slice()?,
        has_motors: environments.has_motors,
        variations,
        dt,
        steps,
        method,
        holds: environments.holds,
    };
    let (rows, drivers) = (environments.rows, mechanism.q0().len());
    let cost_of_one = plan.cost(mechanism).saturating_mul(cost_of_method);
    let cost = cost_of_one.saturating_mul((rows as u64).max(LIKE_ONE));
    let is_short = steps.saturating_mul(cost) < FEW_STEPS;
    let fill = |arrays: Arrays<'_>, control: &Control<'_>| {
        machine.step(mechanism, plan, &request, arrays, control)
    };
    let (values, status, _) = filled(py, rows, [drivers; 2], is_short, threads, fill)?;
    Ok((values, status))
}
