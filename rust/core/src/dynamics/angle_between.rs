//! Acute angles between two lines of a mechanism, such as transmission angles.

use std::f64::consts::FRAC_PI_2;

use super::kinematics::{Point, SolvedPose};
use crate::math::trig::atan2;
use crate::math::vector::Vector;

/// A line of a mechanism.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Line {
    /// Through two points.
    Through(Point, Point),
    /// Fixed to a link, at this angle in the link's frame.
    Along(usize, f64),
}

/// The acute angle between two lines, or its complement to a right angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Angle {
    /// The two lines.
    pub lines: [Line; 2],
    /// Whether this is the complement (at a slide it is the pressure angle).
    pub complement: bool,
}

impl Angle {
    pub(crate) fn at(&self, pose: &SolvedPose<'_>) -> f64 {
        let [a, b] = self.lines.map(|line| match line {
            Line::Through(from, to) => pose.point(to, 0) - pose.point(from, 0),
            Line::Along(link, angle) => {
                let direction = Vector::at_angle(angle);
                let position = |at| pose.point(Point::Link { link, at }, 0);
                position([direction.x, direction.y]) - position([0.0; 2])
            }
        });
        let acute = atan2(a.cross(b).abs(), a.dot(b).abs());
        if self.complement { FRAC_PI_2 - acute } else { acute }
    }
}
