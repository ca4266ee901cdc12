//! What the bytes mean and what must hold: shared with the tests of the core.

#[path = "../../tests/rust/fuzz/mod.rs"]
mod fuzz;
#[path = "../../tests/rust/models"]
mod models {
    pub mod assembly;
    pub mod builder;
}

pub use fuzz::description::description;
pub use fuzz::solve::solve;
pub use fuzz::structure::structure;
