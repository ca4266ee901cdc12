//! The theory of the papers on the slider-crank and the crank-rocker.

pub(crate) mod crank_rocker;
pub(crate) mod slider_crank;
