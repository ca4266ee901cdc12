//! Where an assembly exists: intervals of the driver's coordinate, dead points, turns until the motion
//! closes.

mod chart;
pub(crate) mod crank_stretches;
pub(crate) mod finder;
mod search;
pub(crate) mod stretch;
