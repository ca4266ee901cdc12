//! The equations of motion of designs at positions: mass matrices, what else the drivers must give, and
//! accelerations.
//!
//! With S and Θ the places and angles of the links, and their derivatives by the drivers' coordinates q,
//! `M(q) q̈ + b(q, q̇) = τ`, where `M = Σ m ∂Sᵀ∂S + I ∂Θᵀ∂Θ` and `−b` are the loads, weights and inertia
//! forces at q̈ = 0, by virtual work (Uicker, Pennock & Shigley 2017, chapters 12 and 15). Positions are those
//! of the core's `batch/`: no path is followed for angles that no load reads.

mod batch;
mod bodies;
mod derivatives;
mod direct;
mod dual_row;
mod equation_batch;
mod evaluate;
pub(crate) mod plan;
pub(crate) mod request;
mod solve;
pub(crate) mod steps;
