//! Coulomb friction in pairs: its law and all its solutions, at positions of a given motion (`rows`) and in
//! the equation of motion (`motion`).

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
mod unloaded;
mod work;
pub(crate) mod workspace;
