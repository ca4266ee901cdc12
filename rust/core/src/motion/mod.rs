//! Motions: designs × positions, with analogues.

pub(crate) mod outputs;
pub(crate) mod parallel;
pub(crate) mod rows;
pub(crate) mod simd;
pub(crate) mod solve;
pub(crate) mod stream;
#[cfg(feature = "test-hooks")]
pub mod test_hooks;

pub use crate::math::simd::Simd;
pub use crate::query::diagnosis::Diagnosis;
pub use crate::state::state::{Fault, Status};
pub use outputs::{Column, Outputs, Quantity};
pub use parallel::Control;
pub use solve::{Arrays, Coordinates, Motion, Request, Track, fill, solve};
