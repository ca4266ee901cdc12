//! A refused description as edits read it: by names, with the links at each joint.

use std::collections::{HashMap, HashSet};

use crate::description::{Description, DriverDescription};
use crate::math::vector::Vector;

/// Name of the frame.
pub(super) const GROUND: &str = "ground";

/// A description with the links at each joint.
pub(super) struct Sketch<'a> {
    pub(super) description: &'a Description,
    places: HashMap<&'a str, Vector>,
    links_at: HashMap<&'a str, Vec<&'a str>>,
    joints_of: HashMap<&'a str, &'a [String]>,
}

impl<'a> Sketch<'a> {
    pub(super) fn new(description: &'a Description) -> Self {
        let places =
            description.joints.iter().map(|(name, at)| (&name[..], Vector::new(at[0], at[1])));
        let mut links_at: HashMap<&str, Vec<&str>> = HashMap::new();
        for (link, joints) in &description.links {
            for joint in joints {
                links_at.entry(joint).or_default().push(link);
            }
        }
        let joints_of = description.links.iter().map(|(name, joints)| (&name[..], &joints[..]));
        Self { description, places: places.collect(), links_at, joints_of: joints_of.collect() }
    }

    /// Links with this joint, in the order of the description.
    pub(super) fn links_at(&self, joint: &str) -> &[&'a str] {
        self.links_at.get(joint).map_or(&[], Vec::as_slice)
    }

    /// Joints of a link; empty if the link does not exist.
    pub(super) fn joints_of(&self, link: &str) -> &'a [String] {
        self.joints_of.get(link).copied().unwrap_or_default()
    }

    /// Where a joint is drawn.
    pub(super) fn place(&self, joint: &str) -> Vector {
        self.places.get(joint).copied().unwrap_or(Vector::ZERO)
    }

    /// From one joint to another.
    pub(super) fn between(&self, from: &str, to: &str) -> Vector {
        self.place(to) + self.place(from).scale(-1.0)
    }

    pub(super) fn is_slide(&self, name: &str) -> bool {
        self.description.slides.iter().any(|slide| slide.name == name)
    }

    /// The links without the ground.
    pub(super) fn moving_links(&self) -> impl DoubleEndedIterator<Item = &'a str> {
        self.description.links.iter().map(|(name, _)| &name[..]).filter(|&name| name != GROUND)
    }

    /// Whether a link is at a joint of the ground.
    pub(super) fn is_on_ground(&self, link: &str) -> bool {
        self.joints_of(link).iter().any(|joint| self.links_at(joint).contains(&GROUND))
    }

    /// Whether a driver names a link or a slide.
    pub(super) fn is_driven(&self, name: &str) -> bool {
        self.description.drivers.iter().any(|driver| match driver {
            DriverDescription::Named(driver_name) => driver_name == name,
            DriverDescription::Relative { link, relative_to } => {
                link == name || relative_to == name
            }
        })
    }

    /// Joints of a link where it meets another, or where the value of a slide begins.
    pub(super) fn paired(&self, link: &str) -> Vec<&'a str> {
        let is_origin = |joint: &str| {
            self.description
                .slides
                .iter()
                .any(|s| s.on == link && s.origin.as_deref() == Some(joint))
        };
        let joints = self.joints_of(link).iter().map(String::as_str);
        joints.filter(|joint| self.links_at(joint).len() > 1 || is_origin(joint)).collect()
    }

    /// Whether a link slides, or carries a guide.
    pub(super) fn has_slide(&self, link: &str) -> bool {
        self.description.slides.iter().any(|slide| slide.link == link || slide.on == link)
    }

    /// The joint by which a link hangs on others, if it is the only one and the link has no slide.
    pub(super) fn hangs_by(&self, link: &str) -> Option<&'a str> {
        match self.paired(link)[..] {
            [joint] if !self.has_slide(link) => Some(joint),
            _ => None,
        }
    }

    /// The end of a link that hangs by a joint: the joint, among those on no other link, that is nearest to a
    /// joint of the ground without a moving link, else the farthest from the pin.
    pub(super) fn free_end(&self, link: &str, pin: &str) -> Option<&'a str> {
        let joints = self.joints_of(link).iter().map(String::as_str);
        let ends: Vec<&str> =
            joints.filter(|&joint| joint != pin && self.links_at(joint).len() == 1).collect();
        let to_foot = |joint: &str| {
            let feet = self.waiting_feet().map(|foot| self.between(joint, foot).norm2());
            feet.fold(f64::INFINITY, f64::min)
        };
        let reach = |joint: &str| self.between(pin, joint).norm2();
        ends.into_iter().min_by(|a, b| {
            to_foot(a).total_cmp(&to_foot(b)).then_with(|| reach(b).total_cmp(&reach(a)))
        })
    }

    /// Joints of the ground that are on no moving link.
    pub(super) fn waiting_feet(&self) -> impl Iterator<Item = &'a str> {
        let joints = self.joints_of(GROUND).iter().map(String::as_str);
        joints.filter(|joint| self.links_at(joint).len() == 1)
    }

    /// The joint of a link that is nearest to another joint, but not in the same place.
    pub(super) fn nearest(&self, link: &str, to: &str) -> Option<&'a str> {
        let joints = self.joints_of(link).iter().map(String::as_str);
        joints
            .filter(|joint| self.between(to, joint).norm2() > 0.0)
            .min_by(|a, b| self.between(to, a).norm2().total_cmp(&self.between(to, b).norm2()))
    }

    /// An unused name: `base_name`, or the same with the least number from 2.
    pub(super) fn unused(&self, base_name: &str) -> String {
        let taken = self.names();
        if !taken.contains(base_name) {
            return base_name.into();
        }
        let base = base_name.trim_end_matches(|c: char| c.is_ascii_digit());
        let base = if base.is_empty() { base_name } else { base };
        let numbered = (2..).map(|n| format!("{base}{n}"));
        numbered.into_iter().find(|name| !taken.contains(&name[..])).unwrap_or_default()
    }

    /// A name for a new joint: the next letter where joints have letters.
    pub(super) fn unused_joint(&self, beside: &str) -> String {
        let is_letter = |name: &str| matches!(name.as_bytes(), [b'A'..=b'Z']);
        if self.description.joints.iter().all(|(name, _)| is_letter(name)) {
            let taken = self.names();
            let letters = ('A'..='Z').map(String::from);
            if let Some(letter) = letters.into_iter().find(|name| !taken.contains(&name[..])) {
                return letter;
            }
        }
        self.unused(beside)
    }

    fn names(&self) -> HashSet<&'a str> {
        let d = self.description;
        (d.joints.iter().map(|(name, _)| &name[..]))
            .chain(d.links.iter().map(|(name, _)| &name[..]))
            .chain(d.slides.iter().map(|slide| &slide.name[..]))
            .collect()
    }
}
