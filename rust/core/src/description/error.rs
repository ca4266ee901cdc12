//! Errors of a description or a request.
//!
//! Each message names the joint, link, slide or dimension, gives the number and
//! says what to do.

use thiserror::Error;

/// What a name of a description stands for.
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
    /// A dyad, named by its inner joint or slide.
    Dyad,
}

impl std::fmt::Display for Named {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Joint => "joint",
            Self::Link => "link",
            Self::Slide => "slide",
            Self::Dimension => "dimension",
            Self::Dyad => "dyad",
        })
    }
}

/// Why a description is not a solvable mechanism.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the sentences say what the fields are")]
pub enum StructureError {
    /// A name is empty or contains a blank, dot, slash, quote or bracket.
    #[error(
        "{kind} name {name:?} is not allowed: a name is not empty and has no blanks, dots, slashes, quotes or brackets"
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
    #[error("{place} names the {kind} {name:?}, which does not exist{hint}")]
    Unknown { kind: Named, name: String, place: String, hint: String },
    /// A coordinate or angle is NaN or infinite.
    #[error("{what} of {kind} {name:?} is {}: a finite number is needed", number(*value))]
    NotFinite { kind: Named, name: String, what: &'static str, value: f64 },
    /// A coordinate or length is outside the range from 1e-153 to 1e153.
    #[error(
        "{what} of {kind} {name:?} is {value:e}: lengths from 1e-153 to 1e153 can be computed with; choose another unit"
    )]
    OutOfRange { kind: Named, name: String, what: &'static str, value: f64 },
    /// A joint belongs to no link.
    #[error(
        "joint {joint:?} is on no link: add it to the list of the link it belongs to, or leave it out"
    )]
    LooseJoint { joint: String },
    /// First and second joint of a link coincide.
    #[error(
        "link {link:?} has length zero: its first two joints {first:?} and {second:?} are both at ({x}, {y})"
    )]
    ZeroLength { link: String, first: String, second: String, x: f64, y: f64 },
    /// There is no link called `ground`.
    #[error(
        "there is no link \"ground\": add links[\"ground\"] with the fixed joints (an empty list if only slides are fixed)"
    )]
    NoGround,
    /// A slide or driver relates a link to itself.
    #[error("{place} relates link {link:?} to itself")]
    SameLink { place: String, link: String },
    /// The named origin is not a joint of the link that carries the guide.
    #[error(
        "slide {slide:?} has origin {joint:?}, which is not a joint of link {link:?} that carries the guide"
    )]
    OriginNotOnLink { slide: String, joint: String, link: String },
    /// A slide of a link without joints has no origin.
    #[error(
        "slide {slide:?}: link {link:?} has no joint, so the drawing does not say where the guide passes: give the slide an origin, a joint of link {on:?}"
    )]
    GuideNowhere { slide: String, link: String, on: String },
    /// The guides of a link without joints do not intersect.
    #[error(
        "link {link:?} has no joint and its guides do not cross: it needs two slides that are not parallel"
    )]
    Unplaced { link: String },
    /// No driver is given.
    #[error("the mechanism has no driver: name a link, a slide or a Drive")]
    NoDriver,
    /// The ground is given as a driver.
    #[error("driver {driver}: the ground does not move")]
    GroundDriven { driver: String },
    /// The same coordinate is driven twice.
    #[error("driver {driver} is given twice")]
    DoubledDriver { driver: String },
    /// Links are not connected to the ground.
    #[error("not connected to the ground by any joint or slide: {links}")]
    Unconnected { links: String },
    /// Sliding pairs alone form a closed chain.
    #[error(
        "slides {slides} form a closed chain of sliding pairs only (PPP): links joined so cannot turn, and the chain is no Assur group"
    )]
    SlidesOnly { slides: String },
    /// The mobility by rank is zero.
    #[error(
        "the linkage cannot move (mobility 0, counted {counted} by Chebyshev-Grübler){over}: take out a link or a pair there"
    )]
    Immovable { counted: i64, over: String },
    /// The mobility by rank differs from the number of drivers.
    #[error(
        "mobility is {mobility} (counted {counted} by Chebyshev-Grübler) but there {drivers_are}{under}{over}"
    )]
    Mobility {
        mobility: usize,
        counted: i64,
        drivers: usize,
        drivers_are: String,
        under: String,
        over: String,
    },
    /// A driver cannot move the linkage.
    #[error("driver {driver} cannot drive: {reason}")]
    CannotDrive { driver: String, reason: String },
    /// The linkage is over-constrained and no whole link or slide is redundant.
    #[error(
        "over-constrained by {excess}: {links}; no whole link or slide can be left out of them without freeing the linkage"
    )]
    OverConstrained { excess: usize, links: String },
    /// A dyad is drawn flat.
    #[error(
        "dyad {dyad} is drawn flat (sine {sine:.1e} between its legs): the drawing does not say on which side {name:?} is; draw it to one side, or name the assembly: assembly={{{name:?}: +1}} or -1"
    )]
    FlatDyad { dyad: String, name: String, sine: f64 },
    /// Links would be redundant if the drawing were more accurate.
    #[error(
        "{links} can only move together if their lengths agree, and these are {gap:.1e} m off ({part:.0e} of the size; up to 2e-9 a drawing is adjusted): type it with more digits, or leave one of them out"
    )]
    AlmostFits { links: String, gap: f64, part: f64 },
    /// The caller cancelled the analysis.
    #[error("the work was interrupted: the structure is not known")]
    Interrupted,
    /// An assembly sign is not ±1.
    #[error("assembly[{name:?}] is {value}: it must be +1 or -1")]
    BadSign { name: String, value: i64 },
}

/// The caller cancelled the work.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Interrupted;

impl From<Interrupted> for StructureError {
    fn from(_: Interrupted) -> Self {
        Self::Interrupted
    }
}

/// The shortest text that reads back as the same number, without rows of zeros.
#[must_use]
pub(crate) fn number(x: f64) -> String {
    match x.abs() {
        0.0 | 1e-4..1e7 => format!("{x}"),
        _ => format!("{x:e}"),
    }
}

/// Why no position can be computed.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the sentences say what the fields are")]
pub enum SolveError {
    /// The caller cancelled the work.
    #[error("the work was interrupted: not all positions were solved")]
    Interrupted,
    /// Assemblies of a group above class II are not supported.
    #[error(
        "group {group} is of class {class}: assemblies() supports class II only; for another assembly draw the mechanism that way"
    )]
    HigherClass { group: String, class: String },
    /// A dimension is not finite or out of range, or a length is not positive.
    #[error("dimension {name:?} is {}: {need}", number(*value))]
    BadDimension { name: String, value: f64, need: &'static str },
    /// A redundant link ties dimensions together, so there are no sensitivities to one alone.
    #[error(
        "the redundant {name:?} fits only as long as several dimensions change together: there are no sensitivities by one of them; leave it out"
    )]
    Redundant { name: String },
    /// An unknown name.
    #[error("there is no {kind} {name:?}{hint}")]
    Unknown { kind: Named, name: String, hint: String },
    /// Array shapes do not match.
    #[error("{0}")]
    Shape(String),
    /// The order is outside 0..=3.
    #[error("order is {0}: analogues are given to order 3")]
    Order(usize),
}
