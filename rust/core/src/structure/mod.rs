//! Structural analysis: mobility, redundant links, Assur groups.

pub(crate) mod adjust;
pub(crate) mod assur_group;
pub(crate) mod closure;
pub(crate) mod contour;
pub(crate) mod drawing_change;
pub(crate) mod elimination;
pub(crate) mod equal_parts;
pub(crate) mod fit_conditions;
pub(crate) mod fitted;
pub(crate) mod freedom;
pub(crate) mod least_norm;
pub(crate) mod matching;
pub(crate) mod rank;
pub(crate) mod redundancy;
pub(crate) mod skeleton;
pub(crate) mod system;

pub(crate) use assur_group::{Group, roman};
pub(crate) use closure::{Closure, LeftOut};

use std::fmt::Write as _;
use std::sync::atomic::AtomicBool;

use self::closure::rotations;
use self::rank::Rank;
use self::skeleton::Skeleton;
use self::system::{SkeletonPose, System};
use crate::description::error::{DriverFault, Overconstraint, StructureError};
use crate::description::{Driver, Linkage};

/// The structure of a mechanism with its drivers.
#[derive(Debug, Clone, PartialEq)]
pub struct Structure {
    /// Degrees of freedom, from the rank of the closure equations at a regular position.
    pub mobility: usize,
    /// Degrees of freedom at the drawing itself: more than `mobility` if it is singular.
    pub mobility_at_drawing: usize,
    /// Degrees of freedom by counting, 3 n − 2 p (Chebyshev 1870, Grübler 1883).
    pub mobility_counted: i64,
    /// Links and slides that the motion does not need. Whether they close is
    /// checked at every position.
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

    /// Class of the mechanism: the highest class of its groups, at least I.
    #[must_use]
    pub fn class(&self) -> usize {
        self.groups.iter().map(|g| g.class).max().unwrap_or(1)
    }

    /// Analyses a linkage.
    ///
    /// # Errors
    ///
    /// [`StructureError`], naming the links, if it is not a mechanism with one driver for each
    /// degree of freedom; [`StructureError::Interrupted`] once `cancel` is true.
    pub fn of(
        linkage: &Linkage,
        closure: &Closure,
        cancel: Option<&AtomicBool>,
    ) -> Result<Self, StructureError> {
        check_connected(linkage)?;
        let none_left_out = LeftOut::default();
        let (free, classes) = rotations(linkage, &none_left_out, false)?;
        let skeleton = Skeleton::new(linkage, closure, &free, classes, cancel);
        let system = System::new(linkage, closure, &none_left_out, &free, false);
        let at_drawing = skeleton.rank(&system, skeleton.drawing())?;
        let drives = |pose: &SkeletonPose| match locked_rank(
            linkage,
            closure,
            &skeleton,
            pose,
            &none_left_out,
        ) {
            Ok(rank) => Ok(rank.mobility == 0),
            Err(StructureError::Interrupted) => Err(StructureError::Interrupted),
            Err(_) => Ok(false),
        };
        // Take the drawing if all its equations are independent and the drivers control its motion;
        // otherwise a displaced pose, preferably on a branch along which they do.
        let drawing = (skeleton.drawing().clone(), at_drawing.clone());
        let chosen = if at_drawing.excess == 0 && at_drawing.mobility > 0 && drives(&drawing.0)? {
            Some(drawing)
        } else {
            let poses = skeleton.displaced_poses(&system)?;
            let mut index = None;
            for (i, (pose, _)) in poses.iter().enumerate() {
                if drives(pose)? {
                    index = Some(i);
                    break;
                }
            }
            poses.into_iter().nth(index.unwrap_or(0))
        };
        let Some((pose, rank)) = chosen else {
            return Err(StructureError::Immovable {
                counted: count_mobility(linkage),
                links: moving_link_names(linkage),
                overconstraint: overconstraint(
                    linkage,
                    &skeleton,
                    &system,
                    &at_drawing,
                    &none_left_out,
                ),
            });
        };
        let (redundant, excess) = redundancy::find_redundant(
            linkage,
            closure,
            &skeleton,
            &pose,
            &rank,
            none_left_out.clone(),
        )?;
        if rank.mobility != linkage.drivers.len() {
            return Err(StructureError::Mobility {
                mobility: rank.mobility,
                counted: count_mobility(linkage),
                drivers: linkage.drivers.len(),
                free: free_links(linkage, closure, &skeleton, &pose)?,
                overconstraint: overconstraint(linkage, &skeleton, &system, &rank, &redundant),
            });
        }
        check_drivers(linkage, closure, &skeleton, &pose, &redundant)?;
        if excess > 0 {
            let links = skeleton.stressed_names(&system, &rank.stresses);
            return Err(StructureError::OverConstrained { excess, links });
        }
        let groups = assur_group::groups(linkage, &redundant, cancel)?.ok_or_else(|| {
            StructureError::OverConstrained {
                excess: rank.excess,
                links: linkage.links.iter().map(|link| link.name.clone()).collect(),
            }
        })?;
        Ok(Self {
            mobility: rank.mobility,
            mobility_at_drawing: at_drawing.mobility,
            mobility_counted: count_mobility(linkage),
            redundant,
            groups,
            drivers: linkage.drivers.iter().map(|&d| linkage.driver_name(d)).collect(),
            link_names: linkage.links.iter().map(|l| l.name.clone()).collect(),
        })
    }
}

