//! Periodic motions under a motor, by shooting, and the flywheel that evens them.

pub(crate) mod error;
pub(crate) mod flywheel_sizing;
pub(crate) mod options;
pub(crate) mod period;
pub(crate) mod shooting;
pub(crate) mod steady;
