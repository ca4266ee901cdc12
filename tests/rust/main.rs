//! Integration tests of the core: one binary, one module per subject.
#![allow(clippy::disallowed_methods, reason = "tests compare with the platform's functions")]

mod assemblies;
mod description;
mod dynamics;
mod fuzzing;
mod kinematics;
mod models;
mod oracles;
mod search;
mod sweep;
