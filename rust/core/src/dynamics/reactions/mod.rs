//! Reactions: forces in the pairs, and the torques and forces of the drivers.
//!
//! The closure equations of a position read `Ψ(y, v) = 0`, where `y` are the unknowns of a group
//! and `v` what carries it. Ideal pairs do no work, so with the loads `W` on `y` the forces `λ` in
//! the cut pairs follow from the transposed matrix of the position, `(∂Ψ/∂y)ᵀ λ = −W`, and the
//! group loads its carriers by `W_v + (∂Ψ/∂v)ᵀ λ` (Artobolevsky 1988, chapter 13: each Assur group
//! is statically determinate, the last one first).

pub(crate) mod applied;
pub(crate) mod columns;
pub(crate) mod force_plan;
pub(crate) mod lane_numbers;
pub(crate) mod lane_rows;
pub(crate) mod load_actions;
pub(crate) mod moments;
pub(crate) mod pair_forces;
pub(crate) mod redundant;
pub(crate) mod scene;
pub(crate) mod steps;
pub(crate) mod transposed;
