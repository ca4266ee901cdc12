//! The assembly continued along q from the drawing: the sign of each dyad, the unknowns of each
//! group.

pub(crate) mod branch;
pub(crate) mod cell_test;
pub(crate) mod change_interpolant;
pub(crate) mod change_point;
mod crank_angles;
pub(crate) mod crank_dyad;
pub(crate) mod design;
mod gap_end;
mod gap_ends;
mod grid;
pub(crate) mod hermite;
pub(crate) mod homotopy;
pub(crate) mod knot;
pub(crate) mod lane_tracer;
pub(crate) mod location;
pub(crate) mod position;
pub(crate) mod predictor;
pub(crate) mod scalar_chord;
mod scan;
mod survey;
mod trace;
pub(crate) mod tracer;
pub(crate) mod uniform;
pub(crate) mod units;
