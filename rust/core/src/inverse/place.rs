//! Where everything is in a pose, and how far it is from there in another one.

use crate::assemblies::assembly::Assembly;
use crate::description::Linkage;
use crate::math::trig::sin_cos;
use crate::plan::redraw::Pose;

/// Where everything is: joints, angles of links, values of slides.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place<'p> {
    pub joints: &'p [[f64; 2]],
    pub angles: &'p [f64],
    pub slides: &'p [f64],
}

impl<'p> From<&'p Assembly> for Place<'p> {
    fn from(assembly: &'p Assembly) -> Self {
        let Assembly { joints, angles, slides, .. } = assembly;
        Self { joints, angles, slides }
    }
}

impl<'p> Place<'p> {
    /// The part of a pose that a linkage has: its own joints, links and slides come first.
    pub(super) fn in_part(assembly: &'p Assembly, linkage: &Linkage) -> Self {
        Self {
            joints: &assembly.joints[..linkage.joints.len()],
            angles: &assembly.angles[..linkage.links.len()],
            slides: &assembly.slides[..linkage.slides.len()],
        }
    }

    pub(super) fn pose(self) -> Pose {
        let [angles, slides] = [self.angles, self.slides].map(<[f64]>::to_vec);
        Pose { joints: self.joints.to_vec(), angles, slides }
    }

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
