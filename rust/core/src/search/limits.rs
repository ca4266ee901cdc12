//! What a linkage must keep over its whole turn, and penalties for what comes near the limits.

use super::normal::Normal;
use crate::math::vector::Vector;
use crate::population::adjoint::add_gradient_at;
use crate::population::course::{Angles, Course, apex_cosine};
use crate::population::packed::{PackedLinkage, Placement};

/// Weight of the square by which an apex cosine exceeds its limit.
const APEX_BARRIER: f64 = 600.0;
/// Weight of the square by which a joint is outside the frame.
const FRAME_BARRIER: f64 = 0.01;

/// What a linkage must keep over its whole turn. Barriers begin within the limits.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Limits {
    /// Greatest absolute cosine of the angle between the bars of a dyad.
    pub apex_cosine: f64,
    /// Where its barrier begins.
    pub apex_barrier: f64,
    /// Greatest distance of a joint from the target's centroid.
    pub frame: f64,
    /// Where its barrier begins.
    pub frame_barrier: f64,
    /// Least and greatest arc of an open target, rad.
    pub arc: [f64; 2],
}

impl Limits {
    /// The penalties of limits that are nearly reached; infinite where the frame is left.
    pub(super) fn barriers(&self, linkage: &PackedLinkage, course: &Course) -> f64 {
        let mut sum = 0.0;
        for joint in 0..linkage.len() {
            let distance = course.reach(joint).sqrt();
            if distance > self.frame {
                return f64::INFINITY;
            }
            let excess = (distance - self.frame_barrier).max(0.0);
            sum += FRAME_BARRIER * excess * excess;
            if let Placement::Dyad { .. } = linkage.placements[joint] {
                for square in course.chord(joint) {
                    let cosine = apex_cosine(linkage.numbers[joint], square).abs();
                    let excess = (cosine - self.apex_barrier).max(0.0);
                    sum += APEX_BARRIER * excess * excess;
                }
            }
        }
        sum
    }

    /// Adds the derivatives of the penalties.
    pub(super) fn add_barriers(
        &self,
        linkage: &PackedLinkage,
        (angles, course): (&Angles, &Course),
        normal: &mut Normal,
    ) {
        let mut add = |position: usize,
                       seeds: &[(usize, Vector)],
                       own: Option<(usize, [f64; 2])>,
                       (weight, excess): (f64, f64)| {
            let mut v = vec![0.0; normal.count];
            add_gradient_at(linkage, angles, course, position, seeds, &mut v);
            if let Some((joint, by_lengths)) = own {
                v[2 * joint] += by_lengths[0];
                v[2 * joint + 1] += by_lengths[1];
            }
            normal.add(&v, 2.0 * weight, 2.0 * weight * excess);
        };
        for joint in 0..linkage.len() {
            let square = course.reach(joint);
            let distance = square.sqrt();
            let excess = distance - self.frame_barrier;
            if excess > 0.0 {
                let position = course.reach_position(joint, square);
                let outward = course.point(joint, position).scale(1.0 / distance);
                add(position, &[(joint, outward)], None, (FRAME_BARRIER, excess));
            }
            let Placement::Dyad { ends, .. } = linkage.placements[joint] else { continue };
            let [a, b] = linkage.numbers[joint];
            for square in course.chord(joint) {
                let cosine = apex_cosine([a, b], square);
                let excess = cosine.abs() - self.apex_barrier;
                if excess <= 0.0 {
                    continue;
                }
                let sign = cosine.signum();
                let position = course.chord_position(ends, square);
                let chord = course.point(ends[1], position) - course.point(ends[0], position);
                // cos = (a² + b² − l²) / 2ab
                let by_chord = chord.scale(-sign / (a * b));
                let seeds = [(ends[1], by_chord), (ends[0], -by_chord)];
                let by_lengths = [sign * (1.0 / b - cosine / a), sign * (1.0 / a - cosine / b)];
                add(position, &seeds, Some((joint, by_lengths)), (APEX_BARRIER, excess));
            }
        }
    }
}
