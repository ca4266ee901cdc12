//! Forces and torques, referred to the drivers: by the principle of virtual work each counts as its
//! product with the derivatives of what it acts on (I. M. Matsyuk & E. M. Shlyakhov, equation 1; Uicker,
//! Pennock & Shigley 2017, chapter 12).

use super::kinematics::{Point, Pose};
use super::reduced::Reduced;
use super::value::{Numbers, Value};
use crate::math::vector::Vector;

/// What acts on a mechanism besides its weight.
#[derive(Debug, Clone, PartialEq)]
pub enum Load {
    /// A force (N) at a point, along the frame's axes or those of a link.
    Force {
        /// Where it acts.
        at: Point,
        /// Components.
        force: [Value; 2],
        /// The link whose axes these are along.
        axes: Option<usize>,
    },
    /// A torque (N·m) on a link, its reaction on another (or the frame).
    Torque {
        /// The link.
        link: usize,
        /// Its counterpart.
        on: usize,
        /// Counter-clockwise on the link.
        torque: Value,
    },
    /// A spring between two points; pulls them together when it is elongation than free.
    Spring {
        /// Its ends.
        ends: [Point; 2],
        /// N/m.
        stiffness: f64,
        /// Free length, m.
        length: f64,
        /// Tension at the free length, N.
        preload: f64,
    },
    /// A spring between two links; turns them back.
    TorsionSpring {
        /// The link.
        link: usize,
        /// The other.
        on: usize,
        /// N·m/rad.
        stiffness: f64,
        /// Difference of their angles without load, rad.
        angle: f64,
        /// Torque back at that, N·m.
        preload: f64,
    },
    /// A damper between two points.
    Damper {
        /// Its ends.
        ends: [Point; 2],
        /// N·s/m.
        damping: f64,
    },
    /// A damper between two links.
    TorsionDamper {
        /// The link.
        link: usize,
        /// The other.
        on: usize,
        /// N·m·s/rad.
        damping: f64,
    },
}

/// Unit vector of a distance, and the distance; of none no direction (unless a spring has no force
/// there either).
fn direction_and_length(pose: &Pose<'_>, ends: [Point; 2]) -> (Vector, f64) {
    let span = pose.point(ends[1], 0) - pose.point(ends[0], 0);
    let length = libm::hypot(span.x, span.y);
    (span.scale(1.0 / length), length)
}

impl Load {
    /// Adds the force of a spring, which its energy tells, and that energy.
    pub(crate) fn add_conservative(&self, pose: &Pose<'_>, out: &mut Reduced) {
        match self {
            Self::Spring { ends, stiffness, length, preload } => {
                let (unit, distance) = direction_and_length(pose, *ends);
                let elongation = distance - length;
                out.potential += (0.5 * stiffness * elongation + preload) * elongation;
                let tension = stiffness * elongation + preload;
                if distance == 0.0 && tension == 0.0 {
                    return;
                }
                for (driver, sum) in out.conservative.iter_mut().enumerate() {
                    *sum += -tension * elongation_rate(pose, *ends, unit, driver);
                }
            }
            Self::TorsionSpring { link, on, stiffness, angle, preload } => {
                let twist = pose.total_angle(*link) - pose.total_angle(*on) - angle;
                out.potential += (0.5 * stiffness * twist + preload) * twist;
                let moment = stiffness * twist + preload;
                for (driver, sum) in out.conservative.iter_mut().enumerate() {
                    *sum += -moment * relative_rate(pose, *link, *on, driver);
                }
            }
            _ => {}
        }
    }

    /// Adds what anything but a spring does to every driver at speeds.
    pub(crate) fn add_applied(
        &self,
        pose: &Pose<'_>,
        speed: &[f64],
        numbers: Numbers<'_>,
        out: &mut Reduced,
    ) {
        let first = Pose::first_order;
        match self {
            Self::Force { at, force: [x, y], axes } => {
                let frame = axes.map_or(Vector::ONE, |link| {
                    let frame = |at| pose.point(Point::Link { link, at }, 0);
                    frame([1.0, 0.0]) - frame([0.0; 2])
                });
                let force = Vector::new(x.at(numbers), y.at(numbers)) * frame;
                for (driver, sum) in out.applied.iter_mut().enumerate() {
                    *sum += force.dot(pose.point(*at, first(driver)));
                }
                let rate = Vector::new(x.d_speed(numbers), y.d_speed(numbers)) * frame;
                out.d_moment_d_speed += rate.dot(pose.point(*at, first(0)));
            }
            Self::Torque { link, on, torque } => {
                let moment = torque.at(numbers);
                for (driver, sum) in out.applied.iter_mut().enumerate() {
                    *sum += moment * relative_rate(pose, *link, *on, driver);
                }
                out.d_moment_d_speed +=
                    torque.d_speed(numbers) * relative_rate(pose, *link, *on, 0);
            }
            Self::Damper { ends, damping } => {
                let (unit, _) = direction_and_length(pose, *ends);
                let rate = |driver: usize| elongation_rate(pose, *ends, unit, driver);
                damp(*damping, rate, speed, out);
            }
            Self::TorsionDamper { link, on, damping } => {
                damp(*damping, |driver| relative_rate(pose, *link, *on, driver), speed, out);
            }
            Self::Spring { .. } | Self::TorsionSpring { .. } => {}
        }
    }
}

/// Adds a damper of something that grows at a rate with every driver.
fn damp(damping: f64, rate: impl Fn(usize) -> f64, speed: &[f64], out: &mut Reduced) {
    let elongation_speed: f64 = speed.iter().enumerate().map(|(driver, s)| s * rate(driver)).sum();
    for (driver, sum) in out.applied.iter_mut().enumerate() {
        *sum += -damping * elongation_speed * rate(driver);
    }
    out.d_moment_d_speed += -damping * rate(0) * rate(0);
}

/// How a link turns against another with a driver.
fn relative_rate(pose: &Pose<'_>, link: usize, on: usize, driver: usize) -> f64 {
    pose.angle(link, Pose::first_order(driver)) - pose.angle(on, Pose::first_order(driver))
}

/// How a distance grows with a driver.
fn elongation_rate(pose: &Pose<'_>, ends: [Point; 2], unit: Vector, driver: usize) -> f64 {
    let k = Pose::first_order(driver);
    unit.dot(pose.point(ends[1], k) - pose.point(ends[0], k))
}
