//! What kind of mechanism it is: mobility, redundant links, Assur groups.

pub(crate) mod adjust;
pub(crate) mod assur_group;
pub(crate) mod closure;
pub(crate) mod contour;
pub(crate) mod elimination;
pub(crate) mod freedom;
pub(crate) mod least_norm;
pub(crate) mod matching;
pub(crate) mod rank;
pub(crate) mod redundancy;

pub(crate) use adjust::adjust;
pub(crate) use assur_group::{Group, roman};
pub(crate) use closure::{Closure, LeftOut};

use std::fmt::Write as _;
use std::sync::atomic::AtomicBool;

use self::closure::{list, rotations};
use self::freedom::{Pose, Skeleton, System};
use self::rank::Rank;
use crate::description::error::StructureError;
use crate::description::{Driver, Linkage};

/// The structure of a mechanism with its drivers.
#[derive(Debug, Clone, PartialEq)]
pub struct Structure {
    /// Degrees of freedom, from the rank at a regular position.
    pub mobility: usize,
    /// Degrees of freedom at the drawing itself (more where it is singular).
    pub mobility_at_drawing: usize,
    /// Degrees of freedom counted, 3 n − 2 p (Chebyshev 1870, Grübler 1883).
    pub mobility_counted: i64,
    /// Links and slides that the motion does not need; they are checked for
    /// closure at every position.
    pub redundant: LeftOut,
    /// Assur groups in solving order.
    pub groups: Vec<Group>,
    drivers: Vec<String>,
    link_names: Vec<String>,
}

impl Structure {
    /// The structural formula: `I(crank) → II(coupler, rocker)`.
    #[must_use]
    pub fn formula(&self) -> String {
        let mut text = format!("I({})", self.drivers.join(", "));
        for group in &self.groups {
            let names: Vec<&str> =
                group.links.iter().map(|&l| self.link_names[l].as_str()).collect();
            let _ = write!(text, " → {}({})", roman(group.class), names.join(", "));
        }
        text
    }

    /// Class of the mechanism: the greatest of its groups, at least I.
    #[must_use]
    pub fn class(&self) -> usize {
        self.groups.iter().map(|g| g.class).max().unwrap_or(1)
    }

    /// Analyses a linkage.
    ///
    /// # Errors
    ///
    /// Every way in which it is not a mechanism with as many drivers as freedoms;
    /// the sentence names the links. [`StructureError::Interrupted`] once `cancel` is true.
    pub fn of(
        linkage: &Linkage,
        closure: &Closure,
        cancel: Option<&AtomicBool>,
    ) -> Result<Self, StructureError> {
        refuse_unconnected(linkage)?;
        let everything = LeftOut::default();
        let (free, classes) = rotations(linkage, &everything, false)?;
        let skeleton = Skeleton::new(linkage, closure, &free, classes, cancel);
        let system = System::new(linkage, closure, &everything, &free, false);
        let at_drawing = skeleton.rank(&system, skeleton.drawing())?;
        let drives = |pose: &Pose| match idle(linkage, closure, &skeleton, pose, &everything) {
            Ok(rank) => Ok(rank.mobility == 0),
            Err(StructureError::Interrupted) => Err(StructureError::Interrupted),
            Err(_) => Ok(false),
        };
        // The drawing itself, if all its equations are independent; else displaced, on
        // a branch on which the drivers drive, if there is one.
        let drawing = (skeleton.drawing().clone(), at_drawing.clone());
        let chosen = if at_drawing.excess == 0 && at_drawing.mobility > 0 && drives(&drawing.0)? {
            Some(drawing)
        } else {
            let poses = skeleton.displaced(&system)?;
            let mut chosen = None;
            for (place, (pose, _)) in poses.iter().enumerate() {
                if drives(pose)? {
                    chosen = Some(place);
                    break;
                }
            }
            poses.into_iter().nth(chosen.unwrap_or(0))
        };
        let Some((pose, rank)) = chosen else {
            return Err(StructureError::Immovable {
                counted: counted(linkage),
                over: rigid(linkage, &skeleton, &system, &at_drawing),
            });
        };
        let (redundant, excess) =
            redundancy::leave_out(linkage, closure, &skeleton, &pose, &rank, everything.clone())?;
        if rank.mobility != linkage.drivers.len() {
            return Err(StructureError::Mobility {
                mobility: rank.mobility,
                counted: counted(linkage),
                drivers: linkage.drivers.len(),
                drivers_are: match linkage.drivers.len() {
                    1 => "is 1 driver".into(),
                    n => format!("are {n} drivers"),
                },
                under: under_constrained(linkage, closure, &skeleton, &pose)?,
                over: over_constrained(linkage, &skeleton, &system, &rank, &redundant),
            });
        }
        refuse_idle_drivers(linkage, closure, &skeleton, &pose, &redundant)?;
        if excess > 0 {
            let names = skeleton.stressed(&system, &rank.stresses);
            return Err(StructureError::OverConstrained {
                excess,
                links: list(names.iter().map(String::as_str)),
            });
        }
        let groups = assur_group::groups(linkage, &redundant).ok_or_else(|| {
            StructureError::OverConstrained {
                excess: rank.excess,
                links: link_list(linkage, &(0..linkage.links.len()).collect::<Vec<_>>()),
            }
        })?;
        Ok(Self {
            mobility: rank.mobility,
            mobility_at_drawing: at_drawing.mobility,
            mobility_counted: counted(linkage),
            redundant,
            groups,
            drivers: linkage.drivers.iter().map(|&d| linkage.driver_name(d)).collect(),
            link_names: linkage.links.iter().map(|l| l.name.clone()).collect(),
        })
    }
}

