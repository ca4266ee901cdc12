//! Changes of a drawing: their limits, their weights and their effect.

use nalgebra::DVector;

use crate::description::Linkage;
use crate::math::tolerance::REDUNDANT_CLOSURE;

/// Target for a change that exceeded the tolerance, as a share of the tolerance.
const STIFFER: f64 = 0.7;

/// Allowed distance of a drawing from the intended one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Tolerance {
    /// Greatest change of a joint's coordinate, m.
    pub length: f64,
    /// Greatest turn of a guide, rad.
    pub angle: f64,
}

impl Tolerance {
    /// The rounding of a drawing that is typed with nine digits.
    pub(super) fn of_rounding(size: f64) -> Self {
        Self { length: REDUNDANT_CLOSURE * size, angle: REDUNDANT_CLOSURE }
    }

    pub(super) fn scaled(self, factor: f64) -> Self {
        Self { length: factor * self.length, angle: factor * self.angle }
    }

    /// Whether a change is within it.
    pub(super) fn allows(self, change: Change) -> bool {
        change.length <= self.length && change.angle <= self.angle
    }
}

/// Greatest changes between two drawings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Change {
    /// Change of a joint's coordinate, m.
    pub length: f64,
    /// Change of a guide's direction, rad.
    pub angle: f64,
}

impl Change {
    pub(super) fn between(before: &Linkage, after: &Linkage) -> Self {
        let joints = before.joints.iter().zip(&after.joints);
        let slides = before.slides.iter().zip(&after.slides);
        let lengths = joints.flat_map(|(a, b)| [0, 1].map(|k| (a.at[k] - b.at[k]).abs()));
        let angles = slides.map(|(a, b)| (a.angle - b.angle).abs());
        Self { length: lengths.fold(0.0, f64::max), angle: angles.fold(0.0, f64::max) }
    }
}

/// Weight of each coordinate of a joint, then of each guide: greater ones change more.
pub(super) struct Weights(pub(super) DVector<f64>);

impl Weights {
    pub(super) fn of(linkage: &Linkage, allowed: Tolerance, size: f64) -> Self {
        let coordinates = 2 * linkage.joints.len();
        let of_guides = allowed.angle * size / allowed.length;
        Self(DVector::from_fn(coordinates + linkage.slides.len(), |i, _| {
            if i < coordinates { 1.0 } else { of_guides }
        }))
    }

    /// Lowers the weights of coordinates that changed too much: the smallest change of all together may
    /// be large in one of them.
    pub(super) fn stiffen(&mut self, linkage: &Linkage, changed: &Linkage, allowed: Tolerance) {
        let joints = linkage.joints.iter().zip(&changed.joints);
        let lengths = joints.flat_map(|(a, b)| [0, 1].map(|k| (a.at[k] - b.at[k]).abs()));
        let slides = linkage.slides.iter().zip(&changed.slides);
        let angles = slides.map(|(a, b)| (a.angle - b.angle).abs() / allowed.angle);
        let changes = lengths.map(|length| length / allowed.length).chain(angles);
        for (weight, change) in self.0.iter_mut().zip(changes) {
            if change > 1.0 {
                *weight *= STIFFER / change;
            }
        }
    }
}

/// The drawing after a change of the coordinates of its joints (relative to the size) and of the
/// angles of its guides.
pub(super) fn changed(linkage: &Linkage, change: &DVector<f64>, size: f64) -> Linkage {
    let mut next = linkage.clone();
    for (j, joint) in next.joints.iter_mut().enumerate() {
        for (k, at) in joint.at.iter_mut().enumerate() {
            *at += size * change[2 * j + k];
        }
    }
    for (s, slide) in next.slides.iter_mut().enumerate() {
        slide.angle += change[2 * linkage.joints.len() + s];
    }
    next
}
