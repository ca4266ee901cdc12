//! Parts of random mechanisms: numbers from a tape, joints, links, slides.

use std::f64::consts::{FRAC_PI_2, PI};

use assur::Description;

/// Least |sine| between the legs of a dyad.
const LEAST_SINE: f64 = 0.05;
/// Joints of one link are at least this far from its first.
const APART: f64 = 0.3;

type Point = [f64; 2];
/// Index of the ground among the links.
pub const GROUND: usize = 0;

pub struct Builder<'a> {
    tape: &'a [f64],
    pub joints: Vec<Point>,
    pub links: Vec<Vec<usize>>,
    /// Sliding link, carrying link, angle, origin.
    pub slides: Vec<(usize, usize, f64, Option<usize>)>,
    pub sines: Vec<f64>,
    pub drivers: Description,
}

pub fn link_name(link: usize) -> String {
    if link == GROUND { "ground".into() } else { format!("L{link}") }
}

pub fn slide_name(slide: usize) -> String {
    format!("s{slide}")
}

pub fn beyond(from: Point, length: f64, angle: f64) -> Point {
    [from[0] + length * angle.cos(), from[1] + length * angle.sin()]
}

fn distance(a: Point, b: Point) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

pub fn direction(from: Point, to: Point) -> f64 {
    (to[1] - from[1]).atan2(to[0] - from[0])
}

impl<'a> Builder<'a> {
    pub fn new(tape: &'a [f64]) -> Self {
        Self {
            tape,
            joints: Vec::new(),
            links: vec![Vec::new()],
            slides: Vec::new(),
            sines: Vec::new(),
            drivers: Description::new(),
        }
    }
}

/// The numbers behind the choices.
impl Builder<'_> {
    /// The next number of the tape, 0..1; after its end the middle.
    pub fn next(&mut self) -> f64 {
        let Some((&first, rest)) = self.tape.split_first() else { return 0.5 };
        self.tape = rest;
        first
    }

    pub fn coin(&mut self, chance: f64) -> bool {
        self.next() < chance
    }

    pub fn among<T: Copy>(&mut self, choices: &[T]) -> T {
        let chosen = (self.next() * choices.len() as f64).floor();
        let found = choices.iter().enumerate().find(|(i, _)| *i as f64 >= chosen);
        *found.expect("choices to take from").1
    }

    /// Any direction, now and then along an axis.
    pub fn angle(&mut self) -> f64 {
        let any = (2.0 * self.next() - 1.0) * PI;
        if self.coin(0.15) { self.among(&[0.0, FRAC_PI_2, PI, -FRAC_PI_2]) } else { any }
    }

    /// An angle whose |sine| is at least the least, now and then hardly more.
    pub fn corner(&mut self) -> f64 {
        let least = if self.coin(0.15) { LEAST_SINE } else { 0.15 };
        let most = if least < 0.1 { 0.15 } else { 1.0 };
        let sine = least + (most - least) * self.next();
        self.sines.push(sine);
        let acute = sine.asin();
        let corner = if self.coin(0.5) { acute } else { PI - acute };
        if self.coin(0.5) { corner } else { -corner }
    }

    /// A length between 0.3 and 3, as often below 0.95 as above.
    pub fn leg(&mut self) -> f64 {
        0.3 * 10.0_f64.powf(self.next())
    }

    /// A point about the middle of what is there.
    pub fn near(&mut self) -> Point {
        let n = self.joints.len().max(1) as f64;
        [0, 1].map(|axis| {
            let middle = self.joints.iter().map(|p| p[axis]).sum::<f64>() / n;
            middle + 4.0 * self.next() - 2.0
        })
    }
}

/// Joints, links, slides.
impl Builder<'_> {
    pub fn joint(&mut self, point: Point, links: &[usize]) -> usize {
        self.joints.push(point);
        let joint = self.joints.len() - 1;
        for &link in links {
            self.links[link].push(joint);
        }
        joint
    }

    pub fn link(&mut self, joints: &[usize]) -> usize {
        self.links.push(joints.to_vec());
        self.links.len() - 1
    }

    /// A new joint of `link`, in this direction from a point; farther off where it
    /// would come near the link's first joint.
    pub fn joint_beyond(&mut self, from: Point, angle: f64, link: usize) -> usize {
        let length = self.leg();
        let mut point = beyond(from, length, angle);
        if let Some(&first) = self.links[link].first()
            && distance(self.joints[first], point) < APART
        {
            point = beyond(from, length + 2.5 * APART, angle);
        }
        self.joint(point, &[link])
    }

    /// A joint of `link` to hang a dyad on: a new one, or an old one that is not on
    /// `other` (three or more links then meet there).
    pub fn outer(&mut self, link: usize, other: usize) -> usize {
        let old: Vec<usize> =
            self.links[link].iter().copied().filter(|j| !self.links[other].contains(j)).collect();
        if !old.is_empty() && self.coin(0.4) {
            return self.among(&old);
        }
        if let Some(&first) = self.links[link].first() {
            let angle = self.angle();
            return self.joint_beyond(self.joints[first], angle, link);
        }
        let point = self.near();
        self.joint(point, &[link])
    }

    /// A sliding pair; either link may carry the guide, with an origin or without.
    pub fn slide(&mut self, a: usize, b: usize, angle: f64) -> usize {
        let wrapped = angle - 2.0 * PI * (angle / (2.0 * PI)).round();
        let swap = self.coin(0.4) && b != GROUND && !self.links[a].is_empty();
        let (link, on) = if swap { (b, a) } else { (a, b) };
        let marks = self.links[on].clone();
        // A link without joints is placed by the origins of its guides.
        let needed = self.links[link].is_empty();
        let origin = if (self.coin(0.6) || needed) && !marks.is_empty() {
            Some(self.among(&marks))
        } else {
            None
        };
        self.slides.push((link, on, wrapped, origin));
        self.slides.len() - 1
    }
}
