//! Functions of the driver's coordinate or speed, given by points.

pub(crate) mod columns;
pub(crate) mod error;
mod monotone;
pub(crate) mod passes;
pub(crate) mod spline;
pub(crate) mod table;
