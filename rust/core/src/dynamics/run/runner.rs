//! Runs of one design, one after another: what does not depend on the run is made once.

use super::callbacks::Callbacks;
use super::equation::Equation;
use super::error::{RunError, check_counts};
use super::integrate;
use super::model::MechanismModel;
use super::options::RunOptions;
use super::trajectory::Run;
use crate::dynamics::driver_scales::sizes_of;
use crate::dynamics::machine::Machine;
use crate::math::derivatives::DerivativeTables;
use crate::plan::mechanism::Mechanism;
use crate::query::failure::Failure;

/// Index tables that the runs of a mechanism need.
#[derive(Debug)]
pub struct RunTables(pub(super) DerivativeTables);

impl RunTables {
    /// Those of a mechanism.
    #[must_use]
    pub fn new(mechanism: &Mechanism) -> Self {
        Self(DerivativeTables::new(mechanism.q0().len(), 2))
    }
}

/// A machine on one design with its branch traced. A run has the bits that it has with a runner of its
/// own.
pub struct Runner<'m> {
    machine: &'m Machine,
    model: MechanismModel<'m>,
    drivers: usize,
    /// For each driver, the size that its tolerance is relative to.
    sizes: Vec<f64>,
}

impl<'m> Runner<'m> {
    /// Binds a design and traces its branch.
    ///
    /// # Errors
    ///
    /// A wrong number of dimensions, or one that no design has.
    pub fn new<E>(
        machine: &'m Machine,
        mechanism: &'m Mechanism,
        dimensions: &[f64],
        tables: &'m RunTables,
    ) -> Result<Self, RunError<E>> {
        let needed = mechanism.dimensions().len();
        check_counts(&[("dimensions", needed, dimensions.len())])?;
        if let Some(fault) = mechanism.dimensions().first_fault(dimensions) {
            let failure = Failure::of_dimension(fault, mechanism.q0());
            return Err(RunError::NoInitialPosition(failure));
        }
        Ok(Self {
            machine,
            model: MechanismModel::new(machine, mechanism, dimensions, &tables.0),
            drivers: mechanism.q0().len(),
            sizes: sizes_of(mechanism, dimensions),
        })
    }

    /// Integrates a motion.
    ///
    /// # Errors
    ///
    /// Those of [`Machine::run`].
    pub fn run<O: Callbacks>(
        &mut self,
        options: &RunOptions<'_>,
        callbacks: O,
    ) -> Result<Run, RunError<O::Error>> {
        let Self { machine, model, drivers, sizes } = self;
        options.check(*drivers, &machine.motors)?;
        model.restart();
        let equation = Equation::new(model, callbacks, &machine.tables, &machine.motors, *drivers);
        integrate::run(equation, options, sizes)
    }
}

impl Machine {
    /// Integrates the motion of a design of the mechanism.
    ///
    /// # Errors
    ///
    /// Invalid options or initial state, a reduced inertia that is not positive, or a failed
    /// callback.
    pub fn run<O: Callbacks>(
        &self,
        mechanism: &Mechanism,
        dimensions: &[f64],
        options: &RunOptions<'_>,
        callbacks: O,
    ) -> Result<Run, RunError<O::Error>> {
        let tables = RunTables::new(mechanism);
        Runner::new(self, mechanism, dimensions, &tables)?.run(options, callbacks)
    }
}
