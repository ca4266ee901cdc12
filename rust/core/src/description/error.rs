//! Errors of a description or a request.
//!
//! Each message names the joint, link, slide or dimension and gives the number; `hint` says what to
//! do.

use std::fmt;
use std::sync::atomic::{AtomicBool, Ordering};

use strum::{IntoStaticStr, VariantNames};
use thiserror::Error;

/// The kind of object that a name of a description denotes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Named {
    /// A joint.
    Joint,
    /// A link.
    Link,
    /// A slide (sliding pair).
    Slide,
    /// A dimension such as `coupler.length`.
    Dimension,
    /// A coordinate such as `B.x`, `rocker` or `bore`.
    Coordinate,
    /// A dyad, named by its inner joint or slide.
    Dyad,
}

/// The part of a description that names another.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Item {
    /// A link or a slide, by its name.
    Named(Named, String),
    /// A driver by a name alone.
    Driver,
    /// A driver that is the angle between two links.
    Drive,
    /// The assembly.
    Assembly,
}

impl fmt::Display for Item {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Named(kind, name) => write!(f, "{kind} {name:?}"),
            Self::Driver => f.write_str("driver"),
            Self::Drive => f.write_str("Drive"),
            Self::Assembly => f.write_str("assembly"),
        }
    }
}

/// Advice on an error.
pub trait Hint: fmt::Display {
    /// Advice, if any.
    fn hint(&self) -> Option<String>;

    /// The message followed by the advice.
    fn with_hint(&self) -> String {
        match self.hint() {
            Some(hint) => format!("{self}; {hint}"),
            None => self.to_string(),
        }
    }
}

/// Names in quotes, separated by commas.
pub(crate) fn quoted_list(names: &[String]) -> String {
    names.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ")
}

/// [`quoted_list`] with a noun before the names.
fn counted_list(noun: &str, names: &[String]) -> String {
    format!("{noun}{} {}", if names.len() == 1 { "" } else { "s" }, quoted_list(names))
}

fn link_list(links: &[String]) -> String {
    counted_list("link", links)
}

/// Constraints of a linkage that exceed those that are independent.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Overconstraint {
    /// Their number.
    pub excess: usize,
    /// The links and slides they are in.
    pub links: Vec<String>,
    /// The parts that can be left out without freeing the linkage.
    pub redundant: Vec<String>,
}

impl fmt::Display for Overconstraint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "; over-constrained by {}: {}", self.excess, quoted_list(&self.links))?;
        match &self.redundant[..] {
            [] => Ok(()),
            redundant => write!(f, " (redundant: {})", quoted_list(redundant)),
        }
    }
}

/// Why a driver cannot drive.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum DriverFault {
    /// The angle between two links is fixed.
    #[error(
        "links {link:?} and {other:?} cannot turn relative to each other (slides or other drivers fix the angle between them)"
    )]
    AngleFixed {
        /// One link.
        link: String,
        /// The other.
        other: String,
    },
    /// A slide fixes the driven angle.
    #[error("slide {slide:?} fixes the angle that it would change")]
    SlideFixes {
        /// The slide.
        slide: String,
    },
    /// With the drivers held still, links can still move.
    #[error("with every driver held still, {} can still move", link_list(links))]
    LeavesFree {
        /// The links.
        links: Vec<String>,
    },
}

fn optional(overconstraint: Option<&Overconstraint>) -> String {
    overconstraint.map_or(String::new(), ToString::to_string)
}

fn some_links(links: &[String]) -> String {
    match links {
        [link] => format!("{link:?} and others"),
        links => quoted_list(links),
    }
}

fn drivers_text(drivers: usize) -> String {
    if drivers == 1 { "is 1 driver".into() } else { format!("are {drivers} drivers") }
}

/// The numbers that a drawing may have; `what`: the kind of object that the number belongs to.
fn range(what: Named) -> &'static str {
    match what {
        Named::Link => "a length must be from 1e-153 to 1e153 m",
        Named::Slide => "an angle must be within ±1e153 rad",
        _ => "a coordinate must be within ±1e153 m",
    }
}

fn free_links(links: &[String]) -> String {
    match links {
        [] => String::new(),
        links => format!("; with every driver held still, {} can still move", link_list(links)),
    }
}

