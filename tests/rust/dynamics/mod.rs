//! Machines that move.

mod machines;
mod many_runs;
