//! The time ratio of a motion to and fro.

use std::f64::consts::TAU;

use super::coordinate::Coordinate;
use super::extremes::Extreme;
use super::metric::{Metric, Need, Positions};

/// The time of the slower stroke between the extremes of a coordinate, as a part of that of the
/// quicker one, at a constant speed of the driver (Uicker, Pennock and Shigley, *Theory of Machines
/// and Mechanisms*, advance-to-return ratio): at least 1. The positions cover one turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TimeRatio(pub Coordinate);

impl Metric for TimeRatio {
    fn needs(&self) -> Vec<Need> {
        vec![self.0.need]
    }

    fn of(&self, positions: &Positions<'_>) -> f64 {
        let place = |extreme: Extreme| super::extremes::PlaceOf(extreme).of(positions);
        let turned = place(Extreme::Greatest(self.0)) - place(Extreme::Least(self.0));
        let one = turned.abs() - TAU * (turned.abs() / TAU).floor();
        let other = TAU - one;
        if one > 0.0 { one.max(other) / one.min(other) } else { f64::NAN }
    }
}
