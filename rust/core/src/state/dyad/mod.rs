//! Dyads: groups of class II, solved in closed form.

pub(crate) mod analogues;
mod chord;
pub(crate) mod conditions;
pub(crate) mod discriminant;
mod guide_chord;
pub(crate) mod intersections;
mod moving_guide;
pub(crate) mod sample;
pub(crate) mod solve;
pub(crate) mod standing_guide;
pub(crate) mod standing_guides;
pub(crate) mod turning_guide;
mod turning_leg;
pub(crate) mod two_legs;
