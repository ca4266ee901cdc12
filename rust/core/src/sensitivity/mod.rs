//! Derivatives of positions and analogues by the dimensions of a design, and their products with vectors
//! from either side.
//!
//! Positions are solved first. What follows is linear: the closures of every step, differentiated once more,
//! have the same matrix as the analogues of every order (Uicker, Pennock & Shigley 2017, chapter 3, by complex
//! algebra). Forward, the rates of the dimensions pass through the steps in order. Backward, weights of the
//! results pass through them in reverse, by the transposed equations (the adjoint method: Giles & Pierce
//! 2000): all dimensions in one pass.
mod backward;
mod batch;
mod cone;
mod constants_sum;
mod cotangent;
pub(crate) mod evaluate;
mod inverses;
pub(crate) mod linearization;
pub(crate) mod plan;
mod registers;
pub(crate) mod request;
pub(crate) mod steps;
pub(crate) mod tangent;
