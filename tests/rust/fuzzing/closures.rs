//! Joints and slides against the dimensions, from the numbers returned and nothing else.

use assur::{Axis, Dimension, Driver, Mechanism, Motion, Series};

/// Row of a motion that holds every joint, link, reference point and slide of a mechanism.
pub struct Row<'a> {
    pub mechanism: &'a Mechanism,
    pub dimensions: &'a [f64],
    pub motion: &'a Motion,
    pub index: usize,
}

type Point = [f64; 2];

fn turned([x, y]: Point, angle: f64) -> Point {
    let (sin, cos) = angle.sin_cos();
    [x * cos - y * sin, x * sin + y * cos]
}

fn plus(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1]]
}

fn distance(a: Point, b: Point) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

impl Row<'_> {
    /// Greatest distance between where two parts have the same point, in m.
    pub fn misfit(&self, q: &[f64]) -> f64 {
        let linkage = self.mechanism.linkage();
        let joints = (0..linkage.links.len()).flat_map(|l| self.joints_of(l));
        let slides = (0..linkage.slides.len()).flat_map(|s| self.slide(s));
        let drivers = linkage.drivers.iter().zip(q).map(|(&driver, &q)| self.driver(driver, q));
        // NaN must not be lost in the maximum.
        joints.chain(slides).chain(drivers).fold(0.0, |m, x| if x <= m { m } else { x })
    }

    /// What the rounding of points, dimensions and angles is a part of, in m.
    pub fn size(&self, q: &[f64]) -> f64 {
        let linkage = self.mechanism.linkage();
        let points = (0..linkage.joints.len()).map(|j| self.joint(j));
        let places = (0..linkage.links.len()).map(|l| self.reference_point(l));
        let lengths = self.mechanism.dimensions().iter().zip(self.dimensions);
        let lengths = lengths.filter(|((_, d), _)| d.is_length()).map(|(_, &x)| x);
        let values = (0..linkage.slides.len()).map(|s| self.motion.slides[s].value(self.index));
        let length = points.chain(places).flatten().chain(lengths).chain(values);
        let length = length.fold(0.0_f64, |m, x| m.max(x.abs()));
        let angles = (0..linkage.links.len()).map(|l| self.angle(l));
        let turning = linkage.drivers.iter().zip(q).filter_map(|(driver, &q)| match driver {
            Driver::Angle { .. } => Some(q),
            Driver::Slide(_) => None,
        });
        length * angles.chain(turning).fold(1.0_f64, |m, x| m.max(x.abs()))
    }

    /// How far the position reaches, in the unit of the core's residual: a power of two that is
    /// not below half the longest dimension of a link.
    pub fn reach(&self) -> f64 {
        let linkage = self.mechanism.linkage();
        let places = (0..linkage.links.len()).map(|l| self.reference_point(l));
        let from = self.joint_or_place();
        let far = places.map(|p| distance(p, from));
        let far = far.chain((0..linkage.joints.len()).map(|j| distance(self.joint(j), from)));
        let of_link = |d: Dimension| {
            matches!(
                d,
                Dimension::Length { .. } | Dimension::JointX { .. } | Dimension::JointY { .. }
            )
        };
        let lengths = self.mechanism.dimensions().iter().zip(self.dimensions);
        let lengths = lengths.filter(|((_, d), _)| of_link(*d)).map(|(_, x)| x.abs());
        far.fold(0.0, f64::max) / (0.5 * lengths.fold(0.0, f64::max))
    }

    fn joint_or_place(&self) -> Point {
        if self.mechanism.linkage().joints.is_empty() {
            self.reference_point(0)
        } else {
            self.joint(0)
        }
    }

    fn joint(&self, joint: usize) -> Point {
        self.motion.joints[joint].point(self.index)
    }

    fn reference_point(&self, link: usize) -> Point {
        self.motion.origins[link].point(self.index)
    }

    fn angle(&self, link: usize) -> f64 {
        self.motion.links[link].value(self.index)
    }

    fn dimension(&self, wanted: Dimension) -> f64 {
        let index = self.mechanism.dimensions().iter().position(|(_, d)| d == wanted);
        index.map_or(0.0, |index| self.dimensions[index])
    }

    fn point(&self, x: Dimension, y: Dimension) -> Point {
        [self.dimension(x), self.dimension(y)]
    }

    fn is_ground(&self, link: usize) -> bool {
        link == self.mechanism.linkage().ground
    }

    /// A point of a link's frame in the drawing's.
    fn carried(&self, link: usize, local: Point) -> Point {
        if self.is_ground(link) {
            return local;
        }
        plus(self.reference_point(link), turned(local, self.angle(link)))
    }

    fn joints_of(&self, link: usize) -> Vec<f64> {
        let local = |order: usize, joint: usize| {
            if self.is_ground(link) {
                self.point(Dimension::GroundX { joint }, Dimension::GroundY { joint })
            } else if order < 2 {
                [if order == 0 { 0.0 } else { self.dimension(Dimension::Length { link }) }, 0.0]
            } else {
                self.point(Dimension::JointX { link, joint }, Dimension::JointY { link, joint })
            }
        };
        let joints = self.mechanism.linkage().links[link].joints.iter().enumerate();
        let misfit = |(order, &joint): (usize, &usize)| {
            distance(self.carried(link, local(order, joint)), self.joint(joint))
        };
        joints.map(misfit).collect()
    }

    /// The sliding point off its guide, and how far the links are turned along it.
    fn slide(&self, slide: usize) -> [f64; 2] {
        let linkage = self.mechanism.linkage();
        let s = &linkage.slides[slide];
        let guide = |link: usize, angle: Dimension| {
            let frame = if self.is_ground(link) { 0.0 } else { self.angle(link) };
            let follows = linkage.axis(link) == Axis::Slide(slide);
            frame + if follows { 0.0 } else { self.dimension(angle) }
        };
        let along = guide(s.on, Dimension::SlideAngle { slide });
        let turn = guide(s.link, Dimension::SlideLinkAngle { slide }) - along;
        let origin = match s.origin {
            Some(joint) => self.joint(joint),
            None => self.carried(
                s.on,
                self.point(Dimension::SlideOriginX { slide }, Dimension::SlideOriginY { slide }),
            ),
        };
        let value = self.motion.slides[slide].value(self.index);
        let offset = self.dimension(Dimension::SlideOffset { slide });
        let point = plus(origin, turned([value, offset], along));
        [distance(point, self.reference_point(s.link)), self.turned_by(turn)]
    }

    fn driver(&self, driver: Driver, q: f64) -> f64 {
        match driver {
            Driver::Slide(slide) => (self.motion.slides[slide].value(self.index) - q).abs(),
            Driver::Angle { link, relative_to } => {
                self.turned_by(self.angle(link) - self.angle(relative_to) - q)
            }
        }
    }

    /// What an angle that should be 0, or whole turns, moves on a circle of the drawing's size.
    fn turned_by(&self, angle: f64) -> f64 {
        (0.5 * angle).sin().abs() * 2.0 * self.mechanism.linkage().size()
    }
}

/// Values of a track by row.
trait Values {
    fn value(&self, row: usize) -> f64;
    fn point(&self, row: usize) -> Point;
}

impl Values for Series {
    fn value(&self, row: usize) -> f64 {
        self.derivatives[0][row]
    }

    fn point(&self, row: usize) -> Point {
        [self.derivatives[0][2 * row], self.derivatives[0][2 * row + 1]]
    }
}
