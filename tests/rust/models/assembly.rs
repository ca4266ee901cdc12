//! Parts of random mechanisms put together: dyads, drivers, a description.

use std::f64::consts::FRAC_PI_2;

use assur::Description;

use crate::models::builder::{Builder, GROUND, beyond, direction, link_name, slide_name};

/// What is driven.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Driven {
    Crank,
    Slide,
    Cylinder,
    Elbow,
    Coupler,
    TwoCranks,
}

pub const DRIVERS: [Driven; 6] = [
    Driven::Crank,
    Driven::Slide,
    Driven::Cylinder,
    Driven::Elbow,
    Driven::Coupler,
    Driven::TwoCranks,
];

/// Dyads.
impl Builder<'_> {
    pub fn dyad(&mut self, kind: &str) {
        let moving: Vec<usize> = (1..self.links.len()).collect();
        let a = self.among(&moving);
        let others: Vec<usize> = (0..self.links.len()).filter(|&l| l != a).collect();
        let b = if self.coin(0.4) { GROUND } else { self.among(&others) };
        let (a, b) = if self.coin(0.5) { (a, b) } else { (b, a) };
        let links = match kind {
            "RRR" => self.rrr(a, b),
            "RRP" => self.rrp(a, b),
            "RPR" => self.rpr(a, b),
            "PRP" => self.prp(a, b),
            _ => self.rpp(a, b),
        };
        for link in links {
            if let Some(&first) = self.links[link].first()
                && self.coin(0.3)
            {
                let angle = self.angle();
                self.joint_beyond(self.joints[first], angle, link);
            }
        }
    }

    /// A leg from a joint of `a`: its joints and its direction.
    fn leg_from(&mut self, a: usize, b: usize) -> (usize, usize, f64) {
        let outer = self.outer(a, b);
        let (angle, length) = (self.angle(), self.leg());
        let inner = self.joint(beyond(self.joints[outer], length, angle), &[]);
        (outer, inner, angle)
    }

    fn rrr(&mut self, a: usize, b: usize) -> [usize; 2] {
        let (outer, inner, angle) = self.leg_from(a, b);
        let angle = angle + self.corner();
        let end = self.joint_beyond(self.joints[inner], angle, b);
        [self.link(&[outer, inner]), self.link(&[inner, end])]
    }

    fn rrp(&mut self, a: usize, b: usize) -> [usize; 2] {
        let (outer, inner, angle) = self.leg_from(a, b);
        let links = [self.link(&[outer, inner]), self.link(&[inner])];
        let angle = angle + FRAC_PI_2 + self.corner();
        self.slide(links[1], b, angle);
        links
    }

    fn rpr(&mut self, a: usize, b: usize) -> [usize; 2] {
        let outer = self.outer(a, b);
        let angle = self.angle();
        let end = self.joint_beyond(self.joints[outer], angle, b);
        let links = [self.link(&[outer]), self.link(&[end])];
        let across = direction(self.joints[outer], self.joints[end]) + FRAC_PI_2;
        let angle = across + self.corner();
        self.slide(links[1], links[0], angle);
        links
    }

    fn prp(&mut self, a: usize, b: usize) -> [usize; 2] {
        let point = self.near();
        let middle = self.joint(point, &[]);
        let links = [self.link(&[middle]), self.link(&[middle])];
        self.crossed_guides([(links[0], a), (links[1], b)]);
        links
    }

    fn rpp(&mut self, a: usize, b: usize) -> [usize; 2] {
        let outer = self.outer(a, b);
        let first = self.link(&[outer]);
        let second = self.link(&[]);
        if self.coin(0.5) || self.links[b].is_empty() {
            let point = self.near();
            self.joint(point, &[second]);
        }
        self.crossed_guides([(second, b), (first, second)]);
        [first, second]
    }

    fn crossed_guides(&mut self, pairs: [(usize, usize); 2]) {
        let angle = self.angle();
        let other = angle + self.corner();
        for ((link, on), angle) in pairs.into_iter().zip([angle, other]) {
            self.slide(link, on, angle);
        }
    }
}

