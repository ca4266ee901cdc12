//! The coordinates that can have extremes, and the extremes.

use crate::description::error::{Named, SolveError};
use crate::description::names::suggest;
use crate::plan::mechanism::Mechanism;

/// A coordinate of the motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tracked {
    /// A joint's x (0) or y (1), m.
    Joint(usize, usize),
    /// A link's angle, rad.
    Link(usize),
    /// A slide's value, m.
    Slide(usize),
}

impl Mechanism {
    /// A coordinate by its name: `"B.x"`, `"rocker"`, `"bore"`.
    ///
    /// # Errors
    ///
    /// [`SolveError::NoAxis`] and [`SolveError::Unknown`], with similar names.
    pub fn coordinate(&self, name: &str) -> Result<Tracked, SolveError> {
        let no_axis = |joint: &str| {
            let is_joint = joint == name;
            SolveError::NoAxis { name: name.into(), joint: joint.into(), is_joint }
        };
        if let Some((joint, axis)) = name.rsplit_once('.') {
            let component = match axis {
                "x" => 0,
                "y" => 1,
                _ => return Err(no_axis(joint)),
            };
            return Ok(Tracked::Joint(self.joint(joint)?, component));
        }
        let (joints, links) = (&self.linkage().joints, &self.linkage().links);
        let slides = &self.linkage().slides;
        if joints.iter().any(|joint| joint.name == name) {
            return Err(no_axis(name));
        }
        if let Some(slide) = slides.iter().position(|slide| slide.name == name) {
            return Ok(Tracked::Slide(slide));
        }
        if let Some(link) = links.iter().position(|link| link.name == name) {
            return Ok(Tracked::Link(link));
        }
        let of_joints =
            joints.iter().flat_map(|joint| ["x", "y"].map(|axis| format!("{}.{axis}", joint.name)));
        let names: Vec<String> = slides
            .iter()
            .map(|slide| slide.name.clone())
            .chain(links.iter().map(|link| link.name.clone()))
            .chain(of_joints)
            .collect();
        let hint = suggest(name, names.iter().map(String::as_str));
        Err(SolveError::Unknown { kind: Named::Coordinate, name: name.into(), hint })
    }
}

/// A value and the coordinate of the driver where it is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ValueAt {
    /// The value.
    pub value: f64,
    /// Where.
    pub q: f64,
}
