//! The crank-rocker with friction, in its paper's own convention.
//!
//! Crank l₁ at A, coupler l₂, rocker l₃ at D, ground l₄ = AD, which may move; φ₁ counts from where
//! the crank's pin is farthest from D. V. K. Manzhosov and T. E. Petrova, Modelling of the motion of
//! the crank-rocker mechanism with non-ideal constraints (in Russian), sections 1 and 2.

mod motion;
mod run;
mod zone;

pub use motion::{Assembly, Lengths, Position, Rates, position};
pub use run::{Case, Event, Kind, Refused, Row, Side, run};
pub use zone::{
    Grashof, crank_turns, grashof, ground_range, least_gamma, margins, transmission_extremes,
};
