//! The description of a mechanism: joints, links, slides, drivers. No numerics.
//!
//! [`Description`] is what the user writes. [`Linkage`] is the same, validated
//! and with names resolved to indices. The drawing's coordinates set the
//! dimensions and the assembly.

pub(crate) mod class_iv;
pub(crate) mod dimension;
pub(crate) mod error;
mod error_names;
pub(crate) mod four_bar;
pub(crate) mod frame;
pub(crate) mod names;
pub(crate) mod slider_crank;
pub(crate) mod validate;

/// A point where links turn about each other.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// Its coordinates in the drawing, m.
    pub at: [f64; 2],
}

/// A rigid body with any number of joints.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Link {
    /// Its name; `ground` is the frame.
    pub name: String,
    /// Its joints (indices), in the user's order.
    pub joints: Vec<usize>,
}

/// A sliding pair: `link` slides along a guide that is fixed to `on`.
#[derive(Debug, Clone, PartialEq)]
pub struct Slide {
    /// Its name.
    pub name: String,
    /// The sliding link.
    pub link: usize,
    /// The link that carries the guide.
    pub on: usize,
    /// The guide's direction in the drawing, rad.
    pub angle: f64,
    /// The joint of `on` from which the value is measured.
    pub origin: Option<usize>,
    /// Whether the value is a length, which is never negative.
    pub length: bool,
}

/// A driven coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Driver {
    /// Angle of `link` minus angle of `relative_to`, rad.
    Angle {
        /// The driven link.
        link: usize,
        /// The link from which its angle is measured (usually the ground).
        relative_to: usize,
    },
    /// Value of a slide, m.
    Slide(usize),
}

/// A slide as a user writes it.
#[derive(Debug, Clone, PartialEq)]
pub struct SlideDescription {
    /// Its name.
    pub name: String,
    /// The sliding link.
    pub link: String,
    /// The link that carries the guide.
    pub on: String,
    /// The guide's direction in the drawing, rad.
    pub angle: f64,
    /// The joint of `on` from which the value is measured; `None`: from where the drawing
    /// shows the sliding point.
    pub origin: Option<String>,
    /// Whether the value is a length, which is never negative: that of a cylinder is the distance of
    /// its joints.
    pub length: bool,
}

/// A driver as a user writes it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum DriverDescription {
    /// A link (its angle) or a slide (its value).
    Named(String),
    /// The angle of a link measured from another link.
    Relative {
        /// The driven link.
        link: String,
        /// The other link.
        relative_to: String,
    },
}

/// A mechanism as a user writes it, names not yet resolved.
///
/// # Examples
///
/// ```
/// use assur::{Description, Mechanism};
///
/// let crank_rocker = Description::new()
///     .joint("A", [0.0, 0.0])
///     .joint("B", [1.0, 0.0])
///     .joint("C", [4.1, 3.2])
///     .joint("D", [4.8, 0.0])
///     .link("ground", ["A", "D"])
///     .link("crank", ["A", "B"])
///     .link("coupler", ["B", "C"])
///     .link("rocker", ["D", "C"])
///     .driver("crank");
/// let mechanism = Mechanism::new(&crank_rocker)?;
/// assert_eq!(mechanism.structure().formula(), "I(crank) → II(coupler, rocker)");
/// # Ok::<(), assur::StructureError>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Description {
    /// Joints and their coordinates in the drawing, m.
    pub joints: Vec<(String, [f64; 2])>,
    /// Links and the names of their joints.
    pub links: Vec<(String, Vec<String>)>,
    /// Sliding pairs.
    pub slides: Vec<SlideDescription>,
    /// Driven coordinates, in the order of `q`.
    pub drivers: Vec<DriverDescription>,
    /// Signs of dyads that the drawing shows flat, or that are to be assembled
    /// differently from the drawing; keyed by the dyad's inner joint or slide.
    pub assembly: Vec<(String, i64)>,
}

impl Description {
    /// An empty description.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a joint with its coordinates in the drawing, m.
    #[must_use]
    pub fn joint(mut self, name: &str, at: [f64; 2]) -> Self {
        self.joints.push((name.into(), at));
        self
    }

