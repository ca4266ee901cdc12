//! Motions: designs × positions, with analogues.

mod analogue;
mod bars;
mod binary;
mod bridge;
mod cell;
mod change;
mod design;
mod dyad;
mod explain;
mod fit;
pub(crate) mod follow;
mod forms;
mod group;
mod group_analogue;
mod group_equations;
mod home;
pub mod metrics;
mod outputs;
mod own_condition;
mod parallel;
mod place;
mod quick;
mod rows;
mod sensitivity;
mod simd;
mod solve;
mod spread;
mod state;
mod stream;
mod template;
#[cfg(feature = "test-hooks")]
pub mod test_hooks;
mod track;
mod unknowns;
mod walk;

pub use explain::Diagnosis;
pub use outputs::{Column, Outputs, Quantity};
pub use parallel::Control;
pub use simd::Simd;
pub use solve::{Arrays, Coordinates, Motion, Request, Track, fill, solve};
pub use state::{Fault, Status};
