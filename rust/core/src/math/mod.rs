//! Arithmetic, functions and small matrices, independent of mechanisms.

pub(crate) mod angle;
pub(crate) mod complex_roots;
pub(crate) mod derivatives;
pub(crate) mod dual;
pub(crate) mod inverse;
pub mod lanes;
pub(crate) mod pair;
pub(crate) mod polyline;
pub(crate) mod polynomial;
pub(crate) mod quadrature;
pub(crate) mod random;
#[cfg(target_arch = "x86_64")]
pub(crate) mod registers;
pub(crate) mod room;
pub(crate) mod root;
pub(crate) mod simd;
pub(crate) mod stride;
pub mod tolerance;
pub mod trig;
mod two_over_pi;
pub(crate) mod vector;
