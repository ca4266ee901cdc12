//! Coulomb friction in pairs.

mod blocks;
pub(crate) mod description;
mod newton;
pub(crate) mod problem;
mod quadrics;
pub(crate) mod solutions;
