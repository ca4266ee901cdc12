//! One solved position in dual numbers: every number with its rate in one direction.

use super::request::Direction;
use crate::batch::request::{Column, Quantity};
use crate::branch::design::Design;
use crate::dynamics::kinetostatics::positions::DesignPositions;
use crate::dynamics::machine::Machine;
use crate::dynamics::measure::Measure;
use crate::dynamics::reactions::columns::Sources;
use crate::dynamics::reactions::force_plan::ForcePlan;
use crate::math::lanes::place_in_blocks;
use crate::math::vector::Vector;
use crate::plan::constants_rate::ConstantsRate;
use crate::plan::mechanism::Mechanism;
use crate::sensitivity::linearization::Linearization;
use crate::sensitivity::plan::SensitivityPlan;
use crate::sensitivity::steps::{Component, ComponentKind};
use crate::sensitivity::tangent::Tangent;

/// What all rows share.
pub(super) struct DualPlan<'p> {
    pub mechanism: &'p Mechanism,
    pub machine: &'p Machine,
    pub forces: &'p ForcePlan,
    pub sources: &'p Sources,
    pub columns: &'p [Column],
    /// Derivatives of the columns by dimensions, if a direction is one: a result for each column whose order
    /// the equations read, [`None`] for others.
    pub sensitivity: Option<(SensitivityPlan<'p>, Vec<Option<usize>>)>,
}

/// Numbers and rates, alternating.
#[derive(Default)]
pub(super) struct DualRow {
    pub columns: Vec<Vec<f64>>,
    pub speed: Vec<f64>,
    pub tables: Vec<Vec<f64>>,
    pub over: Vec<Vec<f64>>,
    pub ways: Vec<Vec<f64>>,
    pub varied: Vec<Vec<f64>>,
    linear: Linearization<f64>,
    tangent: Tangent<f64>,
}

