//! Runs: motions of machines integrated from an initial state.

mod boundary;
pub(crate) mod callbacks;
pub(crate) mod dead_point;
pub(crate) mod equation;
pub(crate) mod error;
pub(crate) mod imbalance;
pub(crate) mod integrate;
pub(crate) mod lane_equation;
pub(crate) mod model;
mod obstacle;
pub(crate) mod options;
pub(crate) mod parts;
pub(crate) mod run_batch;
pub(crate) mod runner;
pub(crate) mod sample;
pub(crate) mod side_by_side;
pub(crate) mod station_cursor;
pub(crate) mod stick_slip;
pub(crate) mod system;
pub(crate) mod table_cursor;
pub(crate) mod tabulated;
pub(crate) mod tolerances;
pub(crate) mod trajectory;
pub(crate) mod variable;
