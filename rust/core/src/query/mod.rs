//! Questions about one design: a diagnosis of a position, its assemblies, positions in sequence.
pub(crate) mod assemblies;
pub(crate) mod construction;
pub(crate) mod diagnosis;
pub(crate) mod evaluator;
pub(crate) mod failure;
pub mod metrics;
