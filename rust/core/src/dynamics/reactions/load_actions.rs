//! The links on which each load acts, and where: action and reaction.

use crate::description::Linkage;
use crate::dynamics::kinematics::Point;
use crate::dynamics::load::Load;
use crate::dynamics::machine::Machine;
use crate::plan::mechanism::Mechanism;

/// The action of one load on one link, without its size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadAction {
    /// Index of the load.
    pub load: usize,
    /// The link on which it acts.
    pub link: usize,
    /// The point where it acts with a force; `None`: it acts with a couple.
    pub at: Option<Point>,
    /// Whether this is the reaction of the load's force or couple, the opposite of it.
    pub is_reaction: bool,
}

impl Machine {
    /// The actions of its loads on links, load by load: the order of [`Reaction::LoadForce`] and the other
    /// reactions of loads.
    ///
    /// [`Reaction::LoadForce`]: crate::dynamics::Reaction::LoadForce
    #[must_use]
    pub fn load_actions(&self, mechanism: &Mechanism) -> Vec<LoadAction> {
        let linkage = mechanism.linkage();
        let actions = self.loads.iter().enumerate().flat_map(|(load, item)| {
            let both = item.acts_on(linkage).into_iter().zip([false, true]);
            both.filter_map(move |(place, is_reaction)| {
                let (link, at) = place?;
                Some(LoadAction { load, link, at, is_reaction })
            })
        });
        actions.collect()
    }
}

impl Load {
    /// The link on which it acts, with a force at a point or a couple, and the same for its reaction.
    fn acts_on(&self, linkage: &Linkage) -> [Option<(usize, Option<Point>)>; 2] {
        match *self {
            Self::Force { at, on, .. } => {
                [Some((on.unwrap_or_else(|| loaded_link(linkage, at)), Some(at))), None]
            }
            Self::Pressure { slide, .. } => {
                let slide = &linkage.slides[slide];
                let joint = linkage.links[slide.link].joints.first();
                let sliding_point = joint
                    .map_or(Point::Link { link: slide.link, at: [0.0; 2] }, |&j| Point::Joint(j));
                [slide.link, slide.on].map(|link| Some((link, Some(sliding_point))))
            }
            Self::Spring { ends, .. } | Self::Damper { ends, .. } => {
                ends.map(|end| Some((loaded_link(linkage, end), Some(end))))
            }
            Self::Torque { link, on, .. }
            | Self::TorsionSpring { link, on, .. }
            | Self::TorsionDamper { link, on, .. } => [link, on].map(|link| Some((link, None))),
        }
    }
}

/// The link that takes a load on a point, unless the load names another.
fn loaded_link(linkage: &Linkage, point: Point) -> usize {
    match point {
        Point::Joint(joint) => linkage.loaded_link(joint),
        Point::Link { link, .. } => link,
    }
}
