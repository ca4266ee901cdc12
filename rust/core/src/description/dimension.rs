//! Dimensions of a linkage: names, kinds, and values in the drawing.

use super::Linkage;
use super::error::{Named, SolveError};
use super::frame::{Axis, polar};
use super::names::suggest;
use crate::math::tolerance::{GREATEST_LENGTH, LEAST_LENGTH};
use crate::math::trig::sin_cos;

/// The quantity that a dimension measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "the fields are indices of what their names say")]
pub enum Dimension {
    /// x of a ground joint in the drawing's frame, m.
    GroundX { joint: usize },
    /// y of a ground joint in the drawing's frame, m.
    GroundY { joint: usize },
    /// Distance from first to second joint, m; positive.
    Length { link: usize },
    /// x of a third or later joint in the link's frame, m.
    JointX { link: usize, joint: usize },
    /// y of a third or later joint in the link's frame, m.
    JointY { link: usize, joint: usize },
    /// Direction of a guide in the frame of the link that carries it, rad.
    SlideAngle { slide: usize },
    /// Direction of a guide in the frame of the sliding link, rad.
    SlideLinkAngle { slide: usize },
    /// Distance of the sliding point's path from the origin, m, positive to the
    /// left of the guide.
    SlideOffset { slide: usize },
    /// x of the point where the slide's value is 0, in the frame of the link that carries
    /// the guide, m.
    SlideOriginX { slide: usize },
    /// y of the point where the slide's value is 0, in the frame of the link that carries
    /// the guide, m.
    SlideOriginY { slide: usize },
}

impl Dimension {
    /// Whether the dimension is a length, which scales with the mechanism, and not an angle.
    #[must_use]
    pub fn is_length(self) -> bool {
        !matches!(self, Self::SlideAngle { .. } | Self::SlideLinkAngle { .. })
    }

    /// Least and greatest value that is valid.
    fn range(self) -> [f64; 2] {
        match self {
            Self::Length { .. } => [LEAST_LENGTH, GREATEST_LENGTH],
            _ => [-GREATEST_LENGTH, GREATEST_LENGTH],
        }
    }

    /// The fault of a value of this dimension; `None` if it is valid.
    #[must_use]
    pub fn fault(self, value: f64) -> Option<&'static str> {
        if !value.is_finite() {
            Some("a finite number is needed")
        } else if matches!(self, Self::Length { .. }) && value <= 0.0 {
            Some("a length must be positive")
        } else if matches!(self, Self::Length { .. })
            && !(LEAST_LENGTH..=GREATEST_LENGTH).contains(&value)
        {
            Some("a length must be from 1e-153 to 1e153 m")
        } else if value.abs() > GREATEST_LENGTH {
            Some("it must be within ±1e153")
        } else {
            None
        }
    }
}

/// The dimensions of a linkage, in a fixed order, with their names.
#[derive(Debug, Clone, PartialEq)]
pub struct Dimensions {
    entries: Vec<(String, Dimension)>,
    /// Least and greatest value of each.
    ranges: Vec<[f64; 2]>,
}

impl Dimensions {
    /// All dimensions of a linkage.
    #[must_use]
    pub fn of(linkage: &Linkage) -> Self {
        let mut entries = Vec::new();
        let mut add = |owner: &str, what: &str, dimension| {
            entries.push((format!("{owner}.{what}"), dimension));
        };
        for (index, link) in linkage.links.iter().enumerate() {
            for (position, &joint) in link.joints.iter().enumerate() {
                let name = &linkage.joints[joint].name;
                if index == linkage.ground {
                    add(&link.name, &format!("{name}.x"), Dimension::GroundX { joint });
                    add(&link.name, &format!("{name}.y"), Dimension::GroundY { joint });
                } else if position == 1 {
                    add(&link.name, "length", Dimension::Length { link: index });
                } else if position > 1 {
                    add(&link.name, &format!("{name}.x"), Dimension::JointX { link: index, joint });
                    add(&link.name, &format!("{name}.y"), Dimension::JointY { link: index, joint });
                }
            }
        }
        for (slide, s) in linkage.slides.iter().enumerate() {
            if linkage.axis(s.on) != Axis::Slide(slide) {
                add(&s.name, "angle", Dimension::SlideAngle { slide });
            }
            if linkage.axis(s.link) != Axis::Slide(slide) {
                add(&s.name, "link_angle", Dimension::SlideLinkAngle { slide });
            }
            add(&s.name, "offset", Dimension::SlideOffset { slide });
            if s.origin.is_none() {
                add(&s.name, "origin.x", Dimension::SlideOriginX { slide });
                add(&s.name, "origin.y", Dimension::SlideOriginY { slide });
            }
        }
        let ranges = entries.iter().map(|(_, dimension)| dimension.range()).collect();
        Self { entries, ranges }
    }

