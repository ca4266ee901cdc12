//! What the bytes mean and what must hold: shared with the tests of the core.

#[path = "../../tests/rust/assembly.rs"]
mod assembly;
#[path = "../../tests/rust/builder.rs"]
mod builder;
#[path = "../../tests/rust/fuzz/mod.rs"]
mod fuzz;

pub use fuzz::description::description;
pub use fuzz::solve::solve;
pub use fuzz::structure::structure;
