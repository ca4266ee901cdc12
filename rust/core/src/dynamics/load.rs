//! Forces and torques, referred to the drivers: by the principle of virtual work each counts as its
//! product with the derivatives of what it acts on (I. M. Matsyuk & E. M. Shlyakhov, equation 1; Uicker,
//! Pennock & Shigley 2017, chapter 12).

use super::pose::{Point, Pose};
use super::table::Value;
use crate::plane::Vector;

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

/// Unit vector of a distance, and the distance; of none no direction.
fn along(pose: &Pose<'_>, ends: [Point; 2]) -> (Vector, f64) {
    let span = pose.point(ends[1], 0) - pose.point(ends[0], 0);
    let length = span.x.hypot(span.y);
    (span.scale(1.0 / length), length)
}

impl Load {
    /// Adds what it does to every driver; `q`: the first driver's coordinate, `speed`: of all.
    pub(super) fn add(
        &self,
        pose: &Pose<'_>,
        q: f64,
        speed: &[f64],
        given: &[f64],
        sums: &mut [f64],
    ) {
        let first = Pose::first;
        match self {
            Self::Force { at, force: [x, y], axes } => {
                let mut force = Vector::new(x.at(q, given), y.at(q, given));
                if let Some(link) = *axes {
                    let frame = |at| pose.point(Point::Link { link, at }, 0);
                    force = force * (frame([1.0, 0.0]) - frame([0.0; 2]));
                }
                for (driver, sum) in sums.iter_mut().enumerate() {
                    *sum += force.dot(pose.point(*at, first(driver)));
                }
            }
            Self::Torque { link, on, torque } => {
                let torque = torque.at(q, given);
                for (driver, sum) in sums.iter_mut().enumerate() {
                    *sum += torque * turning(pose, *link, *on, driver);
                }
            }
            Self::Spring { ends, stiffness, length, preload } => {
                let (unit, now) = along(pose, *ends);
                let tension = stiffness * (now - length) + preload;
                for (driver, sum) in sums.iter_mut().enumerate() {
                    *sum += -tension * growing(pose, *ends, unit, driver);
                }
            }
            Self::TorsionSpring { link, on, stiffness, angle, preload } => {
                let apart = pose.turned(*link) - pose.turned(*on);
                let back = stiffness * (apart - angle) + preload;
                for (driver, sum) in sums.iter_mut().enumerate() {
                    *sum += -back * turning(pose, *link, *on, driver);
                }
            }
            Self::Damper { ends, damping } => {
                let (unit, _) = along(pose, *ends);
                let rate = |driver: usize| growing(pose, *ends, unit, driver);
                let closing: f64 = speed.iter().enumerate().map(|(d, s)| s * rate(d)).sum();
                for (driver, sum) in sums.iter_mut().enumerate() {
                    *sum += -damping * closing * rate(driver);
                }
            }
            Self::TorsionDamper { link, on, damping } => {
                let rate = |driver: usize| turning(pose, *link, *on, driver);
                let turning: f64 = speed.iter().enumerate().map(|(d, s)| s * rate(d)).sum();
                for (driver, sum) in sums.iter_mut().enumerate() {
                    *sum += -damping * turning * rate(driver);
                }
            }
        }
    }

    /// Energy stored in it, J.
    pub(super) fn energy(&self, pose: &Pose<'_>) -> f64 {
        match self {
            Self::Spring { ends, stiffness, length, preload } => {
                let (_, now) = along(pose, *ends);
                let longer = now - length;
                (0.5 * stiffness * longer + preload) * longer
            }
            Self::TorsionSpring { link, on, stiffness, angle, preload } => {
                let apart = pose.turned(*link) - pose.turned(*on) - angle;
                (0.5 * stiffness * apart + preload) * apart
            }
            _ => 0.0,
        }
    }
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
