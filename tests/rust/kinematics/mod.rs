//! Positions and analogues.

mod agreement;
mod higher_classes;
mod published_numbers;
mod regressions;
mod two_drivers;
