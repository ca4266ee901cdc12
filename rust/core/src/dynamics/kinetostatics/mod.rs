//! Reactions of a machine over given motions: of many designs at many positions, friction included.

mod batch;
mod evaluate;
mod followed;
pub(crate) mod positions;
pub(crate) mod request;
mod squares;
