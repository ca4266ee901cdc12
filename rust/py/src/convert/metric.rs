//! Metrics and conditions from tuples, as `assur.metric` makes them.

use std::f64::consts::TAU;

use assur::sweep::{
    Combination, Condition, Coordinate, Deviation, Extreme, LeastTransmission, Line, Mean, Metric,
    Moves, Operand, Part, PlaceOf, Relation, RootMeanSquare, Shape, Span, TimeRatio,
};
use pyo3::prelude::*;

use super::word::Word;
use crate::error;

type Own = Box<dyn Metric + Send>;

/// A metric, of which kind and of what.
pub(crate) struct MetricSpec(pub Own);

impl<'py> FromPyObject<'_, 'py> for MetricSpec {
    type Error = PyErr;

    fn extract(spec: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        let kind: String = spec.get_item(0)?.extract()?;
        let with_coordinate = || coordinate(&spec.get_item(1)?);
        let metric: Own = match kind.as_str() {
            "moves" => Box::new(Moves),
            "span" => Box::new(Span(with_coordinate()?)),
            "least" => Box::new(Extreme::Least(with_coordinate()?)),
            "greatest" => Box::new(Extreme::Greatest(with_coordinate()?)),
            "place_of_least" => Box::new(PlaceOf(Extreme::Least(with_coordinate()?))),
            "place_of_greatest" => Box::new(PlaceOf(Extreme::Greatest(with_coordinate()?))),
            "mean" => Box::new(Mean(with_coordinate()?)),
            "rms" => Box::new(RootMeanSquare(with_coordinate()?)),
            "time_ratio" => Box::new(TimeRatio(with_coordinate()?)),
            "least_transmission" => {
                let lines = [line(&spec.get_item(1)?)?, line(&spec.get_item(2)?)?];
                Box::new(LeastTransmission { lines, complement: spec.get_item(3)?.extract()? })
            }
            "deviation" => {
                let (joint, shape, part, is_relative): (_, Word<Shape>, _, _) =
                    spec.get_item(1)?.extract()?;
                let shape = shape.0;
                Box::new(Deviation { joint, shape, part, is_relative })
            }
            "part" => {
                let (from, to, of_turn): (f64, f64, bool) = spec.get_item(1)?.extract()?;
                let MetricSpec(metric) = spec.get_item(2)?.extract()?;
                let period = of_turn.then_some(TAU);
                Box::new(Part { metric, from, to, period })
            }
            "combination" => {
                let Word(operation) = spec.get_item(1)?.extract()?;
                let [left, right] = [operand(&spec.get_item(2)?)?, operand(&spec.get_item(3)?)?];
                Box::new(Combination { operation, left, right })
            }
            _ => return Err(unknown("metric", &kind)),
        };
        Ok(Self(metric))
    }
}

/// What it belongs to, index, component and order.
fn coordinate(spec: &Bound<'_, PyAny>) -> PyResult<Coordinate> {
    let (what, index, component, order): (String, usize, usize, usize) = spec.extract()?;
    let value = match what.as_str() {
        "joint" => Coordinate::joint(index, component),
        "link" => Coordinate::link(index),
        "slide" => Coordinate::slide(index),
        _ => return Err(unknown("coordinate", &what)),
    };
    Ok(value.derivative(order))
}

/// Two joints; or a link, and the dimension that is the guide's angle.
fn line(spec: &Bound<'_, PyAny>) -> PyResult<Line> {
    let kind: String = spec.get_item(0)?.extract()?;
    match kind.as_str() {
        "joints" => Ok(Line::Joints([spec.get_item(1)?.extract()?, spec.get_item(2)?.extract()?])),
        "guide" => Ok(Line::Guide(spec.get_item(1)?.extract()?, spec.get_item(2)?.extract()?)),
        _ => Err(unknown("line", &kind)),
    }
}

fn unknown(what: &str, kind: &str) -> PyErr {
    error::input(&format!("{kind:?} is not a kind of {what}"), None)
}

/// A number or a metric.
fn operand(spec: &Bound<'_, PyAny>) -> PyResult<Operand> {
    if let Ok(number) = spec.extract() {
        return Ok(Operand::Number(number));
    }
    let MetricSpec(metric) = spec.extract()?;
    Ok(Operand::Metric(metric))
}

/// A condition: metric, relation and limit.
pub(crate) fn condition((metric, relation, limit): (usize, Word<Relation>, f64)) -> Condition {
    Condition { metric, relation: relation.0, limit }
}
