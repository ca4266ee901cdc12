//! The dimensions of a mechanism for a task: least squares from many starts.
//!
//! Residuals are what joints, links and slides miss of their targets; they and their derivatives by the dimensions
//! come from the solver, a block of designs at a time.
mod assign;
pub(crate) mod conditions;
mod course;
mod descend;
mod evaluate;
pub(crate) mod fit;
mod multipliers;
mod normal;
mod place;
mod point;
pub(crate) mod problem;
mod residuals;
mod start;
mod step;
pub(crate) mod target;
mod turned;
pub(crate) mod variables;

#[cfg(test)]
mod tests;
