//! Numbers, functions and matrices: nothing here knows what a mechanism is.

pub(crate) mod angle;
pub mod derivatives;
pub mod inverse;
pub mod lanes;
pub(crate) mod polynomial;
pub(crate) mod quadrature;
pub(crate) mod root;
pub mod simd;
pub mod tolerance;
pub mod trig;
mod two_over_pi;
pub mod vector;
