//! Which quantities of a motion are returned, and the layout of their arrays.

use std::mem::MaybeUninit;

use crate::plan::mechanism::Mechanism;

/// Quantities to return: indices of joints, links and slides.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Outputs {
    /// Joints: their positions.
    pub joints: Vec<usize>,
    /// Links: their angles.
    pub links: Vec<usize>,
    /// Links: the positions of their reference points.
    pub origins: Vec<usize>,
    /// Slides: their values.
    pub slides: Vec<usize>,
}

impl Outputs {
    /// All joints, links' angles and slides of a mechanism.
    #[must_use]
    pub fn all(mechanism: &Mechanism) -> Self {
        let linkage = mechanism.linkage();
        Self {
            joints: (0..linkage.joints.len()).collect(),
            links: (0..linkage.links.len()).collect(),
            origins: Vec::new(),
            slides: (0..linkage.slides.len()).collect(),
        }
    }
}

/// Quantity in one array, with the index of its joint, link or slide.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Position of a joint, m.
    Joint(usize),
    /// Position of a link's reference point (its first joint), m.
    Origin(usize),
    /// Value of a slide, m.
    Slide(usize),
    /// Angle of a link, rad.
    Angle(usize),
}

/// One array: the derivatives of one order of a quantity. Its entries run over designs, positions,
/// components (2 for a point) and as many driver indices as the order, the last one fastest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Column {
    /// The quantity.
    pub quantity: Quantity,
    /// Order of the derivative; 0: the value.
    pub order: usize,
    /// Numbers per position.
    pub width: usize,
}

/// The arrays that a request fills, in order.
pub(crate) fn columns(outputs: &Outputs, drivers: usize, order: usize) -> Vec<Column> {
    let joints = outputs.joints.iter().map(|&i| (Quantity::Joint(i), 2));
    let origins = outputs.origins.iter().map(|&i| (Quantity::Origin(i), 2));
    let slides = outputs.slides.iter().map(|&i| (Quantity::Slide(i), 1));
    let angles = outputs.links.iter().map(|&i| (Quantity::Angle(i), 1));
    let all = joints.chain(origins).chain(slides).chain(angles);
    all.flat_map(|(quantity, components)| {
        (0..=order).map(move |order| {
            let entries = (0..order).fold(1, |n, _| n * drivers);
            Column { quantity, order, width: components * entries }
        })
    })
    .collect()
}

/// Arrays to fill, in the order of [`crate::Request::columns`]; see [`crate::fill`].
#[derive(Debug)]
pub struct Arrays<'a> {
    /// One array per column, of designs × positions × width numbers.
    pub columns: Vec<&'a mut [MaybeUninit<f64>]>,
    /// One [`crate::state::status::Status`] code per position.
    pub status: &'a mut [MaybeUninit<u8>],
}
