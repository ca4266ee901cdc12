//! Linkages of one crank and dyads, packed: two numbers a joint, in solving order. Structures vary from
//! one to the next, so nothing is compiled.
//!
//! [`PackedLinkage`](packed::PackedLinkage) is the linkage; [`Course`](course::Course) its positions over a
//! turn; [`adjoint`] their derivatives; [`random`] makes linkages; [`describe`] hands one over to the solver.

pub(crate) mod adjoint;
pub(crate) mod course;
pub(crate) mod describe;
pub(crate) mod packed;
pub(crate) mod random;
