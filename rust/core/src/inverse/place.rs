//! The distance between two poses.

use crate::assemblies::assembly::Assembly;
use crate::math::trig::sin_cos;
use crate::plan::redraw::Pose;

/// Where everything is: joints, angles of links, values of slides.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place<'p> {
    joints: &'p [[f64; 2]],
    angles: &'p [f64],
    slides: &'p [f64],
}

impl<'p> From<&'p Pose> for Place<'p> {
    fn from(pose: &'p Pose) -> Self {
        Self { joints: &pose.joints, angles: &pose.angles, slides: &pose.slides }
    }
}

impl<'p> From<&'p Assembly> for Place<'p> {
    fn from(assembly: &'p Assembly) -> Self {
        let Assembly { joints, angles, slides, .. } = assembly;
        Self { joints, angles, slides }
    }
}

impl Place<'_> {
    /// The greatest difference of two places: of joints and slides in sizes, of links by their unit
    /// vectors. (Joints alone do not distinguish assemblies: a link of one joint may point either way.)
    pub(super) fn distance(self, other: Place<'_>, size: f64) -> f64 {
        let joints = self.joints.iter().flatten().zip(other.joints.iter().flatten());
        let lengths = joints.chain(self.slides.iter().zip(other.slides));
        let apart = lengths.map(|(a, b)| (a - b).abs() / size);
        let turned = self.angles.iter().zip(other.angles).map(|(&a, &b)| {
            let ((sin_a, cos_a), (sin_b, cos_b)) = (sin_cos(a), sin_cos(b));
            (sin_a - sin_b).abs().max((cos_a - cos_b).abs())
        });
        // Written so that NaN is far away.
        apart.chain(turned).fold(0.0, |most: f64, gap| if gap <= most { most } else { gap })
    }
}
