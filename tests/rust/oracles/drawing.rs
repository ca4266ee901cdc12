//! A description's drawing, read by the oracle: positions of links, angles, local
//! coordinates, all as exact numbers divided by one power of two.

use assur::Description;

use crate::oracles::body::{Body, Point};
use crate::oracles::double_double::Dd;

/// Guides whose sine is smaller are parallel.
const PARALLEL: f64 = 1e-12;

pub struct Drawing<'a> {
    pub description: &'a Description,
    /// Power of two near the drawing's extent.
    pub size: f64,
}

impl<'a> Drawing<'a> {
    pub fn new(description: &'a Description) -> Self {
        let mut extent = 0.0_f64;
        for axis in 0..2 {
            let coordinates = || description.joints.iter().map(|(_, at)| at[axis]);
            let high = coordinates().fold(f64::NEG_INFINITY, f64::max);
            extent = extent.max(high - coordinates().fold(f64::INFINITY, f64::min));
        }
        let size = if extent > 0.0 { extent.log2().round().exp2() } else { 1.0 };
        Self { description, size }
    }

    pub fn link(&self, name: &str) -> usize {
        let found = self.description.links.iter().position(|(n, _)| n == name);
        found.unwrap_or_else(|| panic!("no link {name:?}"))
    }

    pub fn joint(&self, name: &str) -> Point {
        let found = self.description.joints.iter().find(|(n, _)| n == name);
        let at = found.unwrap_or_else(|| panic!("no joint {name:?}")).1;
        at.map(|x| Dd::from(x / self.size))
    }

    fn ground(&self, link: usize) -> bool {
        self.description.links[link].0 == "ground"
    }

    /// Guide directions of the slides that a link takes part in.
    fn guides(&self, link: usize) -> impl Iterator<Item = (usize, f64)> {
        let name = &self.description.links[link].0;
        let slides = self.description.slides.iter().enumerate();
        slides.filter(move |(_, s)| s.link == *name || s.on == *name).map(|(k, s)| (k, s.angle))
    }

    /// Angle of a link: first to second joint, or its first slide's direction.
    pub fn angle(&self, link: usize) -> Dd {
        match &self.description.links[link].1[..] {
            _ if self.ground(link) => Dd::ZERO,
            [first, second, ..] => {
                let (a, b) = (self.joint(first), self.joint(second));
                Dd::atan2(b[1] - a[1], b[0] - a[0])
            }
            _ => self.guides(link).next().map_or(Dd::ZERO, |(_, angle)| Dd::from(angle)),
        }
    }

    /// First joint; for a link without joints where those two of its guides cross
    /// that do so most squarely.
    pub fn reference(&self, link: usize) -> Point {
        if let Some(first) = self.description.links[link].1.first() {
            return self.joint(first);
        }
        if self.ground(link) {
            return [Dd::ZERO; 2];
        }
        let guides: Vec<(usize, f64)> = self.guides(link).collect();
        let pairs = (0..guides.len()).flat_map(|i| (i + 1..guides.len()).map(move |j| (i, j)));
        let mut best = (PARALLEL, None);
        for (i, j) in pairs {
            let sine = (guides[j].1 - guides[i].1).sin().abs();
            if sine > 1.01 * best.0 {
                best = (sine, Some((guides[i], guides[j]))); // of equals the first
            }
        }
        let ((first, alpha), (second, beta)) = best.1.expect("guides that cross");
        let (p, r) = (self.guide_point(first, link), self.guide_point(second, link));
        let ((sa, ca), (sb, cb)) = (Dd::from(alpha).sin_cos(), Dd::from(beta).sin_cos());
        // p + t (cos α, sin α) on the line through r along β (Cramer).
        let t = ((r[0] - p[0]) * sb - (r[1] - p[1]) * cb) / (ca * sb - sa * cb);
        [p[0] + t * ca, p[1] + t * sa]
    }

    /// A point on a guide of a link without joints: the slide's origin where that
    /// is on the other link, or the other link's first joint.
    fn guide_point(&self, slide: usize, link: usize) -> Point {
        let slide = &self.description.slides[slide];
        let sliding = slide.link == self.description.links[link].0;
        match &slide.origin {
            Some(origin) if sliding => self.joint(origin),
            _ => {
                let other = self.link(if sliding { &slide.on } else { &slide.link });
                let first = self.description.links[other].1.first();
                first.map_or([Dd::ZERO; 2], |joint| self.joint(joint))
            }
        }
    }

    /// Position of a body's own point: the reference point, the origin for the ground.
    fn reference_point(&self, link: usize) -> Point {
        if self.ground(link) { [Dd::ZERO; 2] } else { self.reference(link) }
    }

    /// A point of the drawing seen from a link.
    pub fn local(&self, link: usize, point: Point) -> Point {
        let origin = self.reference_point(link);
        [point[0] - origin[0], point[1] - origin[1]]
    }

    /// Every body as drawn, as series of `len` coefficients.
    pub fn bodies(&self, len: usize) -> Vec<Body> {
        let series = |value: Dd| {
            let mut coefficients = vec![Dd::ZERO; len];
            coefficients[0] = value;
            coefficients
        };
        (0..self.description.links.len())
            .map(|link| {
                let [x, y] = self.reference_point(link).map(series);
                let [turn, sin, cos] = [Dd::ZERO, Dd::ZERO, Dd::ONE].map(series);
                Body { x, y, turn, cos, sin }
            })
            .collect()
    }
}
