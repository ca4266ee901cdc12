//! Search for the linkage that draws a path: structure and dimensions.

mod cholesky;
mod evolve;
pub(crate) mod for_all;
mod levenberg_marquardt;
mod limits;
mod moments;
mod moves;
mod nearest;
mod normal;
mod objective;
pub(crate) mod path_search;
pub(crate) mod retrieve;
mod slopes;
pub(crate) mod target;
