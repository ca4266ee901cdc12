//! Coordinates that a load may follow besides the first driver: the value of a slide or the angle of a link,
//! and their direction of motion.

use super::gas::Gas;
use super::kinematics::SolvedPose;
use super::tables::table::{Cell, Table};

/// A coordinate of a mechanism.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Measure {
    /// The coordinate of a driver.
    Driver(usize),
    /// The value of a slide, m.
    Slide(usize),
    /// The angle of a link, rad.
    Angle(usize),
}

/// A function of a coordinate.
#[derive(Debug, Clone, PartialEq)]
pub enum Curve {
    /// A table.
    Table(Table),
    /// The pressure of a closed gas.
    Gas(Gas),
}

/// A curve over a coordinate.
#[derive(Debug, Clone, PartialEq)]
pub struct Over {
    /// The coordinate.
    pub measure: Measure,
    /// The curve.
    pub curve: Curve,
}

/// The direction in which a load acts: while a coordinate grows, or falls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OneWay {
    /// Index of one of the machine's [`ways`](super::machine::Machine::ways).
    pub way: usize,
    /// +1 or −1.
    pub sign: f64,
}

/// A coordinate slower than this part of the drivers does not move: its direction is rounding.
const AT_REST: f64 = 1.0e-12;

impl Measure {
    pub(crate) fn at(self, pose: &SolvedPose<'_>, q: &[f64]) -> f64 {
        match self {
            Self::Driver(driver) => q[driver],
            Self::Slide(slide) => pose.slide(slide, 0),
            Self::Angle(link) => pose.total_angle(link),
        }
    }

    /// Derivative by a driver.
    pub(crate) fn rate(self, pose: &SolvedPose<'_>, driver: usize) -> f64 {
        let k = SolvedPose::first_order(driver);
        match self {
            Self::Driver(followed) => f64::from(followed == driver),
            Self::Slide(slide) => pose.slide(slide, k),
            Self::Angle(link) => pose.angle(link, k),
        }
    }

    /// Second derivative by the only driver.
    pub(crate) fn second_rate(self, pose: &SolvedPose<'_>) -> f64 {
        let k = pose.second_order(0, 0);
        match self {
            Self::Driver(_) => 0.0,
            Self::Slide(slide) => pose.slide(slide, k),
            Self::Angle(link) => pose.angle(link, k),
        }
    }

    /// +1 or −1 as it grows or falls at these speeds of the drivers; 0 where it rests.
    pub(crate) fn direction(self, pose: &SolvedPose<'_>, speed: &[f64]) -> f64 {
        let unit = |is_slide: bool| if is_slide { pose.size() } else { 1.0 };
        let (mut rate, mut fastest) = (0.0, 0.0);
        for (driver, speed) in speed.iter().enumerate() {
            rate += self.rate(pose, driver) * speed;
            fastest += (speed * pose.unit(driver)).abs();
        }
        sign(rate, fastest * unit(matches!(self, Self::Slide(_))))
    }
}

/// The sign of a rate; 0 if it is rounding beside the speeds that add up to it.
pub(crate) fn sign(rate: f64, speeds: f64) -> f64 {
    if rate.abs() > AT_REST * speeds { rate.signum() } else { 0.0 }
}

impl Over {
    /// Value and slope by the coordinate, in the given piece of its table or the one that contains it; NaN
    /// beyond the table.
    pub(crate) fn read(&self, at: f64, cell: Option<Cell>) -> [f64; 2] {
        match (&self.curve, cell) {
            (Curve::Table(table), Some(cell)) => table.read(cell, at),
            (Curve::Table(table), None) => table.value_and_slope(at).unwrap_or([f64::NAN; 2]),
            (Curve::Gas(gas), _) => gas.value_and_slope(at),
        }
    }

    pub(crate) fn table(&self) -> Option<&Table> {
        match &self.curve {
            Curve::Table(table) => Some(table),
            Curve::Gas(_) => None,
        }
    }
}

impl OneWay {
    /// Whether the load acts; `ways`: the direction of every coordinate.
    pub(crate) fn acts(self, ways: &[f64]) -> bool {
        ways.get(self.way) == Some(&self.sign)
    }
}
