//! Machines given by tables of their reduced inertia and moment.

use std::sync::atomic::AtomicBool;

use super::model::ReducedModel;
use crate::dynamics::angle_between::Angle;
use crate::dynamics::flywheel::cycle::{with_seam, without_jumps};
use crate::dynamics::machine::ReducedTable;
use crate::dynamics::motor::Motor;
use crate::dynamics::reduced::Reduced;
use crate::dynamics::tables::error::TableError;
use crate::dynamics::tables::spline::EndCondition;
use crate::dynamics::tables::table::Table;
use crate::dynamics::value::Numbers;
use crate::query::evaluator::NearMiss;
use crate::query::failure::Failure;
use crate::state::status::{Rejection, Status};

/// A machine given by tables of its reduced inertia and moment over the driver's coordinate.
#[derive(Debug, Clone, PartialEq)]
pub struct TabulatedMachine {
    /// Inertia and moment, then the tables of motors.
    pub tables: Vec<Table>,
    /// Its motors.
    pub motors: Vec<Motor>,
}

impl TabulatedMachine {
    /// The tables of rows of inertia and moment, with jumps of the moment like those of a `Cycle`.
    ///
    /// # Errors
    ///
    /// Those of [`Table::with_jumps`], and an inertia that jumps. Once `cancel` is true the tables have no
    /// curves.
    pub fn reduced(
        phi: &[f64],
        [inertia, moment]: [&[f64]; 2],
        ends: EndCondition,
        periodic: bool,
        cancel: &AtomicBool,
    ) -> Result<[Table; 2], TableError> {
        let rows = periodic.then(|| with_seam(phi, moment, inertia));
        let [phi, moment, inertia] =
            rows.as_ref().map_or([phi, moment, inertia], |rows| rows.each_ref().map(Vec::as_slice));
        let (merged, smooth) = without_jumps(phi, inertia)?;
        let inertia = Table::new_unless(&merged, &smooth, ends, periodic, cancel)?;
        Ok([inertia, Table::with_jumps_unless(phi, moment, ends, periodic, cancel)?])
    }

    /// The machine at coordinates; NaN beyond tables that are not periodic.
    #[must_use]
    pub fn reduce(&self, q: &[f64]) -> ReducedTable {
        let mut rows = ReducedTable::default();
        for &q in q {
            let [inertia, moment] = [0, 1].map(|which| {
                let table = self.tables.get(which);
                table.and_then(|table| table.value_and_slope(q)).unwrap_or([f64::NAN; 2])
            });
            rows.inertia.push(inertia[0] + self.motors.iter().map(Motor::inertia).sum::<f64>());
            rows.d_inertia.push(inertia[1]);
            rows.moment.push(moment[0]);
            let is_covered = inertia[0].is_finite() && moment[0].is_finite();
            rows.potential.push(if is_covered { 0.0 } else { f64::NAN });
            rows.status.push(if is_covered { Status::Ok } else { Status::Unreachable });
        }
        rows
    }
}

impl ReducedModel for &TabulatedMachine {
    fn set_configuration(
        &mut self,
        _: &[f64],
        numbers: Numbers<'_>,
        out: &mut Reduced,
    ) -> Result<(), Rejection> {
        let [inertia, rate] = numbers.tables[0];
        out.inertia[0] = inertia + self.motors.iter().map(Motor::inertia).sum::<f64>();
        out.d_inertia[0] = rate;
        Ok(())
    }

    fn failure(&self, _: Rejection, _: &[f64]) -> Option<Failure> {
        None
    }

    fn driver_name(&self, _: usize) -> Option<String> {
        None
    }

    fn apply_loads(
        &mut self,
        _: &[f64],
        _: &[f64],
        _: f64,
        numbers: Numbers<'_>,
        out: &mut Reduced,
    ) {
        out.applied[0] = numbers.tables[1][0];
    }

    fn angle(&mut self, _: &[f64], _: &Angle) -> f64 {
        f64::NAN
    }

    fn unit(&self, _: usize) -> f64 {
        1.0
    }

    fn has_dead_points(&self) -> bool {
        false
    }

    fn dead_point_ahead(&mut self, _: f64, _: f64) -> Option<f64> {
        None
    }

    fn near_miss(&mut self, _: f64) -> Option<NearMiss> {
        None
    }

    fn is_near_dead_point(&mut self, _: &[f64], _: f64) -> bool {
        false
    }

    fn dead_point_beside(&mut self, _: &[f64]) -> Option<Rejection> {
        None
    }

    fn inertia_noise(&self) -> f64 {
        0.0
    }

    fn inverse_condition(&mut self, _: &[f64]) -> f64 {
        1.0
    }
}
