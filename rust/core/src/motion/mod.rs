//! Motions: designs × positions, with analogues.

mod analogue;
mod change;
mod design;
mod dyad;
mod explain;
mod fit;
pub mod metrics;
mod solve;
mod spread;
mod state;
mod track;

pub use explain::Diagnosis;
pub use solve::{Coordinates, Motion, Outputs, Request, Track, solve};
pub use state::{Fault, Status};
