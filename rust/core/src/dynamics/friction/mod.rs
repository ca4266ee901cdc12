//! Coulomb friction in pairs.

mod blocks;
pub(crate) mod description;
pub(crate) mod motion;
mod newton;
pub(crate) mod problem;
mod quadrics;
pub(crate) mod reversals;
pub(crate) mod solutions;
mod work;
