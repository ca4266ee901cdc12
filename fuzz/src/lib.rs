//! What the bytes mean and what must hold: shared with the tests of the core.

#[path = "../../tests/rust/fuzzing/mod.rs"]
mod fuzzing;
#[path = "../../tests/rust/models"]
mod models {
    pub mod assembly;
    pub mod builder;
}

pub use fuzzing::description::description;
pub use fuzzing::solve::solve;
pub use fuzzing::structure::structure;
