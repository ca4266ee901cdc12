//! Metrics that compare a motion with a target: a path, a function or poses.

mod chamfer;
mod curve;
mod feet;
mod function;
mod ordered;
mod path;
mod path_target;
mod pose;
mod start;

pub use function::{Fitted, FunctionError};
pub use path::{PathDistance, PathError};
pub use pose::PoseError;
