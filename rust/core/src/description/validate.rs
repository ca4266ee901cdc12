//! Turns a [`Description`] into a [`Linkage`]: resolves names and rejects mistakes.

use std::collections::{HashMap, HashSet};

use super::error::{Item, Named, StructureError};
use super::names::{mistaken_kind, suggest};
use super::{Description, Driver, DriverDescription, Joint, Link, Linkage, Slide};
use crate::math::tolerance::{GREATEST_LENGTH, LEAST_LENGTH, ZERO_LENGTH};

impl Linkage {
    /// Validates a description and resolves its names.
    ///
    /// # Errors
    ///
    /// The first mistake found: a bad, repeated or unknown name, a coordinate that
    /// is not finite or out of range, a joint without a link, a link of length zero or
    /// without a reference point, a slide or driver that relates a link to itself, a bad
    /// assembly sign, no ground, no driver.
    pub fn new(description: &Description) -> Result<Self, StructureError> {
        check_names(description)?;
        let joints = resolve_joints(description)?;
        let joint_index: HashMap<&str, usize> =
            joints.iter().enumerate().map(|(i, j)| (j.name.as_str(), i)).collect();
        let links = resolve_links(description, &joint_index)?;
        let link_index: HashMap<&str, usize> =
            links.iter().enumerate().map(|(i, l)| (l.name.as_str(), i)).collect();
        let ground = *link_index.get("ground").ok_or(StructureError::NoGround)?;
        let slides = resolve_slides(description, &joint_index, &link_index, &links)?;
        let mut links_of_joints = vec![Vec::new(); joints.len()];
        for (index, link) in links.iter().enumerate() {
            for &joint in &link.joints {
                links_of_joints[joint].push(index);
            }
        }
        let mut linkage = Self {
            joints: joints.clone(),
            links: links.clone(),
            slides,
            drivers: Vec::new(),
            ground,
            assembly: Vec::new(),
            links_of_joints,
        };
        linkage.check_joints_have_links()?;
        linkage.check_lengths()?;
        linkage.check_reference_points()?;
        linkage.check_lengths_of_slides()?;
        linkage.drivers = resolve_drivers(description, &linkage)?;
        linkage.assembly = check_assembly(description)?;
        Ok(linkage)
    }

    fn check_joints_have_links(&self) -> Result<(), StructureError> {
        match (0..self.joints.len()).find(|&j| self.links_at(j).next().is_none()) {
            Some(j) => Err(StructureError::LooseJoint { joint: self.joints[j].name.clone() }),
            None => Ok(()),
        }
    }

    fn check_lengths(&self) -> Result<(), StructureError> {
        for (index, link) in self.links.iter().enumerate() {
            let [first, second, ..] = link.joints[..] else { continue };
            let (a, b) = (&self.joints[first], &self.joints[second]);
            let length = libm::hypot(b.at[0] - a.at[0], b.at[1] - a.at[1]);
            let extent = a.at.iter().chain(&b.at).fold(0.0_f64, |m, x| m.max(x.abs()));
            if index != self.ground && length > ZERO_LENGTH * extent && length < LEAST_LENGTH {
                return Err(StructureError::OutOfRange {
                    kind: Named::Link,
                    name: link.name.clone(),
                    what: "length",
                    value: length,
                });
            }
            if index != self.ground && length <= ZERO_LENGTH * extent {
                return Err(StructureError::ZeroLength {
                    link: link.name.clone(),
                    first: a.name.clone(),
                    second: b.name.clone(),
                    x: a.at[0],
                    y: a.at[1],
                });
            }
        }
        Ok(())
    }

    fn check_lengths_of_slides(&self) -> Result<(), StructureError> {
        for (index, slide) in self.slides.iter().enumerate() {
            let (value, _) = self.drawing_slide(index);
            if slide.length && value <= 0.0 {
                return Err(StructureError::NoLength { slide: slide.name.clone(), value });
            }
        }
        Ok(())
    }

