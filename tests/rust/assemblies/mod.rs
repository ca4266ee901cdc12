//! All assemblies of a position, and the inverse question.
mod counts;
mod inverse;
