//! Published theories with their own formulas.

pub mod crank_rocker;
pub mod slider_crank;