fn rigid_links(overconstraint: Option<&Overconstraint>, links: &[String]) -> String {
    match overconstraint {
        Some(overconstraint) => overconstraint.to_string(),
        None => format!("; {} form a structure", link_list(links)),
    }
}

impl std::fmt::Display for Named {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Joint => "joint",
            Self::Link => "link",
            Self::Slide => "slide",
            Self::Dimension => "dimension",
            Self::Coordinate => "coordinate",
            Self::Dyad => "dyad",
        })
    }
}

/// Why a description is not a solvable mechanism.
#[derive(Debug, Clone, PartialEq, Error, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "snake_case")]
#[non_exhaustive]
#[expect(missing_docs, reason = "the sentences say what the fields are")]
pub enum StructureError {
    /// A name is empty or contains a blank, dot, slash, quote or bracket.
    #[error(
        "{kind} name {name:?} is not allowed: a name must not be empty or contain blanks, dots, slashes, quotes or brackets"
    )]
    BadName { kind: Named, name: String },
    /// Two objects share a name.
    #[error(
        "the name {name:?} is used twice ({first} and {second}): every joint, link and slide needs a name of its own"
    )]
    DoubledName { name: String, first: Named, second: Named },
    /// A joint is listed twice in one link.
    #[error("link {link:?} lists joint {joint:?} twice")]
    DoubledJoint { link: String, joint: String },
    /// An unknown name.
    #[error("{item} names the {kind} {name:?}, which does not exist")]
    Unknown { kind: Named, name: String, item: Item, hint: Option<String> },
    /// A coordinate or angle is NaN or infinite.
    #[error("{what} of {kind} {name:?} is {}: a finite number is needed", number(*value))]
    NotFinite { kind: Named, name: String, what: &'static str, value: f64 },
    /// A coordinate or length is outside the range from 1e-153 to 1e153.
    #[error("{what} of {kind} {name:?} is {value:e}: {}", range(*kind))]
    OutOfRange { kind: Named, name: String, what: &'static str, value: f64 },
    /// A joint belongs to no link.
    #[error("joint {joint:?} is on no link")]
    LooseJoint { joint: String },
    /// First and second joint of a link coincide.
    #[error(
        "link {link:?} has length zero: its first two joints {first:?} and {second:?} are both at ({}, {})",
        number(*x), number(*y)
    )]
    ZeroLength { link: String, first: String, second: String, x: f64, y: f64 },
    /// No link is called `ground`.
    #[error("there is no link \"ground\"")]
    NoGround,
    /// A slide or driver relates a link to itself.
    #[error("{item} relates link {link:?} to itself")]
    SameLink { item: Item, link: String },
    /// The named origin is not a joint of the link that carries the guide.
    #[error(
        "slide {slide:?} has origin {joint:?}, which is not a joint of link {link:?} that carries the guide"
    )]
    OriginNotOnLink { slide: String, joint: String, link: String },
    /// A slide of a link without joints has no origin.
    #[error(
        "slide {slide:?}: link {link:?} has no joint, so the drawing does not say where the guide passes"
    )]
    GuideNowhere { slide: String, link: String, on: String },
    /// The guides of a link without joints do not intersect.
    #[error(
        "link {link:?} has no joint and its guides do not cross: it needs two slides that are not parallel"
    )]
    Unplaced { link: String },
    /// No driver is given.
    #[error("the mechanism has no driver")]
    NoDriver,
    /// The ground is given as a driver.
    #[error("driver {driver:?}: the ground does not move")]
    GroundDriven { driver: String },
    /// The same coordinate is driven twice.
    #[error("driver {driver:?} is given twice")]
    DoubledDriver { driver: String },
    /// Links are not connected to the ground.
    #[error(
        "{} {} not connected to the ground by any joint or slide",
        link_list(links), if links.len() == 1 { "is" } else { "are" }
    )]
    Unconnected { links: Vec<String> },
    /// Sliding pairs alone form a closed chain.
    #[error(
        "slides {} form a closed chain of sliding pairs only (PPP): links joined this way cannot turn relative to each other, and the chain is not an Assur group",
        quoted_list(slides)
    )]
    SlidesOnly { slides: Vec<String> },
    /// The mobility by rank is zero.
    #[error(
        "the linkage cannot move (mobility 0, counted {counted} by Chebyshev-Grübler){}",
        rigid_links(overconstraint.as_ref(), links)
    )]
    Immovable { counted: i64, links: Vec<String>, overconstraint: Option<Overconstraint> },
    /// The mobility by rank differs from the number of drivers.
    #[error(
        "mobility is {mobility} (counted {counted} by Chebyshev-Grübler) but there {}{}{}",
        drivers_text(*drivers), free_links(free), optional(overconstraint.as_ref())
    )]
    Mobility {
        mobility: usize,
        counted: i64,
        drivers: usize,
        free: Vec<String>,
        overconstraint: Option<Overconstraint>,
    },
    /// A driver cannot move the linkage, or several together cannot.
    #[error("{} cannot drive: {fault}", counted_list("driver", drivers))]
    CannotDrive { drivers: Vec<String>, fault: DriverFault },
    /// The linkage is over-constrained and no whole link or slide is redundant.
    #[error(
        "{} are over-constrained by {excess}, and none of them can be left out as a whole without freeing the linkage",
        quoted_list(links)
    )]
    OverConstrained { excess: usize, links: Vec<String> },
    /// A dyad is drawn with its links collinear.
    #[error(
        "dyad {name:?} ({dyad}) is drawn with its links collinear (sine {} between its legs): the drawing does not show on which side {name:?} is",
        rounded(*sine, 2)
    )]
    FlatDyad { dyad: String, inner: Named, name: String, sine: f64 },
    /// Links would be redundant if the drawing were more accurate.
    #[error(
        "{} can only move together if their lengths agree, but they are {} m off ({} of the size; a drawing is adjusted up to {})",
        some_links(links), rounded(*gap, 2), rounded(*part, 1), adjusted_up_to(*limit)
    )]
    AlmostFits {
        links: Vec<String>,
        gap: f64,
        part: f64,
        /// The tolerance that was given, m.
        limit: Option<f64>,
    },
    /// A slide whose value is a length is drawn, or its assembly chosen, without a positive one.
    #[error("slide {slide:?} would be {} m long, but its value is a length", rounded(*value, 4))]
    NoLength { slide: String, value: f64 },
    /// The caller cancelled the analysis.
    #[error("the work was interrupted: the structure is not known")]
    Interrupted,
    /// An assembly sign is not ±1.
    #[error("assembly[{name:?}] is {value}: it must be +1 or -1")]
    BadSign { name: String, value: i64 },
}