/// Mobility by Chebyshev-Grübler: n links at one joint are n − 1 pairs.
fn count_mobility(linkage: &Linkage) -> i64 {
    let turning: usize =
        (0..linkage.joints.len()).map(|j| linkage.links_at(j).count().saturating_sub(1)).sum();
    let moving = linkage.links.len() - 1;
    let signed = |n: usize| i64::try_from(n).unwrap_or(i64::MAX);
    3 * signed(moving) - 2 * signed(turning + linkage.slides.len())
}

fn names_of(linkage: &Linkage, links: &[usize]) -> Vec<String> {
    links.iter().map(|&link| linkage.links[link].name.clone()).collect()
}

fn check_connected(linkage: &Linkage) -> Result<(), StructureError> {
    let mut reached = vec![false; linkage.links.len()];
    let mut queue = vec![linkage.ground];
    reached[linkage.ground] = true;
    while let Some(link) = queue.pop() {
        let by_joint = linkage.links[link].joints.iter().flat_map(|&j| linkage.links_at(j));
        let by_slide = linkage.slides.iter().filter_map(|s| match link {
            l if l == s.link => Some(s.on),
            l if l == s.on => Some(s.link),
            _ => None,
        });
        for next in by_joint.chain(by_slide).collect::<Vec<_>>() {
            if !reached[next] {
                reached[next] = true;
                queue.push(next);
            }
        }
    }
    let unconnected: Vec<usize> = (0..linkage.links.len()).filter(|&l| !reached[l]).collect();
    if unconnected.is_empty() {
        return Ok(());
    }
    Err(StructureError::Unconnected { links: names_of(linkage, &unconnected) })
}

fn moving_link_names(linkage: &Linkage) -> Vec<String> {
    let moving: Vec<usize> = (0..linkage.links.len()).filter(|&l| l != linkage.ground).collect();
    names_of(linkage, &moving)
}

/// The constraints in excess, if any.
fn overconstraint(
    linkage: &Linkage,
    skeleton: &Skeleton<'_>,
    system: &System,
    rank: &Rank,
    redundant: &LeftOut,
) -> Option<Overconstraint> {
    let slide_name = |&slide: &usize| linkage.slides[slide].name.clone();
    (rank.excess > 0).then(|| Overconstraint {
        excess: rank.excess,
        links: skeleton.stressed_names(system, &rank.stresses),
        redundant: names_of(linkage, &redundant.links)
            .into_iter()
            .chain(redundant.slides.iter().map(slide_name))
            .collect(),
    })
}

