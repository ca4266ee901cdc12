//! Changes of a linkage's structure and dimensions, which evolution proposes.

pub(crate) mod attach;
pub(crate) mod collapse;
pub(crate) mod offset;
pub(crate) mod perturb;
pub(crate) mod propose;
pub(crate) mod reattach;
pub(crate) mod traced;
