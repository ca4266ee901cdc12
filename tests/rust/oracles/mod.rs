//! Other methods for the same numbers, which share no code with the core.

pub mod body;
pub mod double_double;
pub mod drawing;
pub mod law;
pub mod newton;
pub mod series;
