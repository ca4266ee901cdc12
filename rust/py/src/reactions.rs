//! Reactions of a machine for Python.

use std::num::NonZeroUsize;

use assur::dynamics::{Machine, Reaction, ReactionRequest};
use assur::{Arrays, Control, Coordinates, Mechanism};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyBaseException;
use pyo3::prelude::*;

use crate::convert::word::{Word, Words};
use crate::error_map;
use crate::memory::filled;

type Flat<'py> = PyReadonlyArray1<'py, f64>;
/// One array for each reaction, the statuses, and the exception of the first position that failed.
pub(crate) type Found<'py> =
    (Vec<Bound<'py, PyArray1<f64>>>, Bound<'py, PyArray1<u8>>, Option<Py<PyBaseException>>);

/// Positions up to which a call need not check for signals.
const FEW_POSITIONS: usize = 20_000;

/// Paths to solutions of friction up to which a call need not check either: they take some 50 ms.
const FEW_PATHS: usize = 256;

/// The object of a reaction.
#[derive(Clone, Copy)]
enum Kind {
    Joint,
    Normal,
    Moment,
    Along,
    JointMoment,
    Friction,
    JointLoss,
    SlideLoss,
    Solutions,
    Safety,
    Residual,
    Driver,
    ShakingForce,
    ShakingMoment,
    LoadForce,
    LoadPlace,
    LoadCouple,
}

impl Words for Kind {
    const WHAT: &'static str = "reaction";
    const KNOWN: &'static [(&'static str, Self)] = &[
        ("joint", Self::Joint),
        ("normal", Self::Normal),
        ("moment", Self::Moment),
        ("along", Self::Along),
        ("joint moment", Self::JointMoment),
        ("friction", Self::Friction),
        ("joint loss", Self::JointLoss),
        ("slide loss", Self::SlideLoss),
        ("solutions", Self::Solutions),
        ("safety", Self::Safety),
        ("residual", Self::Residual),
        ("driver", Self::Driver),
        ("shaking force", Self::ShakingForce),
        ("shaking moment", Self::ShakingMoment),
        ("load force", Self::LoadForce),
        ("load place", Self::LoadPlace),
        ("load couple", Self::LoadCouple),
    ];
}

/// A reaction as Python names it: `assur.dynamics.forces.reaction_key.Key`.
#[derive(FromPyObject)]
pub(crate) struct Key {
    kind: Word<Kind>,
    index: usize,
    on: usize,
}

impl Key {
    fn reaction(&self) -> Reaction {
        match self.kind.0 {
            Kind::Joint => Reaction::Joint { joint: self.index, on: self.on },
            Kind::Normal => Reaction::Normal(self.index),
            Kind::Moment => Reaction::Moment(self.index),
            Kind::Along => Reaction::Along(self.index),
            Kind::JointMoment => Reaction::JointMoment { joint: self.index, on: self.on },
            Kind::Friction => Reaction::Friction(self.index),
            Kind::JointLoss => Reaction::JointLoss(self.index),
            Kind::SlideLoss => Reaction::SlideLoss(self.index),
            Kind::Solutions => Reaction::Solutions,
            Kind::Safety => Reaction::Safety,
            Kind::Residual => Reaction::Residual,
            Kind::Driver => Reaction::Driver(self.index),
            Kind::ShakingForce => Reaction::ShakingForce,
            Kind::ShakingMoment => Reaction::ShakingMoment,
            Kind::LoadForce => Reaction::LoadForce(self.index),
            Kind::LoadPlace => Reaction::LoadPlace(self.index),
            Kind::LoadCouple => Reaction::LoadCouple(self.index),
        }
    }
}

/// The arrays that describe the motion: dimensions, coordinates, speeds, accelerations, values of
/// the loads' functions.
pub(crate) struct Inputs<'py> {
    pub dimensions: Flat<'py>,
    pub q: Flat<'py>,
    pub per_design: bool,
    pub speed: Flat<'py>,
    pub acceleration: Flat<'py>,
    pub function_values: Flat<'py>,
    /// Designs × positions.
    pub rows: usize,
    /// See `ReactionRequest::squares`; then the rows are the designs.
    pub squares: bool,
    /// The sense of the drivers at rest, and the index of the solution.
    pub friction: (Vec<f64>, usize),
}

/// See `assur.Machine.reactions`.
pub(crate) fn reactions<'py>(
    py: Python<'py>,
    mechanism: &Mechanism,
    machine: &Machine,
    inputs: &Inputs<'py>,
    keys: &[Key],
    threads: Option<NonZeroUsize>,
    report: &[usize],
) -> PyResult<Found<'py>> {
    // All are the package's own arrays, which no other code changes meanwhile.
    let q = inputs.q.as_slice()?;
    let reactions: Vec<Reaction> = keys.iter().map(Key::reaction).collect();
    let request = ReactionRequest {
        dimensions: inputs.dimensions.as_slice()?,
        coordinates: if inputs.per_design {
            Coordinates::PerDesign(q)
        } else {
            Coordinates::Shared(q)
        },
        signs: mechanism.signs(),
        speed: inputs.speed.as_slice()?,
        acceleration: inputs.acceleration.as_slice()?,
        external: inputs.function_values.as_slice()?,
        sense: &inputs.friction.0,
        solution: inputs.friction.1,
        reactions: &reactions,
        squares: inputs.squares,
    };
    let rows = inputs.rows;
    let width = |reaction: &Reaction| if inputs.squares { 2 } else { reaction.width() };
    let paths = rows.saturating_mul(machine.friction_paths(mechanism));
    let is_short = !inputs.squares && rows < FEW_POSITIONS && paths <= FEW_PATHS;
    let fill = |arrays: Arrays<'_>, control: &Control<'_>| {
        machine.reactions(mechanism, &request, arrays, control)
    };
    let (values, status, log) =
        filled(py, rows, reactions.iter().map(width), is_short, threads, fill)?;
    let failure =
        log.first().map(|first| error_map::first_failure(&first, report, rows).into_value(py));
    Ok((values, status, failure))
}
