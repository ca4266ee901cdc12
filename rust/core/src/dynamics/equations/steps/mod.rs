//! Steps in time of many environments of a machine, in lanes and threads: even ones by the classical
//! Runge-Kutta method, or of their own widths by embedded pairs, which keep a tolerance.
//!
//! An environment has the bits that it has alone.

mod controlled;
mod controlled_stage;
mod dead_points;
mod environment;
mod even;
mod even_stage;
mod failures;
mod lane_accelerations;
pub(crate) mod request;
mod states;
mod step;
mod step_batch;
mod turns;
