//! Speed over a period of tables, and the flywheel that evens it, by the energy integral alone.

pub(crate) mod cycle;
pub(crate) mod flywheel;