    fn check_reference_points(&self) -> Result<(), StructureError> {
        for slide in &self.slides {
            if self.links[slide.link].joints.is_empty() && slide.origin.is_none() {
                return Err(StructureError::GuideNowhere {
                    slide: slide.name.clone(),
                    link: self.links[slide.link].name.clone(),
                    on: self.links[slide.on].name.clone(),
                });
            }
        }
        for link in 0..self.links.len() {
            if link != self.ground && self.reference_point(link).is_none() {
                return Err(StructureError::Unplaced { link: self.links[link].name.clone() });
            }
        }
        Ok(())
    }
}

/// Dots, slashes, quotes, brackets, and invisible characters other than blanks.
const FORBIDDEN: &str = "./\\'\"`()[]{}<>‘’‚“”„«»‹›（）［］｛｝〈〉《》「」『』【】\u{ad}\u{200b}\u{200c}\u{200d}\u{200e}\u{200f}\u{2060}\u{feff}";

fn check_names(description: &Description) -> Result<(), StructureError> {
    let names = (description.joints.iter().map(|(n, _)| (n, Named::Joint)))
        .chain(description.links.iter().map(|(n, _)| (n, Named::Link)))
        .chain(description.slides.iter().map(|s| (&s.name, Named::Slide)));
    let mut seen: HashMap<&str, Named> = HashMap::new();
    for (name, kind) in names {
        let forbidden = |c: char| c.is_whitespace() || c.is_control() || FORBIDDEN.contains(c);
        if name.is_empty() || name.contains(forbidden) {
            return Err(StructureError::BadName { kind, name: name.clone() });
        }
        if let Some(&first) = seen.get(name.as_str()) {
            return Err(StructureError::DoubledName { name: name.clone(), first, second: kind });
        }
        seen.insert(name, kind);
    }
    Ok(())
}

fn check_range(
    value: f64,
    kind: Named,
    name: &str,
    what: &'static str,
) -> Result<(), StructureError> {
    if !value.is_finite() {
        return Err(StructureError::NotFinite { kind, name: name.into(), what, value });
    }
    if value.abs() > GREATEST_LENGTH {
        return Err(StructureError::OutOfRange { kind, name: name.into(), what, value });
    }
    Ok(())
}

fn resolve_joints(description: &Description) -> Result<Vec<Joint>, StructureError> {
    description
        .joints
        .iter()
        .map(|(name, at)| {
            check_range(at[0], Named::Joint, name, "x coordinate")?;
            check_range(at[1], Named::Joint, name, "y coordinate")?;
            Ok(Joint { name: name.clone(), at: *at })
        })
        .collect()
}

fn resolve(
    index: &HashMap<&str, usize>,
    kind: Named,
    name: &str,
    other_names: &HashMap<&str, usize>,
    item: impl FnOnce() -> Item,
) -> Result<usize, StructureError> {
    let other_kind = if kind == Named::Joint { Named::Link } else { Named::Joint };
    let is_other = other_names.contains_key(name);
    let mistaken = is_other.then(|| mistaken_kind(name, kind, other_kind)).flatten();
    index.get(name).copied().ok_or_else(|| StructureError::Unknown {
        kind,
        name: name.into(),
        item: item(),
        hint: mistaken.or_else(|| suggest(name, index.keys().copied())),
    })
}

fn resolve_links(
    description: &Description,
    joint_index: &HashMap<&str, usize>,
) -> Result<Vec<Link>, StructureError> {
    let mut links = Vec::new();
    let link_names = description.links.iter().enumerate();
    let link_index = link_names.map(|(i, (name, _))| (name.as_str(), i)).collect();
    for (name, members) in &description.links {
        let mut joints = Vec::new();
        let mut seen = HashSet::new();
        for member in members {
            let joint = resolve(joint_index, Named::Joint, member, &link_index, || {
                Item::Named(Named::Link, name.clone())
            })?;
            if !seen.insert(joint) {
                return Err(StructureError::DoubledJoint {
                    link: name.clone(),
                    joint: member.clone(),
                });
            }
            joints.push(joint);
        }
        links.push(Link { name: name.clone(), joints });
    }
    Ok(links)
}

