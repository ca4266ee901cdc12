//! Machines that move.

mod machines;
