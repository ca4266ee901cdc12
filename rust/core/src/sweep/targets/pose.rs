//! How far a link passes from given poses.

use super::feet::{Foot, effort, feet};
use super::path_target::points_in_frame;
use std::f64::consts::{PI, TAU};

use crate::batch::request::Quantity;
use crate::math::angle::unwrap_to;
use crate::math::polyline::Polyline;
use crate::math::vector::Vector;
use crate::sweep::metric::{Metric, Need, Positions, Slopes};

/// The root mean square distance of given poses from the motion of a link's frame, over a length ℓ: of each pose
/// the least √(|Δp|²/ℓ² + Δφ²), p the frame's origin and φ its angle.
///
/// Between positions points and angles change in proportion, the angle the shorter way.
#[derive(Debug, Clone, PartialEq)]
pub struct PoseError {
    link: usize,
    /// x and y over the length, and the angle.
    poses: Vec<[f64; 3]>,
    length: f64,
}

impl PoseError {
    /// Of a link by its index; poses are x and y of its frame's origin and its angle, rad. A turn of 1 rad counts
    /// as much as a distance of `length`, by default the root mean square distance of their positions from their
    /// centroid.
    ///
    /// # Errors
    ///
    /// The reason why they are no target.
    pub fn new(link: usize, poses: &[[f64; 3]], length: Option<f64>) -> Result<Self, String> {
        let length = match length {
            Some(length) if length > 0.0 && length.is_finite() => length,
            Some(length) => return Err(format!("length is {length}: it must be more than 0")),
            None => {
                let points: Vec<[f64; 2]> = poses.iter().map(|&[x, y, _]| [x, y]).collect();
                let radius = points_in_frame(&points).map(|(frame, _)| frame.radius);
                radius.map_err(|reason| format!("{reason}; give length="))?
            }
        };
        let relative = poses.iter().map(|&[x, y, angle]| [x / length, y / length, angle % TAU]);
        let poses: Vec<[f64; 3]> = relative.collect();
        match poses.iter().position(|pose| pose.iter().any(|number| !number.is_finite())) {
            Some(at) => Err(format!("entry {at} is not finite")),
            None if poses.is_empty() => Err("it is empty".into()),
            None => Ok(Self { link, poses, length }),
        }
    }

    /// The motion of the frame as a polyline of x and y over the length and the angle, which is continuous.
    fn motion(&self, positions: &Positions<'_>) -> Vec<[f64; 3]> {
        let column =
            |index: usize| positions.values.get(index).copied().unwrap_or(&[]).as_chunks::<2>().0;
        let mut motion: Vec<[f64; 3]> = Vec::with_capacity(positions.count() + 1);
        for (&[x, y], &[cos, sin]) in column(0).iter().zip(column(1)) {
            let angle = Vector::new(cos, sin).angle();
            let angle = motion.last().map_or(angle, |last| unwrap_to(angle, last[2]));
            motion.push([x / self.length, y / self.length, angle]);
        }
        if let (&[[x, y, angle], .., last], true) = (&motion[..], positions.returns) {
            motion.push([x, y, unwrap_to(angle, last[2])]);
        }
        motion
    }

    /// The nearest place of the motion to each pose.
    fn feet(&self, motion: &[[f64; 3]], positions: &Positions<'_>) -> Vec<Foot<3>> {
        let line = Polyline::through(motion, false);
        let range = motion.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], pose| {
            [low.min(pose[2]), high.max(pose[2])]
        });
        // A pose is the same after any number of turns: the nearest is within half a turn of the motion.
        let mut points = Vec::new();
        let mut owners = Vec::new();
        for (owner, &[x, y, angle]) in self.poses.iter().enumerate() {
            let first = ((range[0] - PI - angle) / TAU).ceil();
            let mut turned = angle + TAU * first;
            loop {
                points.push([x, y, turned]);
                owners.push(owner);
                turned += TAU;
                if turned > range[1] + PI {
                    break;
                }
            }
        }
        let mut nearest: Vec<Option<Foot<3>>> = vec![None; self.poses.len()];
        for (owner, foot) in owners.into_iter().zip(feet(&line, &points, positions)) {
            if nearest[owner].is_none_or(|known| foot.square < known.square) {
                nearest[owner] = Some(foot);
            }
        }
        nearest.into_iter().flatten().collect()
    }

    fn root_mean_square(&self, feet: &[Foot<3>]) -> f64 {
        let sum: f64 = feet.iter().map(|foot| foot.square).sum();
        (sum / self.poses.len() as f64).sqrt()
    }
}

impl Metric for PoseError {
    fn needs(&self) -> Vec<Need> {
        [Quantity::Origin(self.link), Quantity::Direction(self.link)]
            .map(|quantity| Need { quantity, order: 0 })
            .to_vec()
    }

    fn of(&self, positions: &Positions<'_>) -> f64 {
        let motion = self.motion(positions);
        if motion.is_empty() {
            return f64::NAN;
        }
        self.root_mean_square(&self.feet(&motion, positions))
    }

    fn asks_return(&self) -> bool {
        true
    }

    fn effort(&self) -> usize {
        effort(self.poses.len())
    }

    fn with_slopes(&self) -> Option<&dyn Slopes> {
        Some(self)
    }
}

impl Slopes for PoseError {
    fn slopes(&self, positions: &Positions<'_>) -> Vec<Vec<f64>> {
        let motion = self.motion(positions);
        let feet = self.feet(&motion, positions);
        let count = positions.count();
        let mut by_points = vec![0.0; 2 * count];
        let mut by_angles = vec![0.0; count];
        // d√m = dm / 2√m: of 0 none.
        let scale = 1.0 / (self.poses.len() as f64 * self.root_mean_square(&feet));
        for foot in feet {
            let [x, y, angle] = foot.off.map(|off| off * scale);
            let parts = [(0, 1.0 - foot.place.part), (1, foot.place.part)];
            for (next, part) in parts {
                // After the last position comes the first again.
                let at = (foot.place.segment + next) % count;
                by_points[2 * at] += part * x / self.length;
                by_points[2 * at + 1] += part * y / self.length;
                by_angles[at] += part * angle;
            }
        }
        vec![by_points, by_angles]
    }
}
