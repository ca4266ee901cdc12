//! The names in the sentence of an error, for callers that would otherwise parse it.

use super::error::{DriverFault, Item, Overconstraint, StructureError};

fn all(names: &[String]) -> impl Iterator<Item = &str> {
    names.iter().map(String::as_str)
}

impl Item {
    fn name(&self) -> Option<&str> {
        match self {
            Self::Named(_, name) => Some(name),
            _ => None,
        }
    }
}

impl Overconstraint {
    fn names(&self) -> impl Iterator<Item = &str> {
        all(&self.links).chain(all(&self.redundant))
    }
}

impl DriverFault {
    fn names(&self) -> Vec<&str> {
        match self {
            Self::AngleFixed { link, other } => vec![link, other],
            Self::SlideFixes { slide } => vec![slide],
            Self::LeavesFree { links } => all(links).collect(),
        }
    }
}

impl StructureError {
    /// Every joint, link, slide and driver that the sentence names, in its order, without the advice at its
    /// end.
    #[must_use]
    pub fn names(&self) -> Vec<&str> {
        match self {
            Self::NoDriver | Self::Interrupted => Vec::new(),
            Self::NoGround => vec!["ground"],
            Self::BadName { name, .. }
            | Self::DoubledName { name, .. }
            | Self::NotFinite { name, .. }
            | Self::OutOfRange { name, .. }
            | Self::FlatDyad { name, .. }
            | Self::BadSign { name, .. } => vec![name],
            Self::DoubledJoint { link, joint } => vec![link, joint],
            Self::Unknown { name, item, .. } => item.name().into_iter().chain([&**name]).collect(),
            Self::LooseJoint { joint } => vec![joint],
            Self::ZeroLength { link, first, second, .. } => vec![link, first, second],
            Self::SameLink { item, link } => item.name().into_iter().chain([&**link]).collect(),
            Self::OriginNotOnLink { slide, joint, link } => vec![slide, joint, link],
            Self::GuideNowhere { slide, link, .. } => vec![slide, link],
            Self::Unplaced { link } => vec![link],
            Self::GroundDriven { driver } | Self::DoubledDriver { driver } => vec![driver],
            Self::Unconnected { links }
            | Self::OverConstrained { links, .. }
            | Self::AlmostFits { links, .. } => all(links).collect(),
            Self::SlidesOnly { slides } => all(slides).collect(),
            Self::Immovable { links, overconstraint, .. } => match overconstraint {
                Some(overconstraint) => overconstraint.names().collect(),
                None => all(links).collect(),
            },
            Self::Mobility { free, overconstraint, .. } => {
                let excess = overconstraint.iter().flat_map(Overconstraint::names);
                all(free).chain(excess).collect()
            }
            Self::CannotDrive { drivers, fault } => all(drivers).chain(fault.names()).collect(),
            Self::NoLength { slide, .. } => vec![slide],
        }
    }
}
