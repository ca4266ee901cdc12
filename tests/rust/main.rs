//! Integration tests of the core: one binary, one module per subject.
#![allow(clippy::disallowed_methods, reason = "tests compare with the platform's functions")]

mod agreement;
mod assembly;
mod body;
mod builder;
mod double_double;
mod drawing;
mod found;
mod fuzz;
mod higher;
mod law;
mod linkages;
mod long;
mod motion;
mod newton;
mod numbers;
mod random;
mod series;
mod structure;
