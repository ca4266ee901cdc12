//! Search for the linkage that draws a path: structure and dimensions.

mod cholesky;
mod evolve;
mod for_all;
mod levenberg_marquardt;
mod limits;
mod moments;
mod moves;
mod nearest;
mod normal;
mod objective;
pub(crate) mod path_search;
mod retrieve;
mod slopes;
mod target;
