//! A plan with the numbers of one design.

use super::Plan;
use crate::linkage::{Dimension, Dimensions, Linkage};
use crate::plane::Vector;
use crate::structure::closure::Span;

/// The fixed vectors of one design, in units of its scale.
#[derive(Debug, Clone, PartialEq)]
pub struct Bound {
    /// Power of two near the greatest length; results are multiplied by it.
    pub scale: f64,
    /// Place of the frame's origin in the drawing, m: the first ground joint.
    pub origin: [f64; 2],
    /// Constant part of every edge, in the frame of its class.
    pub rigid: Vec<Vector>,
    /// Guide direction of every edge with a slide, in the frame of its class.
    pub guide: Vec<Vector>,
    /// Places of the points fixed to the ground.
    pub fixed: Vec<Vector>,
    /// Constant angle of every link against its class, rad.
    pub offset: Vec<f64>,
    /// The same as a unit vector.
    pub turn: Vec<Vector>,
    /// Turn from the carrying to the sliding link of every slide.
    pub slide_turn: Vec<Vector>,
    /// Greatest distance between points that turn with a class.
    pub lever: Vec<f64>,
}

impl Bound {
    /// Binds a plan to dimensions (in the order of [`Dimensions`]).
    #[must_use]
    pub fn new(plan: &Plan, linkage: &Linkage, dimensions: &Dimensions, values: &[f64]) -> Self {
        let read = Reader { dimensions, values };
        let origin = ground_origin(linkage, &read);
        let scale = scale(plan, linkage, &read, origin);
        let offset: Vec<f64> = plan
            .rotation
            .iter()
            .map(|r| {
                // Written as a sum from the first link on, so that 0 stays 0.
                r.slides.iter().fold(0.0, |angle, &(slide, sign)| {
                    let step = read.slide_angle(slide) - read.slide_link_angle(slide);
                    if sign > 0 { angle + step } else { angle - step }
                })
            })
            .collect();
        let turn: Vec<Vector> = offset.iter().map(|&a| unit(a)).collect();
        let slide_turn = (0..linkage.slides.len())
            .map(|s| unit(read.slide_angle(s) - read.slide_link_angle(s)))
            .collect();
        let unit_of = 1.0 / scale;
        let mut rigid = Vec::new();
        let mut guide = Vec::new();
        for e in &plan.edges {
            let (w, d) = match e.edge.span {
                Span::Joint { link, joint } => (read.joint(linkage, link, joint), Vector::ZERO),
                Span::Guide { slide } => {
                    let direction = unit(read.slide_angle(slide));
                    let mut start = read.slide_origin(slide);
                    if linkage.slides[slide].on == linkage.ground
                        && linkage.slides[slide].origin.is_none()
                    {
                        start = start - Vector::new(origin[0], origin[1]);
                    }
                    (start + direction.left().scale(read.slide_offset(slide)), direction)
                }
            };
            let turn = turn[e.edge.link];
            rigid.push((turn * w).scale(unit_of));
            guide.push(turn * d);
        }
        let mut fixed = vec![Vector::ZERO; plan.points];
        for &joint in &linkage.links[linkage.ground].joints {
            let at = read.ground(joint);
            fixed[joint + 1] = (at - Vector::new(origin[0], origin[1])).scale(unit_of);
        }
        let mut lever = vec![0.0_f64; plan.classes];
        for (e, w) in plan.edges.iter().zip(&rigid) {
            let class = plan.orientations[e.orientation].class;
            // A coupler point farther than the rest is itself the size that its error
            // is a part of.
            let arm = if e.paired { w.norm() } else { w.norm().min(1.0) };
            lever[class] = lever[class].max(arm);
        }
        Self { scale, origin, rigid, guide, fixed, offset, turn, slide_turn, lever }
    }
}

/// Unit vector at an angle, exact for no turn.
fn unit(angle: f64) -> Vector {
    if angle == 0.0 { Vector::ONE } else { Vector::at_angle(angle) }
}

struct Reader<'a> {
    dimensions: &'a Dimensions,
    values: &'a [f64],
}

