//! Speed over a period from tables, and flywheel sizing, by the energy integral alone.

pub(crate) mod cycle;
pub(crate) mod flywheel;
