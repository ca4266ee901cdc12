//! Motions: designs × positions, with analogues.

pub(crate) mod analogue;
pub(crate) mod bars;
pub(crate) mod binary;
pub(crate) mod bridge;
pub(crate) mod cell;
pub(crate) mod change;
pub(crate) mod design;
pub(crate) mod dyad;
pub(crate) mod explain;
pub(crate) mod fit;
pub(crate) mod follow;
pub(crate) mod forms;
pub(crate) mod group;
pub(crate) mod group_analogue;
pub(crate) mod group_equations;
pub(crate) mod home;
pub mod metrics;
pub(crate) mod outputs;
pub(crate) mod own_condition;
pub(crate) mod parallel;
pub(crate) mod place;
pub(crate) mod quick;
pub(crate) mod rows;
pub(crate) mod sensitivity;
pub(crate) mod simd;
pub(crate) mod solve;
pub(crate) mod spread;
pub(crate) mod state;
pub(crate) mod stream;
pub(crate) mod template;
#[cfg(feature = "test-hooks")]
pub mod test_hooks;
pub(crate) mod track;
pub(crate) mod unknowns;
pub(crate) mod walk;

pub use crate::math::simd::Simd;
pub use explain::Diagnosis;
pub use outputs::{Column, Outputs, Quantity};
pub use parallel::Control;
pub use solve::{Arrays, Coordinates, Motion, Request, Track, fill, solve};
pub use state::{Fault, Status};
