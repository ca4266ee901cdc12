//! Motions: designs × positions, with analogues.

pub(crate) mod bridge;
pub(crate) mod cell;
pub(crate) mod change;
pub(crate) mod design;
pub(crate) mod explain;
pub(crate) mod follow;
pub(crate) mod home;
pub mod metrics;
pub(crate) mod outputs;
pub(crate) mod parallel;
pub(crate) mod quick;
pub(crate) mod rows;
pub(crate) mod simd;
pub(crate) mod solve;
pub(crate) mod stream;
pub(crate) mod template;
#[cfg(feature = "test-hooks")]
pub mod test_hooks;
pub(crate) mod track;
pub(crate) mod unknowns;
pub(crate) mod walk;

pub use crate::math::simd::Simd;
pub use crate::state::state::{Fault, Status};
pub use explain::Diagnosis;
pub use outputs::{Column, Outputs, Quantity};
pub use parallel::Control;
pub use solve::{Arrays, Coordinates, Motion, Request, Track, fill, solve};
