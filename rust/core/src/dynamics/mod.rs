//! Dynamics of mechanisms, referred to the driver: loads, motors, runs, steady states, flywheels.
//!
//! # Examples
//!
//! The flywheel that keeps a press within a fluctuation of 1/8 at 15 rad/s
//! (I. M. Matsyuk & E. M. Shlyakhov):
//!
//! ```
//! use std::sync::atomic::AtomicBool;
//!
//! use assur::dynamics::{Cycle, EndCondition, Flywheel, Mean};
//!
//! let phi: Vec<f64> = (0..9).map(|i| std::f64::consts::FRAC_PI_4 * f64::from(i)).collect();
//! let moment = [-0.23, -274.4, -950.5, 19.9, 1.26, -300.0, -23.9, -15.9, -0.23];
//! let inertia = [4.93, 5.07, 5.1, 5.1, 4.93, 5.05, 5.1, 5.14, 4.93];
//! let cancel = AtomicBool::new(false);
//! let cycle = Cycle::new(&phi, &moment, &inertia, EndCondition::NotAKnot, &cancel)?;
//! let flywheel = Flywheel::for_fluctuation(cycle, 0.125, 15.0, Mean::Extremes, &cancel)?;
//! assert!((flywheel.inertia - 19.918150).abs() < 1e-6);
//! # Ok::<(), assur::dynamics::TableError>(())
//! ```

pub(crate) mod angle_between;
pub(crate) mod body;
pub(crate) mod driver_scales;
pub(crate) mod equations;
pub(crate) mod equilibria;
pub(crate) mod flywheel;
pub(crate) mod followers;
pub(crate) mod friction;
pub(crate) mod gas;
pub(crate) mod kinematics;
pub(crate) mod kinetostatics;
pub(crate) mod load;
pub(crate) mod machine;
pub(crate) mod measure;
pub(crate) mod motor;
pub(crate) mod pair_friction;
pub(crate) mod reactions;
pub(crate) mod reduced;
pub(crate) mod run;
pub(crate) mod stations;
pub(crate) mod steady;
pub(crate) mod stiffness;
pub(crate) mod tables;
pub(crate) mod value;
pub(crate) mod variation;

pub use angle_between::{Angle, Line};
pub use body::Body;
pub use equations::plan::EquationPlan;
pub use equations::request::{Direction, EquationRequest, Term};
pub use equations::steps::request::{StepMethod, StepRequest};
pub use equilibria::{Equilibria, Equilibrium, EquilibriumRange};
pub use flywheel::cycle::{Cycle, Extreme};
pub use flywheel::flywheel::{Flywheel, Mean};
pub use gas::Gas;
pub use kinematics::Point;
pub use kinetostatics::request::{Reaction, ReactionRequest};
pub use load::Load;
pub use machine::{DrivenPositions, Machine, ReducedTable};
pub use measure::{Curve, Measure, OneWay, Over};
pub use motor::{Characteristic, Motor};
pub use pair_friction::Friction;
pub use reactions::load_actions::LoadAction;
pub use run::callbacks::{Callbacks, NoCallbacks, UnlessCancelled};
pub use run::dead_point::Tail;
pub use run::error::RunError;
pub use run::imbalance::Imbalance;
pub use run::options::{EventKind, EventSpec, RunOptions};
pub use run::parts::{PartsError, RunParts};
pub use run::run_batch::{Outcome, RunBatch};
pub use run::runner::{RunTables, Runner};
pub use run::sample::{Sample, Samples};
pub use run::tabulated::TabulatedMachine;
pub use run::trajectory::{EventRecord, Run, StopReason};
pub use run::variable::Variable;
pub use steady::error::SteadyError;
pub use steady::flywheel_sizing::FluctuationTarget;
pub use steady::options::SteadyOptions;
pub use steady::steady::Steady;
pub use tables::error::TableError;
pub use tables::spline::{EndCondition, Pieces, spline, spline_unless};
pub use tables::table::Table;
pub use value::Value;
pub use variation::{MachineNumber, Variation};