    /// Adds a link with its joints.
    #[must_use]
    pub fn link<'a>(mut self, name: &str, joints: impl IntoIterator<Item = &'a str>) -> Self {
        self.links.push((name.into(), joints.into_iter().map(Into::into).collect()));
        self
    }

    /// Adds a slide: `link` slides on `on` along `angle` (rad, in the drawing).
    #[must_use]
    pub fn slide(
        mut self,
        name: &str,
        link: &str,
        on: &str,
        angle: f64,
        origin: Option<&str>,
    ) -> Self {
        self.slides.push(SlideDescription {
            name: name.into(),
            link: link.into(),
            on: on.into(),
            angle,
            origin: origin.map(Into::into),
            length: false,
        });
        self
    }

    /// Adds a driver: a link (its angle) or a slide (its value).
    #[must_use]
    pub fn driver(mut self, name: &str) -> Self {
        self.drivers.push(DriverDescription::Named(name.into()));
        self
    }

    /// Adds a driver: the angle of a link measured from another link.
    #[must_use]
    pub fn drive(mut self, link: &str, relative_to: &str) -> Self {
        self.drivers.push(DriverDescription::Relative {
            link: link.into(),
            relative_to: relative_to.into(),
        });
        self
    }

    /// Sets the sign (+1 or −1) of the dyad with this inner joint or slide.
    #[must_use]
    pub fn assembly(mut self, name: &str, sign: i64) -> Self {
        self.assembly.push((name.into(), sign));
        self
    }
}

/// A validated description: names resolved to indices.
#[derive(Debug, Clone, PartialEq)]
pub struct Linkage {
    /// Joints in the user's order.
    pub joints: Vec<Joint>,
    /// Links in the user's order, including the ground.
    pub links: Vec<Link>,
    /// Slides in the user's order.
    pub slides: Vec<Slide>,
    /// Drivers in the order of `q`.
    pub drivers: Vec<Driver>,
    /// Index of the link `ground`.
    pub ground: usize,
    /// Signs given by the user, by inner joint or slide.
    pub assembly: Vec<(String, i8)>,
    /// For every joint its links, in order.
    pub(crate) links_of_joints: Vec<Vec<usize>>,
}

impl Linkage {
    /// Larger side of the drawing's bounding box, m: the scale for comparing lengths.
    #[must_use]
    pub fn size(&self) -> f64 {
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for joint in &self.joints {
            for axis in 0..2 {
                low[axis] = low[axis].min(joint.at[axis]);
                high[axis] = high[axis].max(joint.at[axis]);
            }
        }
        let size = (high[0] - low[0]).max(high[1] - low[1]);
        if size > 0.0 && size.is_finite() { size } else { 1.0 }
    }

    /// Name of a driver as used in messages and formulas.
    #[must_use]
    pub fn driver_name(&self, driver: Driver) -> String {
        match driver {
            Driver::Slide(slide) => self.slides[slide].name.clone(),
            Driver::Angle { link, relative_to } if relative_to == self.ground => {
                self.links[link].name.clone()
            }
            Driver::Angle { link, relative_to } => {
                format!("{}/{}", self.links[link].name, self.links[relative_to].name)
            }
        }
    }

    /// The links, including the ground, that have this joint.
    pub fn links_at(&self, joint: usize) -> impl Iterator<Item = usize> + '_ {
        self.links_of_joints[joint].iter().copied()
    }

    /// Whether a link is a piston or a block: it slides, and has one joint.
    #[must_use]
    pub fn is_block(&self, link: usize) -> bool {
        let slides = self.slides.iter().any(|slide| [slide.link, slide.on].contains(&link));
        slides && link != self.ground && self.links[link].joints.len() == 1
    }

    /// The only block that has this joint. `None` for a fixed joint: what is fastened there is fastened to the
    /// ground.
    #[must_use]
    pub fn block_at(&self, joint: usize) -> Option<usize> {
        if self.links_at(joint).any(|link| link == self.ground) {
            return None;
        }
        let mut blocks = self.links_at(joint).filter(|&link| self.is_block(link));
        blocks.next().filter(|_| blocks.next().is_none())
    }

    /// The link that takes a load at a joint, unless the load names another: the only block that has the
    /// joint, or else the first link.
    #[must_use]
    pub fn loaded_link(&self, joint: usize) -> usize {
        let first = || self.links_at(joint).next();
        self.block_at(joint).or_else(first).unwrap_or(self.ground)
    }
}
