//! Linkages, named and random.

pub mod assembly;
pub mod builder;
pub mod linkages;
pub mod random;
