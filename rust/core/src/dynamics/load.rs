//! Forces and torques referred to the drivers. By the principle of virtual work each contributes
//! its product with the derivatives of the point or angle it acts on (I. M. Matsyuk &
//! E. M. Shlyakhov, equation 1; Uicker, Pennock & Shigley 2017, chapter 12).

use super::gas::Gas;
use super::kinematics::{Point, SolvedPose};
use super::measure::{Curve, Measure, OneWay, Over};
use super::reduced::Reduced;
use super::value::{Numbers, Value};
use crate::math::vector::Vector;

/// A load on a mechanism, besides the weight of its bodies.
#[derive(Debug, Clone, PartialEq)]
pub enum Load {
    /// A force at a point, N; its components are along the axes of the frame or of a link.
    Force {
        /// The point where it acts.
        at: Point,
        /// Components.
        force: [Value; 2],
        /// The link whose axes they are along; `None`: the frame's.
        axes: Option<usize>,
        /// The link at a joint that takes it; `None`: the first one there.
        on: Option<usize>,
        /// The direction in which it acts, unless it acts in both.
        one_way: Option<OneWay>,
    },
    /// A pressure in the cylinder of a slide: a force along the guide on the sliding link at its
    /// sliding point; its reaction acts on the link that carries the guide.
    Pressure {
        /// The slide.
        slide: usize,
        /// Area of the piston, m²; positive if the pressure drives the sliding link along the guide.
        area: f64,
        /// Absolute pressure, Pa.
        pressure: Value,
        /// Pressure on the other side, Pa.
        ambient: f64,
        /// The direction in which it acts, unless it acts in both.
        one_way: Option<OneWay>,
    },
    /// A torque on a link; its reaction acts on another link (or the frame).
    Torque {
        /// The link.
        link: usize,
        /// The link that takes the reaction.
        on: usize,
        /// N·m, counter-clockwise on the link.
        torque: Value,
        /// The direction in which it acts, unless it acts in both.
        one_way: Option<OneWay>,
    },
    /// A spring between two points; pulls them together when longer than its free length.
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
    /// A torsion spring between two links.
    TorsionSpring {
        /// The link.
        link: usize,
        /// The other link.
        on: usize,
        /// N·m/rad.
        stiffness: f64,
        /// Difference of their angles at which only the preload acts, rad.
        angle: f64,
        /// Restoring torque at that angle, N·m.
        preload: f64,
    },
    /// A damper between two points.
    Damper {
        /// Its ends.
        ends: [Point; 2],
        /// N·s/m.
        damping: f64,
    },
    /// A torsion damper between two links.
    TorsionDamper {
        /// The link.
        link: usize,
        /// The other link.
        on: usize,
        /// N·m·s/rad.
        damping: f64,
    },
}

/// Unit vector from one end to the other, and the distance. The vector is NaN at zero distance;
/// only a spring without tension there can ignore that.
pub(super) fn direction_and_length(pose: &SolvedPose<'_>, ends: [Point; 2]) -> (Vector, f64) {
    let span = pose.point(ends[1], 0) - pose.point(ends[0], 0);
    let length = libm::hypot(span.x, span.y);
    (span.scale(1.0 / length), length)
}

impl Load {
    /// The values that it reads.
    fn values(&self) -> &[Value] {
        match self {
            Self::Force { force, .. } => force,
            Self::Torque { torque, .. } => std::slice::from_ref(torque),
            Self::Pressure { pressure, .. } => std::slice::from_ref(pressure),
            Self::Spring { .. }
            | Self::TorsionSpring { .. }
            | Self::Damper { .. }
            | Self::TorsionDamper { .. } => &[],
        }
    }

    /// Whether it reads angles of links, not only their derivatives.
    pub(crate) fn reads_angles(&self) -> bool {
        match self {
            Self::TorsionSpring { .. } => true,
            Self::Force { .. }
            | Self::Torque { .. }
            | Self::Pressure { .. }
            | Self::Spring { .. }
            | Self::Damper { .. }
            | Self::TorsionDamper { .. } => false,
        }
    }

    /// Whether it reads velocities of points or links, and so does not act at rest.
    pub(crate) fn reads_velocities(&self) -> bool {
        match self {
            Self::Damper { .. } | Self::TorsionDamper { .. } => true,
            Self::Force { .. }
            | Self::Torque { .. }
            | Self::Pressure { .. }
            | Self::Spring { .. }
            | Self::TorsionSpring { .. } => false,
        }
    }

    /// Whether its tables cover the position where `numbers` were read. A load that acts in one direction only
    /// need not have a value everywhere.
    pub(crate) fn is_covered(&self, numbers: Numbers<'_>) -> bool {
        let has_value = |value: &Value| match value {
            Value::Table(_) | Value::Over(_) => !value.at(numbers).is_nan(),
            Value::Number(_) | Value::External(_) => true,
        };
        self.one_way().is_some() || self.values().iter().all(has_value)
    }

