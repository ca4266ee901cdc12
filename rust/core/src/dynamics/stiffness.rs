//! The slope of a machine's reduced moment at rest: minus the second derivative of its potential.
//!
//! The derivative of the principle of virtual work by the coordinate of one driver. A force F at x
//! gives F·x″ + F′·x′ (so does a pressure, along its slide), a spring of length l and tension T gives −(k l′² + T l″), with
//! l″ = u·d″ + (|d′|² − l′²)/l and d = l u the vector between its ends.

use super::kinematics::SolvedPose;
use super::load::{Load, axis_of, direction_and_length, relative_rate};
use super::machine::Machine;
use super::value::Numbers;
use crate::math::vector::Vector;

/// Rough upper bounds of the motion of points and angles with the coordinate: a term that vanishes leaves
/// the rounding of these.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reach {
    /// Metres per unit of the coordinate.
    pub length: f64,
    /// Radians per unit of the coordinate.
    pub angle: f64,
}

/// Slope of the moment by the coordinate, and the size of the terms that add up to the moment.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Slope {
    pub slope: f64,
    pub size: f64,
}

impl Slope {
    fn add(&mut self, slope: f64, size: f64) {
        self.slope += slope;
        self.size += size;
    }
}

impl Machine {
    /// The slope at a position of a machine with one driver, without dampers.
    pub(crate) fn moment_slope(
        &self,
        pose: &SolvedPose<'_>,
        numbers: Numbers<'_>,
        reach: Reach,
    ) -> Slope {
        let mut out = Slope::default();
        let gravity = Vector::new(self.gravity[0], self.gravity[1]);
        let (order1, order2) = (SolvedPose::first_order(0), pose.second_order(0, 0));
        for body in &self.bodies {
            let weight = gravity.scale(body.mass);
            let moved = pose.point(body.at, order1).size() + reach.length;
            out.add(weight.dot(pose.point(body.at, order2)), weight.size() * moved);
        }
        for load in &self.loads {
            load.add_slope(pose, numbers, reach, &mut out);
        }
        out
    }
}

impl Load {
    fn add_slope(
        &self,
        pose: &SolvedPose<'_>,
        numbers: Numbers<'_>,
        reach: Reach,
        out: &mut Slope,
    ) {
        if self.one_way().is_some() {
            // At rest it does not act.
            return;
        }
        let (order1, order2) = (SolvedPose::first_order(0), pose.second_order(0, 0));
        match self {
            Self::Force { at, force: [x, y], axes, .. } => {
                let [x, y] = [x, y].map(|value| value.with_slope(numbers));
                let axis = axis_of(pose, *axes);
                let force = Vector::new(x[0], y[0]) * axis;
                let turned = axes.map_or(0.0, |link| pose.angle(link, order1));
                let rate = Vector::new(x[1], y[1]) * axis + force.left().scale(turned);
                let velocity = pose.point(*at, order1);
                let slope = rate.dot(velocity) + force.dot(pose.point(*at, order2));
                out.add(slope, force.size() * (velocity.size() + reach.length));
            }
            Self::Pressure { slide, area, pressure, ambient, .. } => {
                let [pressure, rate] = pressure.with_slope(numbers);
                let (force, moved) = (area * (pressure - ambient), pose.slide(*slide, order1));
                let slope = area * rate * moved + force * pose.slide(*slide, order2);
                let most = (area * pressure).abs() + (area * ambient).abs();
                out.add(slope, most * (moved.abs() + reach.length));
            }
            Self::Torque { link, on, torque, .. } => {
                let [torque, rate] = torque.with_slope(numbers);
                let turned = relative_rate(pose, *link, *on, 0);
                let slope = rate * turned + torque * second_rate(pose, *link, *on);
                out.add(slope, torque.abs() * (turned.abs() + reach.angle));
            }
            Self::Spring { ends, stiffness, length, preload } => {
                let (unit, distance) = direction_and_length(pose, *ends);
                let span = |k| pose.point(ends[1], k) - pose.point(ends[0], k);
                let (velocity, acceleration) = (span(order1), span(order2));
                let tension = stiffness * (distance - length) + preload;
                let slope = if distance == 0.0 && tension == 0.0 {
                    // With u any direction; |d′| is the rate of the length, either way.
                    stiffness * velocity.dot(velocity)
                } else {
                    let rate = unit.dot(velocity);
                    let across = velocity.dot(velocity) - rate * rate;
                    stiffness * rate * rate + tension * (unit.dot(acceleration) + across / distance)
                };
                let most = stiffness.abs() * (distance + length.abs()) + preload.abs();
                out.add(-slope, most * (velocity.size() + reach.length));
            }
            Self::TorsionSpring { link, on, stiffness, angle, preload } => {
                let [first, second] = [link, on].map(|&link| pose.total_angle(link));
                let moment = stiffness * (first - second - angle) + preload;
                let turned = relative_rate(pose, *link, *on, 0);
                let slope = stiffness * turned * turned + moment * second_rate(pose, *link, *on);
                let most = stiffness.abs() * (first.abs() + second.abs() + angle.abs());
                out.add(-slope, (most + preload.abs()) * (turned.abs() + reach.angle));
            }
            Self::Damper { .. } | Self::TorsionDamper { .. } => {}
        }
    }
}

fn second_rate(pose: &SolvedPose<'_>, link: usize, on: usize) -> f64 {
    let order2 = pose.second_order(0, 0);
    pose.angle(link, order2) - pose.angle(on, order2)
}
