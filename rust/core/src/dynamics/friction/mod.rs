//! Coulomb friction in pairs.

mod blocks;
pub(crate) mod motion;
mod newton;
pub(crate) mod pairs;
pub(crate) mod problem;
mod quadrics;
mod rest;
pub(crate) mod reversals;
pub(crate) mod rows;
pub(crate) mod solutions;
mod work;
pub(crate) mod workspace;
