//! One design, asked: what happened at a position, which assemblies there are, positions in sequence.
pub(crate) mod assemblies;
pub(crate) mod construction;
pub(crate) mod diagnosis;
pub(crate) mod evaluator;
pub mod metrics;
