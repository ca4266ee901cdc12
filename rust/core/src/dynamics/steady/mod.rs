//! Steady states under motors, by shooting, and flywheel sizing.

pub(crate) mod error;
pub(crate) mod flywheel_sizing;
pub(crate) mod options;
pub(crate) mod period;
pub(crate) mod shooting;
pub(crate) mod steady;