    /// Number of dimensions.
    #[must_use]
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether the linkage has no dimensions.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// The range of each, from least to greatest.
    pub(crate) fn ranges(&self) -> &[[f64; 2]] {
        &self.ranges
    }

    /// Names and kinds in order.
    pub fn iter(&self) -> impl Iterator<Item = (&str, Dimension)> {
        self.entries.iter().map(|(name, kind)| (name.as_str(), *kind))
    }

    /// Index of the dimension with this name.
    ///
    /// # Errors
    ///
    /// [`SolveError::Unknown`], with similar names.
    pub fn position(&self, name: &str) -> Result<usize, SolveError> {
        self.entries.iter().position(|(n, _)| n == name).ok_or_else(|| {
            let names = || self.entries.iter().map(|(n, _)| n.as_str());
            // Of a link that exists, its own dimensions.
            let link = name.split_once('.').map_or("", |(link, _)| link);
            let of_link = |known: &&str| known.split_once('.').is_some_and(|(own, _)| own == link);
            let hint = suggest(name, names().filter(of_link)).or_else(|| suggest(name, names()));
            SolveError::Unknown { kind: Named::Dimension, name: name.into(), hint }
        })
    }

    /// Values in the drawing, in order.
    #[must_use]
    pub fn of_drawing(&self, linkage: &Linkage) -> Vec<f64> {
        self.entries.iter().map(|(_, d)| drawing_value(linkage, *d)).collect()
    }

    /// The error of the first invalid value, if any.
    #[must_use]
    pub fn first_fault(&self, values: &[f64]) -> Option<SolveError> {
        let mut valid = true;
        for (&[low, high], &value) in self.ranges.iter().zip(values) {
            valid &= low <= value && value <= high;
        }
        if valid {
            return None;
        }
        self.entries.iter().zip(values).find_map(|((name, d), &value)| {
            d.fault(value).map(|need| SolveError::BadDimension { name: name.clone(), value, need })
        })
    }
}

/// Coordinates of a point of the drawing in the frame of a link.
fn to_link_frame(linkage: &Linkage, link: usize, point: [f64; 2]) -> [f64; 2] {
    let origin = if link == linkage.ground {
        [0.0; 2]
    } else {
        linkage.reference_point(link).unwrap_or([0.0; 2])
    };
    let (x, y) = (point[0] - origin[0], point[1] - origin[1]);
    let joints = &linkage.links[link].joints;
    let (c, s) = if linkage.axis(link) == Axis::Joints {
        // A unit vector instead of the angle is exact where the joints lie along an axis.
        let (a, b) = (linkage.joints[joints[0]].at, linkage.joints[joints[1]].at);
        let length = polar(a, b).0;
        ((b[0] - a[0]) / length, (b[1] - a[1]) / length)
    } else {
        let (sin, cos) = sin_cos(linkage.drawing_angle(link));
        (cos, sin)
    };
    [x * c + y * s, y * c - x * s]
}

fn drawing_value(linkage: &Linkage, dimension: Dimension) -> f64 {
    let guide_angle =
        |slide: usize, link: usize| linkage.slides[slide].angle - linkage.drawing_angle(link);
    match dimension {
        Dimension::GroundX { joint } => linkage.joints[joint].at[0],
        Dimension::GroundY { joint } => linkage.joints[joint].at[1],
        Dimension::Length { link } => {
            let joints = &linkage.links[link].joints;
            polar(linkage.joints[joints[0]].at, linkage.joints[joints[1]].at).0
        }
        Dimension::JointX { link, joint } => {
            to_link_frame(linkage, link, linkage.joints[joint].at)[0]
        }
        Dimension::JointY { link, joint } => {
            to_link_frame(linkage, link, linkage.joints[joint].at)[1]
        }
        Dimension::SlideAngle { slide } => guide_angle(slide, linkage.slides[slide].on),
        Dimension::SlideLinkAngle { slide } => guide_angle(slide, linkage.slides[slide].link),
        Dimension::SlideOffset { slide } => linkage.drawing_slide(slide).1,
        Dimension::SlideOriginX { slide } => {
            to_link_frame(linkage, linkage.slides[slide].on, linkage.slide_origin(slide))[0]
        }
        Dimension::SlideOriginY { slide } => {
            to_link_frame(linkage, linkage.slides[slide].on, linkage.slide_origin(slide))[1]
        }
    }
}
