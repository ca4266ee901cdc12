//! Branches traced by evenly spaced knots, several in a register: the uniform branch of a turn, and the
//! motion beyond gaps.

mod cell_test;
mod gap_end;
mod gap_ends;
pub(crate) mod grid;
mod groups;
pub(crate) mod lane_tracer;
pub(crate) mod reference_branch;
mod scan;
mod survey;
mod surveyed_angle;
pub(crate) mod uniform;
mod winding;
