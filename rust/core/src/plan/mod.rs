//! The description compiled: a list of steps, made once, run for any number of
//! designs and positions.
//!
//! The closure equations are split into the smallest blocks that determine
//! something. A block with two unknown rotations or slides is one vector
//! equation (a dyad) solved in closed form; a block with none only places
//! points. A driver appears nowhere as a step: a driven angle makes the
//! orientation of two links differ by q, a driven slide is a known length.

pub(crate) mod binary_links;
pub(crate) mod blocks;
pub(crate) mod compile;
pub(crate) mod constants;
pub(crate) mod constants_rate;
pub(crate) mod dyad;
pub(crate) mod group;
pub(crate) mod group_loops;
pub(crate) mod leg;
pub(crate) mod mechanism;
pub(crate) mod named;
pub(crate) mod pair_span;
pub(crate) mod plan;
pub(crate) mod redundant;