/// The links that still move while the drivers are locked.
fn free_links(
    linkage: &Linkage,
    closure: &Closure,
    skeleton: &Skeleton<'_>,
    pose: &SkeletonPose,
) -> Result<Vec<String>, StructureError> {
    let none_left_out = LeftOut::default();
    let (rotation, _) = rotations(linkage, &none_left_out, true)?;
    let locked = System::new(linkage, closure, &none_left_out, &rotation, true);
    let rank = skeleton.rank(&locked, pose)?;
    if rank.mobility == 0 {
        return Ok(Vec::new());
    }
    Ok(names_of(linkage, &skeleton.moving_links(&locked, &rank.motions)))
}

/// Rank with all drivers locked; its motions are those that the drivers do not control.
fn locked_rank(
    linkage: &Linkage,
    closure: &Closure,
    skeleton: &Skeleton<'_>,
    pose: &SkeletonPose,
    redundant: &LeftOut,
) -> Result<Rank, StructureError> {
    let (rotation, _) = rotations(linkage, redundant, true)?;
    let system = System::new(linkage, closure, redundant, &rotation, true);
    Ok(skeleton.rank(&system, pose)?)
}

/// Names of the links and slides of a rigid linkage that keep its drivers from moving: they bear a load from
/// a driver, and without one of them the linkage would move. Includes the over-constrained links, if any.
///
/// # Errors
///
/// Those of [`rotations`], and [`StructureError::Interrupted`].
pub(crate) fn holding_drivers(
    linkage: &Linkage,
    cancel: Option<&AtomicBool>,
) -> Result<Vec<String>, StructureError> {
    let closure = Closure::of(linkage);
    let none_left_out = LeftOut::default();
    let (free, classes) = rotations(linkage, &none_left_out, false)?;
    let skeleton = Skeleton::new(linkage, &closure, &free, classes, cancel);
    let (rotation, _) = rotations(linkage, &none_left_out, true)?;
    let locked = System::new(linkage, &closure, &none_left_out, &rotation, true);
    // A coordinate of a driver removes one unknown: the driver's load is a self-stress.
    let rank = skeleton.rank(&locked, skeleton.drawing())?;
    Ok(skeleton.stressed_names(&locked, &rank.stresses))
}

/// Checks that all links stand still while all drivers are locked; else names a driver at fault.
fn check_drivers(
    linkage: &Linkage,
    closure: &Closure,
    skeleton: &Skeleton<'_>,
    pose: &SkeletonPose,
    redundant: &LeftOut,
) -> Result<(), StructureError> {
    let rank_with = |drivers: &[Driver]| -> Result<Rank, StructureError> {
        let mut trial = linkage.clone();
        trial.drivers = drivers.to_vec();
        locked_rank(&trial, closure, skeleton, pose, redundant)
    };
    let rank = rank_with(&linkage.drivers)?;
    if rank.mobility == 0 {
        return Ok(());
    }
    let (rotation, _) = rotations(linkage, redundant, true)?;
    let system = System::new(linkage, closure, redundant, &rotation, true);
    let links = names_of(linkage, &skeleton.moving_links(&system, &rank.motions));
    let fault = DriverFault::LeavesFree { links };
    for (index, &driver) in linkage.drivers.iter().enumerate() {
        let mut remaining = linkage.drivers.clone();
        remaining.remove(index);
        if rank_with(&remaining)?.mobility == rank.mobility {
            return Err(StructureError::CannotDrive {
                drivers: vec![linkage.driver_name(driver)],
                fault,
            });
        }
    }
    let drivers = linkage.drivers.iter().map(|&driver| linkage.driver_name(driver)).collect();
    Err(StructureError::CannotDrive { drivers, fault })
}
