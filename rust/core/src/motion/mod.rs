//! Motions: designs × positions, with analogues.

pub use crate::batch::outputs::Arrays;
pub use crate::batch::outputs::{Column, Outputs, Quantity};
pub use crate::batch::request::{Coordinates, Motion, Request, Track};
pub use crate::batch::schedule::Control;
pub use crate::batch::solve::{fill, solve};
pub use crate::math::simd::Simd;
pub use crate::query::diagnosis::Diagnosis;
pub use crate::state::status::{Fault, Status};
