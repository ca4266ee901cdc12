//! Motions: designs × positions, with analogues.

pub use crate::batch::outputs::{Column, Outputs, Quantity};
pub use crate::batch::schedule::Control;
pub use crate::batch::solve::{Arrays, Coordinates, Motion, Request, Track, fill, solve};
pub use crate::math::simd::Simd;
pub use crate::query::diagnosis::Diagnosis;
pub use crate::state::state::{Fault, Status};
