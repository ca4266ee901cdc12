//! Frames of links in the drawing.
//!
//! A link with two joints or more has its frame at the first, x toward the
//! second. A link with one joint or none takes its direction from its first slide.
//! A link without joints has its origin where two of its guides intersect: the two
//! closest to perpendicular.

use super::{Driver, Linkage};
use crate::math::tolerance::PARALLEL;
use crate::math::trig::{atan2, sin_cos};

/// A distance from a guide below this many roundings counts as 0.
const ROUNDINGS: f64 = 4.0;

/// The object that sets the direction of the x axis of a link's frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// The axes of the drawing (the ground).
    Ground,
    /// First to second joint.
    Joints,
    /// The guide of this slide.
    Slide(usize),
    /// The drawing's x axis, because the link has at most one joint and no slide.
    Free,
}

/// Length and angle of the vector from `a` to `b`.
#[must_use]
pub(crate) fn polar(a: [f64; 2], b: [f64; 2]) -> (f64, f64) {
    let (x, y) = (b[0] - a[0], b[1] - a[1]);
    (libm::hypot(x, y), atan2(y, x))
}

/// The angle reduced to (−π, π].
fn principal(angle: f64) -> f64 {
    if angle > -std::f64::consts::PI && angle <= std::f64::consts::PI {
        return angle;
    }
    let (sin, cos) = sin_cos(angle);
    atan2(sin, cos)
}

impl Linkage {
    /// The object that sets the direction of the x axis of the link's frame.
    #[must_use]
    pub fn axis(&self, link: usize) -> Axis {
        if link == self.ground {
            return Axis::Ground;
        }
        if self.links[link].joints.len() >= 2 {
            return Axis::Joints;
        }
        match self.slides.iter().position(|s| s.link == link || s.on == link) {
            Some(slide) => Axis::Slide(slide),
            None => Axis::Free,
        }
    }

    /// Angle of the link's frame in the drawing, in (−π, π].
    #[must_use]
    pub fn drawing_angle(&self, link: usize) -> f64 {
        match self.axis(link) {
            Axis::Ground | Axis::Free => 0.0,
            Axis::Joints => {
                let joints = &self.links[link].joints;
                polar(self.joints[joints[0]].at, self.joints[joints[1]].at).1
            }
            Axis::Slide(slide) => principal(self.slides[slide].angle),
        }
    }

    /// The point that locates the link: its first joint or, without joints, the
    /// intersection of its guides. `None` if they do not intersect.
    #[must_use]
    pub fn reference_point(&self, link: usize) -> Option<[f64; 2]> {
        if let Some(&joint) = self.links[link].joints.first() {
            return Some(self.joints[joint].at);
        }
        if link == self.ground {
            return Some([0.0; 2]);
        }
        let guides: Vec<([f64; 2], f64)> = (self.slides.iter())
            .filter(|s| s.link == link || s.on == link)
            .map(|s| (self.guide_point(s, link), s.angle))
            .collect();
        // The pair closest to perpendicular; among equals the first.
        let mut best: Option<(usize, usize)> = None;
        let mut sine = PARALLEL;
        for i in 0..guides.len() {
            for j in i + 1..guides.len() {
                let pair_sine = sin_cos(guides[j].1 - guides[i].1).0.abs();
                if pair_sine > 1.01 * sine {
                    (best, sine) = (Some((i, j)), pair_sine);
                }
            }
        }
        let ((p, alpha), (r, beta)) = best.map(|(i, j)| (guides[i], guides[j]))?;
        // Intersection p + t (cos α, sin α) with the line through r along β (Cramer's rule).
        let (sin_alpha, cos_alpha) = sin_cos(alpha);
        let (sin_beta, cos_beta) = sin_cos(beta);
        let t = ((r[0] - p[0]) * sin_beta - (r[1] - p[1]) * cos_beta) / sin_cos(beta - alpha).0;
        Some([p[0] + t * cos_alpha, p[1] + t * sin_alpha])
    }

    /// A point, in the drawing, of a guide of a link without joints.
    fn guide_point(&self, slide: &super::Slide, link: usize) -> [f64; 2] {
        let other_link = if slide.link == link { slide.on } else { slide.link };
        // A guide carried by this link passes through the first joint of the sliding
        // link; a guide along which this link slides passes through the slide's origin.
        let joint = match slide.origin {
            Some(origin) if slide.link == link => Some(origin),
            _ => self.links[other_link].joints.first().copied(),
        };
        joint.map_or([0.0; 2], |j| self.joints[j].at)
    }

    /// The point, in the drawing, that moves along the guide: the sliding link's first
    /// joint, or its reference point.
    #[must_use]
    pub fn sliding_point(&self, slide: usize) -> [f64; 2] {
        self.reference_point(self.slides[slide].link).unwrap_or([0.0; 2])
    }

    /// The point, in the drawing, where the slide's value is 0.
    #[must_use]
    pub fn slide_origin(&self, slide: usize) -> [f64; 2] {
        match self.slides[slide].origin {
            Some(joint) => self.joints[joint].at,
            None => self.sliding_point(slide),
        }
    }

    /// Value and offset of a slide in the drawing, m.
    #[must_use]
    pub fn drawing_slide(&self, slide: usize) -> (f64, f64) {
        let (o, p) = (self.slide_origin(slide), self.sliding_point(slide));
        let (x, y) = (p[0] - o[0], p[1] - o[1]);
        let angle = self.slides[slide].angle;
        let (sin, cos) = sin_cos(angle);
        let across = y * cos - x * sin;
        // A guide drawn through the point: the angle, for example π/2, is known only to rounding.
        let rounding = ROUNDINGS * f64::EPSILON * (1.0 + angle.abs()) * (x.abs() + y.abs());
        (x * cos + y * sin, if across.abs() <= rounding { 0.0 } else { across })
    }

    /// Coordinate of a driver in the drawing, rad or m.
    #[must_use]
    pub fn drawing_coordinate(&self, driver: Driver) -> f64 {
        match driver {
            Driver::Slide(slide) => self.drawing_slide(slide).0,
            Driver::Angle { link, relative_to } => {
                self.drawing_angle(link) - self.drawing_angle(relative_to)
            }
        }
    }
}