/// Drivers.
impl Builder<'_> {
    /// Ground, driven links and, where the driven pair is not on the ground, the
    /// dyad that they make.
    pub fn drive(&mut self, driven: Driven) {
        match driven {
            Driven::Crank => self.crank(),
            Driven::TwoCranks => (0..2).for_each(|_| self.crank()),
            Driven::Slide => self.carriage(),
            Driven::Cylinder => self.cylinder(),
            Driven::Elbow => self.elbow(),
            Driven::Coupler => self.coupler(),
        }
    }

    fn driver(&mut self, add: impl FnOnce(Description) -> Description) {
        self.drivers = add(std::mem::take(&mut self.drivers));
    }

    fn ground_joint(&mut self) -> usize {
        let point = match self.links[GROUND].first() {
            None => self.near(),
            Some(&first) => {
                let (length, angle) = (self.leg(), self.angle());
                beyond(self.joints[first], length, angle)
            }
        };
        self.joint(point, &[GROUND])
    }

    fn crank(&mut self) {
        let pivot = self.ground_joint();
        let (length, angle) = (self.leg(), self.angle());
        let pin = self.joint(beyond(self.joints[pivot], length, angle), &[]);
        let link = self.link(&[pivot, pin]);
        self.driver(|d| d.driver(&link_name(link)));
    }

    fn carriage(&mut self) {
        if self.coin(0.7) {
            self.ground_joint();
        }
        let (point, angle) = (self.near(), self.angle());
        let joint = self.joint(point, &[]);
        let link = self.link(&[joint]);
        let slide = self.slide(link, GROUND, angle);
        self.driver(|d| d.driver(&slide_name(slide)));
    }

    /// Three joints: a ground pivot, one that is `leg` away at `angle`, and a second
    /// ground pivot at a corner beyond that.
    fn two_legs(&mut self, from: usize) -> [usize; 2] {
        let (angle, length) = (self.angle(), self.leg());
        let tip = self.joint(beyond(self.joints[from], length, angle), &[]);
        let angle = angle + self.corner();
        [tip, self.joint_beyond(self.joints[tip], angle, GROUND)]
    }

    /// Barrel on one ground pivot, boom on another, the rod pinned to the boom.
    fn cylinder(&mut self) {
        let pivot = self.ground_joint();
        let [tip, root] = self.two_legs(pivot);
        let (barrel, rod) = (self.link(&[pivot]), self.link(&[tip]));
        self.link(&[root, tip]);
        let angle = self.angle();
        let slide = self.slide(rod, barrel, angle);
        self.driver(|d| d.driver(&slide_name(slide)));
    }

    /// Two links of a four-bar, driven where they meet.
    fn elbow(&mut self) {
        let pivot = self.ground_joint();
        let (angle, length) = (self.angle(), self.leg());
        let elbow = self.joint(beyond(self.joints[pivot], length, angle), &[]);
        // No straight angle: the wrist's distance from the pivot would not change.
        let (bent, length) = (angle + self.corner(), self.leg());
        let wrist = self.joint(beyond(self.joints[elbow], length, bent), &[]);
        let angle = direction(self.joints[pivot], self.joints[wrist]) + self.corner();
        let root = self.joint_beyond(self.joints[wrist], angle, GROUND);
        let (upper, fore) = (self.link(&[pivot, elbow]), self.link(&[elbow, wrist]));
        self.link(&[wrist, root]);
        self.driver(|d| d.drive(&link_name(fore), &link_name(upper)));
    }

    /// A four-bar driven by the angle of its coupler.
    fn coupler(&mut self) {
        let pivot = self.ground_joint();
        let (angle, length) = (self.angle(), self.leg());
        let b = self.joint(beyond(self.joints[pivot], length, angle), &[]);
        let (along, length) = (self.angle(), self.leg());
        let c = self.joint(beyond(self.joints[b], length, along), &[]);
        let angle = angle + self.corner();
        let root = self.joint_beyond(self.joints[c], angle, GROUND);
        self.link(&[pivot, b]);
        let coupler = self.link(&[b, c]);
        self.link(&[root, c]);
        self.driver(|d| d.driver(&link_name(coupler)));
    }
}

/// From parts to a description.
impl Builder<'_> {
    /// 0..n in any order.
    fn shuffled(&mut self, n: usize) -> Vec<usize> {
        let mut keys: Vec<(f64, usize)> = (0..n).map(|i| (self.next(), i)).collect();
        keys.sort_by(|a, b| a.0.total_cmp(&b.0));
        keys.into_iter().map(|(_, i)| i).collect()
    }

    /// Joints, links and slides in any order; a link's first joint stays (the others
    /// are not near it), unless it has two.
    pub fn finish(mut self) -> Description {
        let mut description = std::mem::take(&mut self.drivers);
        for j in self.shuffled(self.joints.len()) {
            description = description.joint(&format!("J{j}"), self.joints[j]);
        }
        for l in self.shuffled(self.links.len()) {
            let mut joints = self.links[l].clone();
            if joints.len() == 2 && self.coin(0.5) {
                joints.reverse();
            } else if joints.len() > 2 && self.coin(0.5) {
                joints[1..].reverse();
            }
            let names: Vec<String> = joints.iter().map(|j| format!("J{j}")).collect();
            description = description.link(&link_name(l), names.iter().map(String::as_str));
        }
        for s in self.shuffled(self.slides.len()) {
            let (link, on, angle, origin) = self.slides[s];
            let origin = origin.map(|j| format!("J{j}"));
            let (link, on) = (link_name(link), link_name(on));
            description = description.slide(&slide_name(s), &link, &on, angle, origin.as_deref());
        }
        description
    }
}
