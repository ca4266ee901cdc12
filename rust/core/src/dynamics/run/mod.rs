//! Motion of machines under their loads and motors.

pub(crate) mod broken;
pub(crate) mod cycle;
pub(crate) mod equation;
pub(crate) mod evened;
pub(crate) mod make;
pub(crate) mod outcome;
pub(crate) mod outside;
pub(crate) mod reader;
pub(crate) mod shooting;
pub(crate) mod source;
pub(crate) mod steady;
pub(crate) mod tail;
pub(crate) mod task;
pub(crate) mod tolerances;
pub(crate) mod unsteady;
pub(crate) mod way;
