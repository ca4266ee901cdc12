//! The assembly continued along q from the drawing: the sign of each dyad, the unknowns of each
//! group.

pub(crate) mod branch;
pub(crate) mod change_interpolant;
pub(crate) mod change_point;
pub(crate) mod constant_signs;
mod crank_angles;
pub(crate) mod crank_dyad;
pub(crate) mod design;
pub(crate) mod driven_chord;
pub(crate) mod hermite;
pub(crate) mod homotopy;
#[cfg(test)]
mod kernels_agree;
pub(crate) mod knot;
pub(crate) mod lanes;
pub(crate) mod location;
pub(crate) mod position;
pub(crate) mod predictor;
mod refinement;
pub(crate) mod scalar_chord;
mod trace;
pub(crate) mod tracer;
