//! Search for the linkage that draws a path: structure and dimensions.

mod evolve;
pub(crate) mod for_all;
mod levenberg_marquardt;
mod moves;
mod nearest;
mod normal;
mod objective;
pub(crate) mod path_search;
pub(crate) mod retrieve;
pub(crate) mod target;
