//! Published theories with formulas of their own.

pub mod crank_rocker;
pub mod slider_crank;
