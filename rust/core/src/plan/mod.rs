//! The description compiled: a list of steps, made once, run for any number of
//! designs and positions.
//!
//! The closure equations are split into the smallest blocks that determine
//! something. A block with two unknown rotations or slides is one vector
//! equation (a dyad) solved in closed form; a block with none only places
//! points. A driver appears nowhere as a step: a driven angle makes the
//! orientation of two links differ by q, a driven slide is a known length.

pub mod binary_links;
pub(crate) mod blocks;
pub(crate) mod compile;
pub mod constants;
pub mod constants_rate;
pub mod dyad;
pub mod group;
pub mod group_loops;
pub mod leg;
pub(crate) mod mechanism;
pub(crate) mod named;
pub mod pair_span;
pub mod plan;
pub(crate) mod redundant;
