//! Values of loads and motors: numbers, tables over a coordinate, functions of (t, q, speed).

use assur::Mechanism;
use assur::Named;
use assur::dynamics::{Curve, EndCondition, Measure, OneWay, Over, Table, Value};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use super::Classes;
use super::word::Word;
use crate::{detach, error, error_map, reserve};

pub(crate) const MODULE: Classes = Classes("assur.dynamics.loads.table");

/// The tables and functions of a machine, in the order of their indices, and the coordinates whose
/// direction loads follow.
#[derive(Default)]
pub(crate) struct Values<'m> {
    pub(crate) mechanism: Option<&'m Mechanism>,
    pub(crate) tables: Vec<Table>,
    pub(crate) over: Vec<Over>,
    pub(crate) ways: Vec<Measure>,
    pub(crate) functions: Vec<Py<PyAny>>,
}

/// The value of a slide, or the angle of a link.
fn measure(mechanism: Option<&Mechanism>, name: &str) -> PyResult<Measure> {
    let Some(mechanism) = mechanism else {
        let message = format!("over={name:?}: a machine of a table has no slides and no links");
        return Err(error::input(&message, None));
    };
    match mechanism.slide_or_link(name).map_err(error_map::solve)? {
        (Named::Slide, slide) => Ok(Measure::Slide(slide)),
        (_, link) if link == mechanism.linkage().ground => {
            Err(error::input("over=\"ground\": the ground does not move", None))
        }
        (_, link) => Ok(Measure::Angle(link)),
    }
}

impl Values<'_> {
    /// Adds a curve over a coordinate.
    pub(crate) fn follow(&mut self, over: Over) -> Value {
        self.over.push(over);
        Value::Over(self.over.len() - 1)
    }

    /// The direction in which a load acts, if `while_` names one: that of the coordinate named, or of
    /// `default`.
    pub(crate) fn one_way(
        &mut self,
        while_: Option<&str>,
        over: Option<&str>,
        default: Measure,
    ) -> PyResult<Option<OneWay>> {
        let Some(word) = while_ else { return Ok(None) };
        let measure = over.map_or(Ok(default), |name| measure(self.mechanism, name))?;
        let index = self.ways.iter().position(|&way| way == measure);
        let way = index.unwrap_or_else(|| {
            self.ways.push(measure);
            self.ways.len() - 1
        });
        Ok(Some(OneWay { way, sign: if word == "backward" { -1.0 } else { 1.0 } }))
    }

    /// Reads a number, a `Table` or a callable; the latter two are stored here.
    pub(crate) fn read(&mut self, value: &Bound<'_, PyAny>) -> PyResult<Value> {
        if MODULE.is(value, "Table")? {
            let mut fields = value.extract::<TableFields<'_>>()?;
            let over = fields.over.take();
            let table = fields.over_coordinate()?;
            if let Some(name) = over {
                let measure = measure(self.mechanism, &name)?;
                return Ok(self.follow(Over { measure, curve: Curve::Table(table) }));
            }
            self.tables.push(table);
            return Ok(Value::Table(self.tables.len() - 1));
        }
        if value.is_callable() {
            self.functions.push(value.clone().unbind());
            return Ok(Value::External(self.functions.len() - 1));
        }
        value.extract().map(Value::Number)
    }
}

/// The fields of a `Table`.
#[derive(FromPyObject)]
pub(crate) struct TableFields<'py> {
    q: PyReadonlyArray1<'py, f64>,
    value: PyReadonlyArray1<'py, f64>,
    spline: Word<EndCondition>,
    periodic: bool,
    over: Option<String>,
}

impl TableFields<'_> {
    pub(crate) fn over_coordinate(self) -> PyResult<Table> {
        let periodic = self.periodic;
        self.table(periodic)
    }

    pub(crate) fn over_speed(self) -> PyResult<Table> {
        self.table(false)
    }

    fn table(self, periodic: bool) -> PyResult<Table> {
        let [knots, values] = [&self.q, &self.value].map(|column| column.as_array().to_vec());
        let table = detach::run(self.q.py(), knots.len() < FEW_ROWS, |cancel| {
            Table::with_jumps_unless(&knots, &values, self.spline.0, periodic, cancel)
        })?;
        table.map_err(|error| error_map::table(&error, "", None))
    }
}

/// Rows of a table up to which its curve takes milliseconds: too short for a signal.
pub(crate) const FEW_ROWS: usize = 32_768;

/// Numbers of a spline for each knot of its table.
const SPLINE: usize = 8;

/// The values of a `Table` at coordinates; NaN beyond it. At a jump the value behind it.
#[pyfunction]
pub(crate) fn table_values<'py>(
    py: Python<'py>,
    table: TableFields<'py>,
    points: PyReadonlyArray1<'py, f64>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let _room = reserve::room_for(py, SPLINE * table.q.as_array().len() + points.as_array().len())?;
    let table = table.over_coordinate()?;
    let points = reserve::copied(&points)?;
    let values = detach::map(py, points.len(), |i| table.at(points[i]))?;
    Ok(PyArray1::from_vec(py, values))
}
