//! The compiled description: a list of steps, compiled once and run for any number of designs and
//! positions.
//!
//! The closure equations are split into the smallest blocks that can be solved one after another.
//! A block with two unknown rotations or slides is one vector equation (a dyad) with a closed
//! form; a block with more is a group above class II; a block with none only places points. No
//! step is needed for a driver: a driven angle makes the orientations of two links differ by q,
//! and a driven slide is a known length.

pub(crate) mod binary_links;
pub(crate) mod blocks;
pub(crate) mod compile;
pub(crate) mod compile_tape;
pub(crate) mod constants;
pub(crate) mod constants_rate;
pub(crate) mod curvature;
pub(crate) mod dyad;
pub(crate) mod dyad_constants;
pub(crate) mod group;
pub(crate) mod group_loops;
pub(crate) mod leg;
pub(crate) mod lengths;
pub(crate) mod mechanism;
pub(crate) mod named;
pub(crate) mod pair_span;
pub(crate) mod plan;
pub(crate) mod redraw;
pub(crate) mod redundant;
pub(crate) mod tape;
pub(crate) mod work_spaces;
