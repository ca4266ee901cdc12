//! Questions about one design: a diagnosis of a position, positions in sequence.
pub(crate) mod construction;
pub(crate) mod diagnosis;
pub(crate) mod evaluator;
pub(crate) mod extremes;
pub(crate) mod failure;
pub(crate) mod folding;
pub(crate) mod lane_evaluator;
pub(crate) mod limits;
pub mod metrics;
