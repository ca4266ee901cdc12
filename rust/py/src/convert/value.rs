//! Values of loads and motors: numbers, tables over the coordinate, functions of (t, q, speed).

use assur::dynamics::{EndCondition, Table, Value};
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;

use super::Classes;
use super::word::Word;
use crate::error_map;

pub(crate) const MODULE: Classes = Classes("assur.dynamics.table");

/// The tables and functions of a machine, in the order of their indices.
#[derive(Default)]
pub(crate) struct Values {
    pub(crate) tables: Vec<Table>,
    pub(crate) functions: Vec<Py<PyAny>>,
}

impl Values {
    /// Reads a number, a `Table` or a callable; the latter two are stored here.
    pub(crate) fn read(&mut self, value: &Bound<'_, PyAny>) -> PyResult<Value> {
        if MODULE.is(value, "Table")? {
            self.tables.push(value.extract::<TableFields<'_>>()?.over_coordinate()?);
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
        table(&self.q, &self.value, self.spline.0, periodic)
    }
}

pub(crate) fn table(
    knots: &PyReadonlyArray1<'_, f64>,
    values: &PyReadonlyArray1<'_, f64>,
    ends: EndCondition,
    periodic: bool,
) -> PyResult<Table> {
    let [knots, values] = [knots, values].map(|column| column.as_array().to_vec());
    Table::new(&knots, &values, ends, periodic).map_err(|error| error_map::table(&error, "", None))
}
