//! Roots and extremes of functions of one variable: one file for each method of the literature.

pub(crate) mod all_roots;
pub(crate) mod bisection;
pub(crate) mod double_root;
pub(crate) mod golden_section;
pub(crate) mod illinois;
pub(crate) mod itp;
pub(crate) mod newton;
pub(crate) mod ternary;
