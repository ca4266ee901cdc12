//! The theory of two papers that has formulas of its own.
pub mod crank_rocker;
pub mod slider_crank;
