//! The time ratio of a motion back and forth.

use std::f64::consts::TAU;

use super::coordinate::Coordinate;
use super::course::Course;
use super::extremes::{Extreme, PlaceOf};
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
        if !positions.returns {
            return f64::NAN;
        }
        let place = |extreme: Extreme| PlaceOf(extreme).of(positions);
        let turned = place(Extreme::Greatest(self.0)) - place(Extreme::Least(self.0));
        let stroke = turned.abs() - TAU * (turned.abs() / TAU).floor();
        let return_stroke = TAU - stroke;
        if stroke > 0.0 { stroke.max(return_stroke) / stroke.min(return_stroke) } else { f64::NAN }
    }

    fn asks_return(&self) -> bool {
        true
    }

    fn check(&self, course: &Course<'_>) -> Result<(), String> {
        course.check_one_driver("the time ratio")?;
        match course.turn {
            Some(_) => Ok(()),
            None => Err("q must go over one turn in even steps, without its end: \
                         np.linspace(0, 2 * np.pi, n, endpoint=False)"
                .into()),
        }
    }
}
