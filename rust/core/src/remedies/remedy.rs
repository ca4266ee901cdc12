//! A remedy: an edit of a refused description, after which it is a mechanism.

use strum::{IntoStaticStr, VariantNames};

use crate::description::Description;

/// Kind of a remedy.
#[derive(Debug, Clone, Copy, PartialEq, Eq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "snake_case")]
#[non_exhaustive]
pub enum RemedyKind {
    /// A joint slides along a guide by a new block, or a link itself slides.
    LetSlide,
    /// Links or slides are taken out.
    TakeOut,
    /// A link is parted from a joint, with a new link between them.
    Part,
    /// A new link between two joints, or a joint and the ground.
    Join,
    /// Joints are held on the ground.
    Hold,
    /// Two links become one.
    Unite,
    /// A link or slide drives, in addition or in place of another.
    Drive,
    /// A driver is left out.
    LeaveUndriven,
    /// A joint that is not on a link, or the guide of a slide, gets its place.
    Place,
}

/// An edit of a refused description. The edited description was built before the remedy was offered: it
/// is a mechanism with as many drivers as freedoms, also at the drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Remedy {
    /// Kind of the edit.
    pub kind: RemedyKind,
    /// The joints, links and slides concerned.
    pub names: Vec<String>,
    /// The instruction: "Let F slide on the ground".
    pub text: String,
    /// The effect on the rest: "brace stays, its foot follows".
    pub detail: String,
    /// The description with the edit made.
    pub description: Description,
}
