//! All assemblies of a position.
mod counts;
