//! The inverse question: the positions at which a coordinate of the motion has a value.
pub(crate) mod answers;
pub(crate) mod find;
mod follow;
#[allow(clippy::module_inception, reason = "the folder is named after what it answers")]
pub(crate) mod inverse;
mod motion;
pub(crate) mod near;
mod original;
mod place;
