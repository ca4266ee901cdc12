//! Dyads: groups of class II, solved in closed form.

pub(crate) mod analogues;
pub(crate) mod closed_form;
pub(crate) mod discriminant;
pub(crate) mod rrr;
pub(crate) mod solve;
