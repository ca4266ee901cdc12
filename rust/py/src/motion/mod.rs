//! The motion of designs for Python, and its derivatives by dimensions.

pub(crate) mod sensitivity;
pub(crate) mod short_calls;
pub(crate) mod solve;
