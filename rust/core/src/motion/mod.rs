//! Motions: designs × positions, with analogues.

mod dyad;
mod explain;
mod fit;
mod lift;
pub mod metrics;
mod solve;
mod state;

pub use explain::Diagnosis;
pub use solve::{Coordinates, Motion, Outputs, Request, Track, solve};
pub use state::{Fault, Status};