    /// The direction in which it acts, if it does not in both.
    pub(crate) fn one_way(&self) -> Option<OneWay> {
        match self {
            Self::Force { one_way, .. }
            | Self::Torque { one_way, .. }
            | Self::Pressure { one_way, .. } => *one_way,
            Self::Spring { .. }
            | Self::TorsionSpring { .. }
            | Self::Damper { .. }
            | Self::TorsionDamper { .. } => None,
        }
    }

    /// The gas in the cylinder of its own slide, if it acts in both directions: a spring.
    fn gas_spring<'o>(&self, over: &'o [Over]) -> Option<&'o Gas> {
        let Self::Pressure { slide, pressure: Value::Over(index), one_way: None, .. } = self else {
            return None;
        };
        match over.get(*index)? {
            Over { measure: Measure::Slide(gas_slide), curve: Curve::Gas(gas) }
                if gas_slide == slide =>
            {
                Some(gas)
            }
            _ => None,
        }
    }

    /// Adds the moments and the potential energy of a spring.
    pub(crate) fn add_conservative(&self, pose: &SolvedPose<'_>, over: &[Over], out: &mut Reduced) {
        match self {
            Self::Pressure { slide, area, ambient, .. } => {
                let Some(gas) = self.gas_spring(over) else { return };
                let at = pose.slide(*slide, 0);
                out.potential += gas.energy(at, *ambient);
                let force = area * (gas.value_and_slope(at)[0] - ambient);
                for (driver, sum) in out.conservative.iter_mut().enumerate() {
                    *sum += force * pose.slide(*slide, SolvedPose::first_order(driver));
                }
            }
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
            Self::Force { .. }
            | Self::Torque { .. }
            | Self::Damper { .. }
            | Self::TorsionDamper { .. } => {}
        }
    }

    /// Adds the moments of any other load at the given speeds.
    pub(crate) fn add_applied(
        &self,
        pose: &SolvedPose<'_>,
        speed: &[f64],
        numbers: Numbers<'_>,
        over: &[Over],
        out: &mut Reduced,
    ) {
        if self.one_way().is_some_and(|one_way| !one_way.acts(numbers.ways)) {
            return;
        }
        let first = SolvedPose::first_order;
        match self {
            Self::Force { at, force: [x, y], axes, .. } => {
                let frame = axis_of(pose, *axes);
                let force = Vector::new(x.at(numbers), y.at(numbers)) * frame;
                for (driver, sum) in out.applied.iter_mut().enumerate() {
                    *sum += force.dot(pose.point(*at, first(driver)));
                }
                let rate = Vector::new(x.d_speed(numbers), y.d_speed(numbers)) * frame;
                out.d_moment_d_speed += rate.dot(pose.point(*at, first(0)));
            }
            Self::Pressure { slide, area, pressure, ambient, .. } => {
                if self.gas_spring(over).is_some() {
                    return;
                }
                let force = area * (pressure.at(numbers) - ambient);
                for (driver, sum) in out.applied.iter_mut().enumerate() {
                    *sum += force * pose.slide(*slide, first(driver));
                }
                out.d_moment_d_speed +=
                    area * pressure.d_speed(numbers) * pose.slide(*slide, first(0));
            }
            Self::Torque { link, on, torque, .. } => {
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

/// Adds a damper across a distance or angle with this rate by each driver.
fn damp(damping: f64, rate: impl Fn(usize) -> f64, speed: &[f64], out: &mut Reduced) {
    let elongation_speed: f64 = speed.iter().enumerate().map(|(driver, s)| s * rate(driver)).sum();
    for (driver, sum) in out.applied.iter_mut().enumerate() {
        *sum += -damping * elongation_speed * rate(driver);
    }
    out.d_moment_d_speed += -damping * rate(0) * rate(0);
}

/// Unit vector along the x axis of a link, or of the frame.
pub(super) fn axis_of(pose: &SolvedPose<'_>, link: Option<usize>) -> Vector {
    link.map_or(Vector::ONE, |link| pose.frame(link, 0))
}

/// Derivative by a driver of a link's angle relative to another link.
pub(super) fn relative_rate(pose: &SolvedPose<'_>, link: usize, on: usize, driver: usize) -> f64 {
    pose.angle(link, SolvedPose::first_order(driver))
        - pose.angle(on, SolvedPose::first_order(driver))
}

/// Derivative by a driver of the distance between two points.
pub(super) fn elongation_rate(
    pose: &SolvedPose<'_>,
    ends: [Point; 2],
    unit: Vector,
    driver: usize,
) -> f64 {
    let k = SolvedPose::first_order(driver);
    unit.dot(pose.point(ends[1], k) - pose.point(ends[0], k))
}
