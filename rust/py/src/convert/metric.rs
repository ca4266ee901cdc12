//! Metrics and conditions of sweeps: the objects of `assur.metric`, with the names of a mechanism.

use std::f64::consts::TAU;

use assur::sweep::{
    Combination, Condition, Deviation, Extreme, IndexOf, LeastTransmission, Mean, Metric, Moves,
    Operand, Part, PlaceOf, Relation, RootMeanSquare, Shape, Span, TimeRatio,
};
use assur::{Driver, Mechanism};
use pyo3::prelude::*;

use super::Classes;
use super::point::LineOf;
use super::target;
use super::word::{Word, Words};
use crate::error_map;

const MODULE: Classes = Classes("assur.sweeps.terms");

type Own = Box<dyn Metric + Send>;

/// The measured quantity.
#[derive(Clone, Copy)]
enum Kind {
    Moves,
    LeastTransmission,
    Deviation,
    Span,
    Least,
    Greatest,
    PlaceOfLeast,
    PlaceOfGreatest,
    IndexOfLeast,
    IndexOfGreatest,
    IndexOfLeastTransmission,
    Mean,
    RootMeanSquare,
    TimeRatio,
    PathError,
    FunctionError,
    PoseError,
}

impl Words for Kind {
    const WHAT: &'static str = "kind";
    const KNOWN: &'static [(&'static str, Self)] = &[
        ("moves", Self::Moves),
        ("min_transmission_angle", Self::LeastTransmission),
        ("deviation", Self::Deviation),
        ("span", Self::Span),
        ("min", Self::Least),
        ("max", Self::Greatest),
        ("argmin", Self::PlaceOfLeast),
        ("argmax", Self::PlaceOfGreatest),
        // Of the position that decides: gradients need it.
        ("index of min", Self::IndexOfLeast),
        ("index of max", Self::IndexOfGreatest),
        ("index of min_transmission_angle", Self::IndexOfLeastTransmission),
        ("mean", Self::Mean),
        ("rms", Self::RootMeanSquare),
        ("time_ratio", Self::TimeRatio),
        ("path_error", Self::PathError),
        ("function_error", Self::FunctionError),
        ("pose_error", Self::PoseError),
    ];
}

#[derive(FromPyObject)]
struct Leaf<'py> {
    kind: Word<Kind>,
    of: Option<String>,
    order: usize,
    options: Bound<'py, PyAny>,
    over: Option<(f64, f64)>,
}

impl Leaf<'_> {
    fn least_transmission(&self, mechanism: &Mechanism) -> PyResult<LeastTransmission> {
        let (first, second, complement): (LineOf, LineOf, bool) = self.options.extract()?;
        let lines = [first.of_designs(mechanism)?, second.of_designs(mechanism)?];
        Ok(LeastTransmission { lines, complement })
    }

    fn metric(self, mechanism: &Mechanism) -> PyResult<Own> {
        let name = self.of.clone().unwrap_or_default();
        let coordinate = || -> PyResult<assur::sweep::Coordinate> {
            let tracked = mechanism.coordinate(&name).map_err(error_map::solve)?;
            Ok(assur::sweep::Coordinate::from(tracked).derivative(self.order))
        };
        let metric: Own = match self.kind.0 {
            Kind::Moves => Box::new(Moves),
            Kind::LeastTransmission => Box::new(self.least_transmission(mechanism)?),
            Kind::IndexOfLeastTransmission => {
                Box::new(IndexOf(self.least_transmission(mechanism)?))
            }
            Kind::Deviation => {
                let joint = mechanism.joint(&name).map_err(error_map::solve)?;
                let (Word(shape), part, is_relative): (Word<Shape>, f64, bool) =
                    self.options.extract()?;
                Box::new(Deviation { joint, shape, part, is_relative })
            }
            Kind::Span => Box::new(Span(coordinate()?)),
            Kind::Least => Box::new(Extreme::Least(coordinate()?)),
            Kind::Greatest => Box::new(Extreme::Greatest(coordinate()?)),
            Kind::PlaceOfLeast => Box::new(PlaceOf(Extreme::Least(coordinate()?))),
            Kind::PlaceOfGreatest => Box::new(PlaceOf(Extreme::Greatest(coordinate()?))),
            Kind::IndexOfLeast => Box::new(IndexOf(Extreme::Least(coordinate()?))),
            Kind::IndexOfGreatest => Box::new(IndexOf(Extreme::Greatest(coordinate()?))),
            Kind::Mean => Box::new(Mean(coordinate()?)),
            Kind::RootMeanSquare => Box::new(RootMeanSquare(coordinate()?)),
            Kind::TimeRatio => Box::new(TimeRatio(coordinate()?)),
            Kind::PathError => {
                let joint = mechanism.joint(&name).map_err(error_map::solve)?;
                Box::new(target::path_error(joint, &self.options)?)
            }
            Kind::FunctionError => Box::new(target::function_error(coordinate()?, &self.options)?),
            Kind::PoseError => {
                let link = mechanism.link(&name).map_err(error_map::solve)?;
                Box::new(target::pose_error(link, &self.options)?)
            }
        };
        let Some(over) = self.over else { return Ok(metric) };
        Ok(Box::new(part(mechanism, metric, over)))
    }
}

/// A metric of the positions whose coordinate is within a range.
pub(crate) fn part<M>(mechanism: &Mechanism, metric: M, (from, to): (f64, f64)) -> Part<M> {
    let is_slide = matches!(mechanism.linkage().drivers.first(), Some(Driver::Slide(_)));
    Part { metric, from, to, period: (!is_slide).then_some(TAU) }
}

/// A metric of any class, for a mechanism.
pub(crate) fn metric_of(mechanism: &Mechanism, metric: &Bound<'_, PyAny>) -> PyResult<Own> {
    if MODULE.is(metric, "Leaf")? {
        return metric.extract::<Leaf<'_>>()?.metric(mechanism);
    }
    if !MODULE.is(metric, "Combination")? {
        return Err(MODULE.unknown(metric));
    }
    let side = |name| -> PyResult<Operand> {
        let side = metric.getattr(name)?;
        match side.extract::<f64>() {
            Ok(number) => Ok(Operand::Number(number)),
            Err(_) => metric_of(mechanism, &side).map(Operand::Metric),
        }
    };
    let Word(operation) = metric.getattr("sign")?.extract()?;
    Ok(Box::new(Combination { operation, left: side("left")?, right: side("right")? }))
}

/// A condition: metric, relation and limit.
pub(crate) fn condition((metric, relation, limit): (usize, Word<Relation>, f64)) -> Condition {
    Condition { metric, relation: relation.0, limit }
}