impl Hint for StructureError {
    fn hint(&self) -> Option<String> {
        Some(match self {
            Self::Unknown { hint, .. } => return hint.clone(),
            Self::OutOfRange { kind: Named::Joint | Named::Link, .. } => {
                "choose another unit".into()
            }
            Self::LooseJoint { .. } => {
                "add it to the list of the link it belongs to, or leave it out".into()
            }
            Self::NoGround => "add links[\"ground\"] with the fixed joints (an empty list if only slides are fixed)".into(),
            Self::OriginNotOnLink { link, .. } => {
                format!("name a joint of {link:?}, or leave the origin out")
            }
            Self::GuideNowhere { on, .. } => {
                format!("give the slide an origin, a joint of link {on:?}")
            }
            Self::NoDriver => "name a link, a slide or a Drive".into(),
            Self::SlidesOnly { .. } => "join two of these links by a joint".into(),
            Self::CannotDrive { fault: DriverFault::LeavesFree { .. }, .. } => {
                "drive one of these instead".into()
            }
            Self::CannotDrive { .. } => "drive a slide or another link".into(),
            Self::OverConstrained { .. } => {
                "move what hangs on one of them to another link, so that it can be left out".into()
            }
            Self::Immovable { .. } => "take out a link or a pair there; a link that changes its length, such as a cylinder, needs two links (barrel and rod) with a Slide between them".into(),
            Self::Mobility { free, drivers, mobility, .. } if free.is_empty() && drivers > mobility => {
                match drivers - mobility {
                    1 => "leave out one of them".into(),
                    surplus => format!("leave out {surplus} of them"),
                }
            }
            Self::Mobility { free, .. } if !free.is_empty() => {
                "add a driver or a link there".into()
            }
            Self::FlatDyad { name, .. } => format!(
                "draw it to one side, or name the assembly: assembly={{{name:?}: +1}} or -1"
            ),
            Self::NoLength { .. } => {
                "a length is positive: turn the guide round, or leave `length` out".into()
            }
            Self::AlmostFits { limit: None, .. } => {
                "type the drawing with more digits, give the length to which it is known (tolerance), or leave one of them out".into()
            }
            Self::AlmostFits { .. } => "give a greater tolerance, or leave one of them out".into(),
            _ => return None,
        })
    }
}

