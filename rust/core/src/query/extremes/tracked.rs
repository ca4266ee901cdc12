//! The coordinates that can have extremes, and the extremes.

use crate::description::error::SolveError;
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
        if self.linkage().joints.iter().any(|joint| joint.name == name) {
            return Err(no_axis(name));
        }
        let slide = self.linkage().slides.iter().position(|slide| slide.name == name);
        slide.map_or_else(|| self.link(name).map(Tracked::Link), |slide| Ok(Tracked::Slide(slide)))
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