fn resolve_slides(
    description: &Description,
    joint_index: &HashMap<&str, usize>,
    link_index: &HashMap<&str, usize>,
    links: &[Link],
) -> Result<Vec<Slide>, StructureError> {
    let mut slides = Vec::new();
    for s in &description.slides {
        let item = || Item::Named(Named::Slide, s.name.clone());
        check_range(s.angle, Named::Slide, &s.name, "angle")?;
        let link = resolve(link_index, Named::Link, &s.link, joint_index, item)?;
        let on = resolve(link_index, Named::Link, &s.on, joint_index, item)?;
        if link == on {
            return Err(StructureError::SameLink { item: item(), link: s.link.clone() });
        }
        let origin = match &s.origin {
            None => None,
            Some(name) => {
                let joint = resolve(joint_index, Named::Joint, name, link_index, item)?;
                if !links[on].joints.contains(&joint) {
                    return Err(StructureError::OriginNotOnLink {
                        slide: s.name.clone(),
                        joint: name.clone(),
                        link: s.on.clone(),
                    });
                }
                Some(joint)
            }
        };
        slides.push(Slide {
            name: s.name.clone(),
            link,
            on,
            angle: s.angle,
            origin,
            length: s.length,
        });
    }
    Ok(slides)
}

fn resolve_drivers(
    description: &Description,
    linkage: &Linkage,
) -> Result<Vec<Driver>, StructureError> {
    let link_index: HashMap<&str, usize> =
        linkage.links.iter().enumerate().map(|(i, l)| (l.name.as_str(), i)).collect();
    let joint_index: HashMap<&str, usize> =
        linkage.joints.iter().enumerate().map(|(i, j)| (j.name.as_str(), i)).collect();
    let mut drivers: Vec<Driver> = Vec::new();
    for d in &description.drivers {
        let driver = match d {
            DriverDescription::Named(name) => {
                let slide_names = linkage.slides.iter().map(|s| s.name.as_str());
                let link_of_name = || link_index.get(name.as_str()).copied();
                if let Some(slide) = slide_names.clone().position(|s| s == name) {
                    Driver::Slide(slide)
                } else if let Some(link) = link_of_name() {
                    Driver::Angle { link, relative_to: linkage.ground }
                } else {
                    return Err(StructureError::Unknown {
                        kind: Named::Link,
                        name: name.clone(),
                        item: Item::Driver,
                        hint: joint_index
                            .contains_key(name.as_str())
                            .then(|| mistaken_kind(name, Named::Link, Named::Joint))
                            .flatten()
                            .or_else(|| {
                                suggest(name, link_index.keys().copied().chain(slide_names))
                            }),
                    });
                }
            }
            DriverDescription::Relative { link, relative_to } => {
                let item = || Item::Drive;
                let a = resolve(&link_index, Named::Link, link, &joint_index, item)?;
                let b = resolve(&link_index, Named::Link, relative_to, &joint_index, item)?;
                if a == b {
                    return Err(StructureError::SameLink { item: item(), link: link.clone() });
                }
                Driver::Angle { link: a, relative_to: b }
            }
        };
        if let Driver::Angle { link, relative_to } = driver
            && link == linkage.ground
            && relative_to == linkage.ground
        {
            return Err(StructureError::GroundDriven { driver: "ground".into() });
        }
        if drivers.contains(&driver) {
            return Err(StructureError::DoubledDriver { driver: linkage.driver_name(driver) });
        }
        drivers.push(driver);
    }
    if drivers.is_empty() {
        return Err(StructureError::NoDriver);
    }
    Ok(drivers)
}

fn check_assembly(description: &Description) -> Result<Vec<(String, i8)>, StructureError> {
    description
        .assembly
        .iter()
        .map(|(name, sign)| match sign {
            1 => Ok((name.clone(), 1)),
            -1 => Ok((name.clone(), -1)),
            &value => Err(StructureError::BadSign { name: name.clone(), value }),
        })
        .collect()
}