/// The caller cancelled the work.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Interrupted;

/// Fails once the caller has set the flag.
pub(crate) fn check_flag(cancel: Option<&AtomicBool>) -> Result<(), Interrupted> {
    let stop = cancel.is_some_and(|flag| flag.load(Ordering::Relaxed));
    if stop { Err(Interrupted) } else { Ok(()) }
}

impl From<Interrupted> for StructureError {
    fn from(_: Interrupted) -> Self {
        Self::Interrupted
    }
}

fn adjusted_up_to(limit: Option<f64>) -> String {
    limit.map_or("2e-9".into(), |limit| format!("its tolerance, {} m", number(limit)))
}

/// The shortest text that reads back as the same number, without rows of zeros.
#[must_use]
pub(crate) fn number(x: f64) -> String {
    match x.abs() {
        0.0 | 1e-4..1e7 => format!("{x}"),
        _ => format!("{x:e}"),
    }
}

/// [`number`], rounded to a number of digits.
pub(crate) fn rounded(x: f64, digits: usize) -> String {
    number(format!("{x:.*e}", digits.saturating_sub(1)).parse().unwrap_or(x))
}

/// Coordinates as text.
pub(crate) fn coordinate_text(q: &[f64]) -> String {
    match q {
        [single] => number(*single),
        several => {
            format!("({})", several.iter().map(|&x| number(x)).collect::<Vec<_>>().join(", "))
        }
    }
}

/// The end of a sentence on coordinates too far from the drawing.
pub(crate) const TOO_FAR: &str = "is too far from the drawing to be tracked: an angle may be 1000 \
     turns away, a slide 3000 times the mechanism's size";

/// Why no position can be computed.
#[derive(Debug, Clone, PartialEq, Error, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "snake_case")]
#[non_exhaustive]
#[expect(missing_docs, reason = "the sentences say what the fields are")]
pub enum SolveError {
    /// The caller cancelled the work.
    #[error("the work was interrupted: not all positions were solved")]
    Interrupted,
    /// The complex assemblies of a group cannot be counted.
    #[error("group {group} has more assemblies than can be found")]
    TooManyAssemblies { group: String },
    /// A dimension is not finite or out of range, or a length is not positive.
    #[error("dimension {name:?} is {}: {need}", number(*value))]
    BadDimension { name: String, value: f64, need: &'static str },
    /// A redundant link ties dimensions together, so there are no sensitivities to one alone.
    #[error(
        "there are no sensitivities to single dimensions: the redundant {kind} {name:?} fits only while several of them change together"
    )]
    Redundant { kind: Named, name: String },
    /// A coordinate too far from the drawing.
    #[error("q = {} {TOO_FAR}", coordinate_text(q))]
    CoordinateTooFar { q: Vec<f64> },
    /// An unknown name.
    #[error("there is no {kind} {name:?}")]
    Unknown { kind: Named, name: String, hint: Option<String> },
    /// A joint has two coordinates.
    #[error(
        "coordinate {name:?}{}: \"{joint}.x\" or \"{joint}.y\" is needed",
        if *is_joint { " is a joint" } else { "" }
    )]
    NoAxis { name: String, joint: String, is_joint: bool },
    /// Array shapes do not match.
    #[error("{0}")]
    Shape(String),
    /// The data that the work needs do not fit in memory.
    #[error("out of memory: {numbers} numbers at once do not fit")]
    OutOfMemory { numbers: usize },
    /// The order is outside 0..=3.
    #[error("order is {0}: analogues are given to order 3")]
    Order(usize),
}

impl Hint for SolveError {
    fn hint(&self) -> Option<String> {
        match self {
            Self::Unknown { hint, .. } => hint.clone(),
            Self::TooManyAssemblies { .. } => {
                Some("for another assembly draw the mechanism that way".into())
            }
            Self::CoordinateTooFar { .. } => Some("take whole turns off an angle".into()),
            Self::Redundant { name, .. } => Some(format!("leave {name:?} out")),
            Self::OutOfMemory { .. } => Some("ask for fewer designs or positions at once".into()),
            _ => None,
        }
    }
}
