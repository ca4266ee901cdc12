//! Embedded Runge-Kutta pairs: their coefficients, the arithmetic of one step, dense output in it.

pub(crate) mod dense;
pub(crate) mod dop853;
pub(crate) mod estimate;
pub(crate) mod stages;
pub(crate) mod tableau;
