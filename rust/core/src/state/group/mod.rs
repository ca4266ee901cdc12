//! Groups above class II, solved by Newton's method from a guess.

pub(crate) mod analogues;
pub(crate) mod binary_links;
pub(crate) mod equations;
pub(crate) mod newton;
pub(crate) mod solve;
pub(crate) mod turn;