impl Reader<'_> {
    /// The value of a dimension, 0 where the linkage has none of the kind.
    fn get(&self, wanted: Dimension) -> f64 {
        self.dimensions.iter().position(|(_, d)| d == wanted).map_or(0.0, |i| self.values[i])
    }

    fn ground(&self, joint: usize) -> Vector {
        Vector::new(self.get(Dimension::GroundX { joint }), self.get(Dimension::GroundY { joint }))
    }

    /// A joint in the frame of its link.
    fn joint(&self, linkage: &Linkage, link: usize, joint: usize) -> Vector {
        match linkage.links[link].joints.iter().position(|&j| j == joint) {
            Some(0) => Vector::ZERO,
            Some(1) => Vector::new(self.get(Dimension::Length { link }), 0.0),
            _ => Vector::new(
                self.get(Dimension::JointX { link, joint }),
                self.get(Dimension::JointY { link, joint }),
            ),
        }
    }

    fn slide_angle(&self, slide: usize) -> f64 {
        self.get(Dimension::SlideAngle { slide })
    }

    fn slide_link_angle(&self, slide: usize) -> f64 {
        self.get(Dimension::SlideLinkAngle { slide })
    }

    fn slide_offset(&self, slide: usize) -> f64 {
        self.get(Dimension::SlideOffset { slide })
    }

    fn slide_origin(&self, slide: usize) -> Vector {
        Vector::new(
            self.get(Dimension::SlideOriginX { slide }),
            self.get(Dimension::SlideOriginY { slide }),
        )
    }
}

/// The first ground joint; without one the drawing's own origin.
fn ground_origin(linkage: &Linkage, read: &Reader<'_>) -> [f64; 2] {
    linkage.links[linkage.ground].joints.first().map_or([0.0; 2], |&joint| {
        let at = read.ground(joint);
        [at.x, at.y]
    })
}

/// Power of two at or below the greatest length.
fn scale(plan: &Plan, linkage: &Linkage, read: &Reader<'_>, origin: [f64; 2]) -> f64 {
    let paired = |joint: usize| {
        plan.edges
            .iter()
            .any(|e| e.paired && matches!(e.edge.span, Span::Joint { joint: j, .. } if j == joint))
    };
    let mut greatest = 0.0_f64;
    for ((_, dimension), &value) in read.dimensions.iter().zip(read.values) {
        let length = match dimension {
            Dimension::GroundX { .. } => value - origin[0],
            Dimension::GroundY { .. } => value - origin[1],
            Dimension::SlideOriginX { slide } if linkage.slides[slide].on == linkage.ground => {
                value - origin[0]
            }
            Dimension::SlideOriginY { slide } if linkage.slides[slide].on == linkage.ground => {
                value - origin[1]
            }
            // A coupler point far away is no part of the closure.
            Dimension::JointX { joint, .. } | Dimension::JointY { joint, .. } if !paired(joint) => {
                0.0
            }
            d if d.is_length() => value,
            _ => 0.0,
        };
        greatest = greatest.max(length.abs());
    }
    power_of_two(greatest)
}

/// The power of two at or below a positive number (1 for 0 or no number);
/// kept within the normal range, so that it can be divided by.
fn power_of_two(x: f64) -> f64 {
    if !(x.is_finite() && x > 0.0) {
        return 1.0;
    }
    let exponent = (x.to_bits() >> 52).clamp(24, 2022);
    f64::from_bits(exponent << 52)
}

#[cfg(test)]
mod tests {
    use super::power_of_two;

    #[test]
    fn powers_of_two() {
        for (x, p) in
            [(1.0, 1.0), (1.99, 1.0), (0.3, 0.25), (4.8, 4.0), (0.0, 1.0), (f64::NAN, 1.0)]
        {
            assert!(power_of_two(x) == p, "{x}");
        }
        assert!(power_of_two(1e-150) <= 1e-150 && power_of_two(1e150) <= 1e150);
        assert!(power_of_two(f64::MIN_POSITIVE) > 0.0);
    }
}
