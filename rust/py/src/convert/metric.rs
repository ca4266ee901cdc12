//! Metrics and conditions of sweeps.

use std::f64::consts::TAU;

use assur::sweep::{
    self, Condition, Extreme, LeastTransmission, Mean, Metric, Moves, Operand, Operation, PlaceOf,
    Relation, RootMeanSquare, Shape, Span, TimeRatio,
};
use pyo3::prelude::*;

use super::Classes;
use super::word::{Word, Words};

const MODULE: Classes = Classes("assur.sweeps.specs");

type Own = Box<dyn Metric + Send>;

/// A metric of any class.
pub(crate) struct MetricSpec(pub Own);

/// What a coordinate belongs to.
#[derive(Clone, Copy)]
enum Owner {
    Joint,
    Link,
    Slide,
}

impl Words for Owner {
    const WHAT: &'static str = "kind";
    const KNOWN: &'static [(&'static str, Self)] =
        &[("joint", Self::Joint), ("link", Self::Link), ("slide", Self::Slide)];
}

#[derive(FromPyObject)]
struct Coordinate {
    kind: Word<Owner>,
    index: usize,
    component: usize,
    order: usize,
}

impl From<Coordinate> for sweep::Coordinate {
    fn from(of: Coordinate) -> Self {
        let value = match of.kind.0 {
            Owner::Joint => Self::joint(of.index, of.component),
            Owner::Link => Self::link(of.index),
            Owner::Slide => Self::slide(of.index),
        };
        value.derivative(of.order)
    }
}

/// `JointLine` or `GuideLine`: the fields tell which.
#[derive(FromPyObject)]
enum Line {
    Joints { start: usize, end: usize },
    Guide { link: usize, angle: Option<usize> },
}

impl From<Line> for sweep::Line {
    fn from(line: Line) -> Self {
        match line {
            Line::Joints { start, end } => Self::Joints([start, end]),
            Line::Guide { link, angle } => Self::Guide(link, angle),
        }
    }
}

/// What is measured of one coordinate.
#[derive(Clone, Copy)]
enum Measure {
    Span,
    Least,
    Greatest,
    PlaceOfLeast,
    PlaceOfGreatest,
    Mean,
    RootMeanSquare,
    TimeRatio,
}

impl Words for Measure {
    const WHAT: &'static str = "measure";
    const KNOWN: &'static [(&'static str, Self)] = &[
        ("span", Self::Span),
        ("least", Self::Least),
        ("greatest", Self::Greatest),
        ("place_of_least", Self::PlaceOfLeast),
        ("place_of_greatest", Self::PlaceOfGreatest),
        ("mean", Self::Mean),
        ("rms", Self::RootMeanSquare),
        ("time_ratio", Self::TimeRatio),
    ];
}

#[derive(FromPyObject)]
struct Scalar {
    measure: Word<Measure>,
    coordinate: Coordinate,
}

impl Scalar {
    fn metric(self) -> Own {
        let of = self.coordinate.into();
        match self.measure.0 {
            Measure::Span => Box::new(Span(of)),
            Measure::Least => Box::new(Extreme::Least(of)),
            Measure::Greatest => Box::new(Extreme::Greatest(of)),
            Measure::PlaceOfLeast => Box::new(PlaceOf(Extreme::Least(of))),
            Measure::PlaceOfGreatest => Box::new(PlaceOf(Extreme::Greatest(of))),
            Measure::Mean => Box::new(Mean(of)),
            Measure::RootMeanSquare => Box::new(RootMeanSquare(of)),
            Measure::TimeRatio => Box::new(TimeRatio(of)),
        }
    }
}

#[derive(FromPyObject)]
struct LeastTransmissionOf {
    lines: [Line; 2],
    complement: bool,
}

#[derive(FromPyObject)]
struct Deviation {
    joint: usize,
    shape: Word<Shape>,
    part: f64,
    is_relative: bool,
}

#[derive(FromPyObject)]
struct Part {
    metric: MetricSpec,
    start: f64,
    end: f64,
    is_of_turn: bool,
}

#[derive(FromPyObject)]
struct Combination {
    operation: Word<Operation>,
    left: Side,
    right: Side,
}

#[derive(FromPyObject)]
enum Side {
    #[pyo3(transparent)]
    Number(f64),
    #[pyo3(transparent)]
    Metric(MetricSpec),
}

impl From<Side> for Operand {
    fn from(side: Side) -> Self {
        match side {
            Side::Number(number) => Self::Number(number),
            Side::Metric(MetricSpec(metric)) => Self::Metric(metric),
        }
    }
}

impl<'py> FromPyObject<'_, 'py> for MetricSpec {
    type Error = PyErr;

    fn extract(object: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        let is = |class| MODULE.is(&object, class);
        let metric: Own = if is("Moves")? {
            Box::new(Moves)
        } else if is("Scalar")? {
            object.extract::<Scalar>()?.metric()
        } else if is("LeastTransmission")? {
            let LeastTransmissionOf { lines, complement } = object.extract()?;
            Box::new(LeastTransmission { lines: lines.map(Into::into), complement })
        } else if is("Deviation")? {
            let Deviation { joint, shape: Word(shape), part, is_relative } = object.extract()?;
            Box::new(sweep::Deviation { joint, shape, part, is_relative })
        } else if is("Part")? {
            let Part { metric: MetricSpec(metric), start, end, is_of_turn } = object.extract()?;
            Box::new(sweep::Part {
                metric,
                from: start,
                to: end,
                period: is_of_turn.then_some(TAU),
            })
        } else if is("Combination")? {
            let Combination { operation: Word(operation), left, right } = object.extract()?;
            Box::new(sweep::Combination { operation, left: left.into(), right: right.into() })
        } else {
            return Err(MODULE.unknown(&object));
        };
        Ok(Self(metric))
    }
}

/// A condition: metric, relation and limit.
pub(crate) fn condition((metric, relation, limit): (usize, Word<Relation>, f64)) -> Condition {
    Condition { metric, relation: relation.0, limit }
}