/// Chebyshev-Grübler: n links at one joint are n − 1 pairs.
fn counted(linkage: &Linkage) -> i64 {
    let turning: usize =
        (0..linkage.joints.len()).map(|j| linkage.links_at(j).count().saturating_sub(1)).sum();
    let moving = linkage.links.len() - 1;
    let count = |n: usize| i64::try_from(n).unwrap_or(i64::MAX);
    3 * count(moving) - 2 * count(turning + linkage.slides.len())
}

fn link_list(linkage: &Linkage, links: &[usize]) -> String {
    let what = if links.len() == 1 { "link" } else { "links" };
    format!("{what} {}", list(links.iter().map(|&l| linkage.links[l].name.as_str())))
}

fn refuse_unconnected(linkage: &Linkage) -> Result<(), StructureError> {
    let mut reached = vec![false; linkage.links.len()];
    let mut queue = vec![linkage.ground];
    reached[linkage.ground] = true;
    while let Some(here) = queue.pop() {
        let by_joint = linkage.links[here].joints.iter().flat_map(|&j| linkage.links_at(j));
        let by_slide = linkage.slides.iter().filter_map(|s| match here {
            h if h == s.link => Some(s.on),
            h if h == s.on => Some(s.link),
            _ => None,
        });
        for next in by_joint.chain(by_slide).collect::<Vec<_>>() {
            if !reached[next] {
                reached[next] = true;
                queue.push(next);
            }
        }
    }
    let apart: Vec<usize> = (0..linkage.links.len()).filter(|&l| !reached[l]).collect();
    if apart.is_empty() {
        return Ok(());
    }
    Err(StructureError::Unconnected { links: link_list(linkage, &apart) })
}

/// The links of a structure: the over-constrained ones, or all.
fn rigid(linkage: &Linkage, skeleton: &Skeleton<'_>, system: &System, rank: &Rank) -> String {
    if rank.excess > 0 {
        return over_constrained(linkage, skeleton, system, rank, &LeftOut::default());
    }
    let moving: Vec<usize> = (0..linkage.links.len()).filter(|&l| l != linkage.ground).collect();
    format!("; {} form a structure", link_list(linkage, &moving))
}

/// `; over-constrained: …`, or nothing.
fn over_constrained(
    linkage: &Linkage,
    skeleton: &Skeleton<'_>,
    system: &System,
    rank: &Rank,
    redundant: &LeftOut,
) -> String {
    if rank.excess == 0 {
        return String::new();
    }
    let names = skeleton.stressed(system, &rank.stresses);
    let links = list(names.iter().map(String::as_str));
    let mut spare: Vec<&str> =
        redundant.links.iter().map(|&l| linkage.links[l].name.as_str()).collect();
    spare.extend(redundant.slides.iter().map(|&s| linkage.slides[s].name.as_str()));
    let spare = if spare.is_empty() {
        String::new()
    } else {
        format!(" (redundant: {})", list(spare.into_iter()))
    };
    format!("; over-constrained by {}: {links}{spare}", rank.excess)
}

/// `; under-constrained: …` with the links that still move when the drivers are
/// locked, or nothing.
fn under_constrained(
    linkage: &Linkage,
    closure: &Closure,
    skeleton: &Skeleton<'_>,
    pose: &Pose,
) -> Result<String, StructureError> {
    let everything = LeftOut::default();
    let (rotation, _) = rotations(linkage, &everything, true)?;
    let locked = System::new(linkage, closure, &everything, &rotation, true);
    let rank = skeleton.rank(&locked, pose)?;
    if rank.mobility == 0 {
        return Ok("; leave out drivers".into());
    }
    let links = link_list(linkage, &skeleton.moving_links(&locked, &rank.motions));
    Ok(format!(
        "; with every driver held still, {links} can still move: add a driver or a link there"
    ))
}

/// What still moves with all drivers locked.
fn idle(
    linkage: &Linkage,
    closure: &Closure,
    skeleton: &Skeleton<'_>,
    pose: &Pose,
    redundant: &LeftOut,
) -> Result<Rank, StructureError> {
    let (rotation, _) = rotations(linkage, redundant, true)?;
    let system = System::new(linkage, closure, redundant, &rotation, true);
    Ok(skeleton.rank(&system, pose)?)
}

/// With all drivers locked nothing may move any more.
fn refuse_idle_drivers(
    linkage: &Linkage,
    closure: &Closure,
    skeleton: &Skeleton<'_>,
    pose: &Pose,
    redundant: &LeftOut,
) -> Result<(), StructureError> {
    let freedom = |drivers: &[Driver]| -> Result<Rank, StructureError> {
        let mut trial = linkage.clone();
        trial.drivers = drivers.to_vec();
        idle(&trial, closure, skeleton, pose, redundant)
    };
    let rank = freedom(&linkage.drivers)?;
    if rank.mobility == 0 {
        return Ok(());
    }
    let (rotation, _) = rotations(linkage, redundant, true)?;
    let system = System::new(linkage, closure, redundant, &rotation, true);
    let still = link_list(linkage, &skeleton.moving_links(&system, &rank.motions));
    let reason = format!("with it held still, {still} can still move");
    for (index, &driver) in linkage.drivers.iter().enumerate() {
        let mut others = linkage.drivers.clone();
        others.remove(index);
        if freedom(&others)?.mobility == rank.mobility {
            return Err(StructureError::CannotDrive {
                driver: linkage.driver_name(driver),
                reason,
            });
        }
    }
    let driver = list(
        linkage
            .drivers
            .iter()
            .map(|&d| linkage.driver_name(d))
            .collect::<Vec<_>>()
            .iter()
            .map(String::as_str),
    );
    Err(StructureError::CannotDrive { driver, reason })
}