impl DualPlan<'_> {
    /// Sets the numbers of a row, without rates.
    pub(super) fn load(&self, row: &mut DualRow, positions: &DesignPositions<'_>, index: usize) {
        let solved = &positions.solved;
        row.columns.resize(self.columns.len(), Vec::new());
        for (dual, (column, values)) in
            row.columns.iter_mut().zip(self.columns.iter().zip(solved.columns))
        {
            let width = column.width;
            let value = |entry: usize| values[place_in_blocks(index, width, entry)];
            set_values(dual, (0..width).map(value));
        }
        let n = self.forces.drivers;
        let first = if solved.speed.len() == n { 0 } else { index * n };
        set_values(&mut row.speed, solved.speed[first..first + n].iter().copied());
        let values = &positions.values;
        for (duals, lists) in [
            (&mut row.tables, values.tables),
            (&mut row.over, values.over),
            (&mut row.ways, values.ways),
            (&mut row.varied, values.varied.rows),
        ] {
            duals.resize(lists.len(), Vec::new());
            for (dual, list) in duals.iter_mut().zip(lists) {
                set_values(dual, [list[index]].into_iter());
            }
        }
        if let (Some((sensitivity, _)), Some(design)) = (&self.sensitivity, positions.design) {
            row.linear.read(sensitivity, design, solved.columns, (index, 1));
        }
    }

    /// Sets the rates of a loaded row in a direction.
    pub(super) fn direct(
        &self,
        row: &mut DualRow,
        positions: &DesignPositions<'_>,
        index: usize,
        direction: Direction,
        rates: Option<&ConstantsRate>,
    ) {
        let lists = [&mut row.columns, &mut row.tables, &mut row.over];
        for dual in lists.into_iter().flatten().chain([&mut row.speed]) {
            for pair in dual.chunks_exact_mut(2) {
                pair[1] = 0.0;
            }
        }
        let q = &positions.q[index * self.forces.drivers..][..self.forces.drivers];
        match direction {
            Direction::Speed(driver) => row.speed[2 * driver + 1] = 1.0,
            Direction::Coordinate(driver) => {
                self.along_driver(row, driver);
                if driver == 0 {
                    for (dual, table) in row.tables.iter_mut().zip(&self.machine.tables) {
                        dual[1] = table.value_and_slope(q[0]).map_or(f64::NAN, |pair| pair[1]);
                    }
                }
            }
            Direction::Dimension(_) => {
                if let (Some(design), Some(rates)) = (positions.design, rates) {
                    self.along_dimension(row, design, rates);
                }
            }
            Direction::Acceleration(_) | Direction::Effort(_) => {}
        }
        for (dual, over) in row.over.iter_mut().zip(&self.machine.over) {
            let (at, rate) = match over.measure {
                Measure::Driver(driver) => {
                    (q[driver], f64::from(direction == Direction::Coordinate(driver)))
                }
                Measure::Slide(slide) => first(&row.columns, self.sources.slides[slide]),
                Measure::Angle(link) => first(&row.columns, self.sources.angles[link]),
            };
            dual[1] = if rate == 0.0 { 0.0 } else { over.read(at, None)[1] * rate };
        }
    }

    /// Rates of the columns by a driver: the derivatives of one order more.
    fn along_driver(&self, row: &mut DualRow, driver: usize) {
        let n = self.forces.drivers;
        for (index, column) in self.columns.iter().enumerate() {
            if let Quantity::Direction(link) = column.quantity {
                let rate = match (&self.forces.turns[link], self.sources.rates[link]) {
                    (Some(turns), _) => turns[driver],
                    (None, Some(source)) => row.columns[source][2 * driver],
                    (None, None) => 0.0,
                };
                turn(&mut row.columns[index], rate);
                continue;
            }
            let is_next =
                |next: &Column| next.quantity == column.quantity && next.order == column.order + 1;
            let Some(next) = self.columns.get(index + 1).filter(|next| is_next(next)) else {
                continue;
            };
            debug_assert_eq!(next.width, column.width * n);
            for entry in 0..column.width {
                let rate = row.columns[index + 1][2 * (entry * n + driver)];
                row.columns[index][2 * entry + 1] = rate;
            }
        }
    }

    /// Rates of the columns where dimensions change.
    fn along_dimension(&self, row: &mut DualRow, design: &Design<'_>, rates: &ConstantsRate) {
        let Some((sensitivity, results)) = &self.sensitivity else { return };
        row.tangent.solve(sensitivity, (&row.linear, 0), rates);
        let with = (&design.units, rates);
        for ((dual, column), result) in row.columns.iter_mut().zip(self.columns).zip(results) {
            let Some(result) = result else { continue };
            let components = &sensitivity.results[*result];
            let rate = |&one: &Component| row.tangent.component(sensitivity.len(), with, one);
            if let Quantity::Direction(_) = column.quantity {
                turn(dual, rate(&components[0]));
                continue;
            }
            for (pair, component) in dual.chunks_exact_mut(2).zip(components) {
                pair[1] = rate(component);
            }
        }
    }

    /// The rate of a point of the ground where dimensions change.
    pub(super) fn fixed_rate(
        &self,
        row: &DualRow,
        design: &Design<'_>,
        rates: &ConstantsRate,
        point: usize,
    ) -> Vector {
        let Some((sensitivity, _)) = &self.sensitivity else { return Vector::ZERO };
        let [x, y] = [ComponentKind::X { point }, ComponentKind::Y { point }].map(|kind| {
            let component = Component { kind, k: 0 };
            row.tangent.component(sensitivity.len(), (&design.units, rates), component)
        });
        Vector::new(x, y)
    }
}

/// Value and rate of a column's first number.
fn first(columns: &[Vec<f64>], column: Option<usize>) -> (f64, f64) {
    column.map_or((0.0, 0.0), |column| (columns[column][0], columns[column][1]))
}

/// Numbers with rates 0.
fn set_values(dual: &mut Vec<f64>, values: impl Iterator<Item = f64>) {
    dual.clear();
    dual.extend(values.flat_map(|value| [value, 0.0]));
}

/// The rate of a unit vector that turns.
fn turn(unit: &mut [f64], rate: f64) {
    (unit[1], unit[3]) = (-unit[2] * rate, unit[0] * rate);
}
