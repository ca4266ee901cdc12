//! Structural analysis: mobility, redundant links, Assur groups.

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
pub(crate) mod skeleton;
pub(crate) mod system;

pub(crate) use adjust::adjust;
pub(crate) use assur_group::{Group, roman};
pub(crate) use closure::{Closure, LeftOut};

use std::fmt::Write as _;
use std::sync::atomic::AtomicBool;

use self::closure::{quoted_list, rotations};
use self::rank::Rank;
use self::skeleton::Skeleton;
use self::system::{Pose, System};
use crate::description::error::StructureError;
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
        let drives =
            |pose: &Pose| match locked_rank(linkage, closure, &skeleton, pose, &none_left_out) {
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
                over: rigid_part(linkage, &skeleton, &system, &at_drawing),
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
                drivers_are: match linkage.drivers.len() {
                    1 => "is 1 driver".into(),
                    n => format!("are {n} drivers"),
                },
                under: under_constrained(linkage, closure, &skeleton, &pose)?,
                over: over_constrained(linkage, &skeleton, &system, &rank, &redundant),
            });
        }
        check_drivers(linkage, closure, &skeleton, &pose, &redundant)?;
        if excess > 0 {
            let names = skeleton.stressed_names(&system, &rank.stresses);
            return Err(StructureError::OverConstrained {
                excess,
                links: quoted_list(names.iter().map(String::as_str)),
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

fn link_list(linkage: &Linkage, links: &[usize]) -> String {
    let what = if links.len() == 1 { "link" } else { "links" };
    format!("{what} {}", quoted_list(links.iter().map(|&l| linkage.links[l].name.as_str())))
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
    Err(StructureError::Unconnected { links: link_list(linkage, &unconnected) })
}

/// `; …` with the links of an immovable linkage: the over-constrained ones, or all.
fn rigid_part(linkage: &Linkage, skeleton: &Skeleton<'_>, system: &System, rank: &Rank) -> String {
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
    let names = skeleton.stressed_names(system, &rank.stresses);
    let links = quoted_list(names.iter().map(String::as_str));
    let mut redundant_names: Vec<&str> =
        redundant.links.iter().map(|&l| linkage.links[l].name.as_str()).collect();
    redundant_names.extend(redundant.slides.iter().map(|&s| linkage.slides[s].name.as_str()));
    let redundant_names = if redundant_names.is_empty() {
        String::new()
    } else {
        format!(" (redundant: {})", quoted_list(redundant_names.into_iter()))
    };
    format!("; over-constrained by {}: {links}{redundant_names}", rank.excess)
}

/// `; …` with the links that still move while the drivers are locked, or advice to leave out
/// drivers if none does.
fn under_constrained(
    linkage: &Linkage,
    closure: &Closure,
    skeleton: &Skeleton<'_>,
    pose: &Pose,
) -> Result<String, StructureError> {
    let none_left_out = LeftOut::default();
    let (rotation, _) = rotations(linkage, &none_left_out, true)?;
    let locked = System::new(linkage, closure, &none_left_out, &rotation, true);
    let rank = skeleton.rank(&locked, pose)?;
    if rank.mobility == 0 {
        return Ok("; leave out drivers".into());
    }
    let links = link_list(linkage, &skeleton.moving_links(&locked, &rank.motions));
    Ok(format!(
        "; with every driver held still, {links} can still move: add a driver or a link there"
    ))
}

/// Rank with all drivers locked; its motions are those that the drivers do not control.
fn locked_rank(
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

/// Checks that nothing can move while all drivers are locked; else names a driver at fault.
fn check_drivers(
    linkage: &Linkage,
    closure: &Closure,
    skeleton: &Skeleton<'_>,
    pose: &Pose,
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
    let moving_links = link_list(linkage, &skeleton.moving_links(&system, &rank.motions));
    let reason = format!("with it held still, {moving_links} can still move");
    for (index, &driver) in linkage.drivers.iter().enumerate() {
        let mut others = linkage.drivers.clone();
        others.remove(index);
        if rank_with(&others)?.mobility == rank.mobility {
            return Err(StructureError::CannotDrive {
                driver: linkage.driver_name(driver),
                reason,
            });
        }
    }
    let driver = quoted_list(
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
