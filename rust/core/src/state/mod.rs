//! One position at q: the poses of all links, their analogues, condition and status.

pub(crate) mod closing;
pub(crate) mod closures;
pub(crate) mod dyad;
pub(crate) mod group;
pub(crate) mod kernel;
pub(crate) mod own_condition;
pub(crate) mod points;
pub(crate) mod redundant;
pub(crate) mod state;
pub(crate) mod status;
pub(crate) mod tape;
