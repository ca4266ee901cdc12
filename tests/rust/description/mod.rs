//! What a linkage is made of.

mod large;
mod named;
