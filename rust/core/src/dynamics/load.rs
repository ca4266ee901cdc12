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
    /// A spring between two points; pulls them together when it is longer than free.
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
fn along(pose: &Pose<'_>, ends: [Point; 2]) -> (Vector, f64) {
    let span = pose.point(ends[1], 0) - pose.point(ends[0], 0);
    let length = libm::hypot(span.x, span.y);
    (span.scale(1.0 / length), length)
}

impl Load {
    /// Adds the force of a spring, which its energy tells, and that energy.
    pub(crate) fn store(&self, pose: &Pose<'_>, out: &mut Reduced) {
        match self {
            Self::Spring { ends, stiffness, length, preload } => {
                let (unit, now) = along(pose, *ends);
                let longer = now - length;
                out.potential += (0.5 * stiffness * longer + preload) * longer;
                let tension = stiffness * longer + preload;
                if now == 0.0 && tension == 0.0 {
                    return;
                }
                for (driver, sum) in out.stored.iter_mut().enumerate() {
                    *sum += -tension * growing(pose, *ends, unit, driver);
                }
            }
            Self::TorsionSpring { link, on, stiffness, angle, preload } => {
                let apart = pose.turned(*link) - pose.turned(*on) - angle;
                out.potential += (0.5 * stiffness * apart + preload) * apart;
                let back = stiffness * apart + preload;
                for (driver, sum) in out.stored.iter_mut().enumerate() {
                    *sum += -back * turning(pose, *link, *on, driver);
                }
            }
            _ => {}
        }
    }

    /// Adds what anything but a spring does to every driver at speeds.
    pub(crate) fn apply(
        &self,
        pose: &Pose<'_>,
        speed: &[f64],
        numbers: Numbers<'_>,
        out: &mut Reduced,
    ) {
        let first = Pose::first;
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
                let rate = Vector::new(x.by_speed(numbers), y.by_speed(numbers)) * frame;
                out.by_speed += rate.dot(pose.point(*at, first(0)));
            }
            Self::Torque { link, on, torque } => {
                let now = torque.at(numbers);
                for (driver, sum) in out.applied.iter_mut().enumerate() {
                    *sum += now * turning(pose, *link, *on, driver);
                }
                out.by_speed += torque.by_speed(numbers) * turning(pose, *link, *on, 0);
            }
            Self::Damper { ends, damping } => {
                let (unit, _) = along(pose, *ends);
                let rate = |driver: usize| growing(pose, *ends, unit, driver);
                damp(*damping, rate, speed, out);
            }
            Self::TorsionDamper { link, on, damping } => {
                damp(*damping, |driver| turning(pose, *link, *on, driver), speed, out);
            }
            Self::Spring { .. } | Self::TorsionSpring { .. } => {}
        }
    }
}

/// Adds a damper of something that grows at a rate with every driver.
fn damp(damping: f64, rate: impl Fn(usize) -> f64, speed: &[f64], out: &mut Reduced) {
    let growing: f64 = speed.iter().enumerate().map(|(driver, s)| s * rate(driver)).sum();
    for (driver, sum) in out.applied.iter_mut().enumerate() {
        *sum += -damping * growing * rate(driver);
    }
    out.by_speed += -damping * rate(0) * rate(0);
}

/// How a link turns against another with a driver.
fn turning(pose: &Pose<'_>, link: usize, on: usize, driver: usize) -> f64 {
    pose.angle(link, Pose::first(driver)) - pose.angle(on, Pose::first(driver))
}

/// How a distance grows with a driver.
fn growing(pose: &Pose<'_>, ends: [Point; 2], unit: Vector, driver: usize) -> f64 {
    let k = Pose::first(driver);
    unit.dot(pose.point(ends[1], k) - pose.point(ends[0], k))
}
