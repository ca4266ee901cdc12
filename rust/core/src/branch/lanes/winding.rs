//! The direction of a dyad's chord at the end of a straight path, with its whole turns.
//!
//! Along the path the chord changes by at most the sum of its arms times their rates. So a step shorter
//! than the chord cannot turn it by half a turn, and one shorter than the distance from the lengths at
//! which the dyad is flat cannot leave a gap or enter one. Across a gap the direction takes the shorter
//! way, as a traced angle does: both ends of a gap are flat.

use std::f64::consts::{PI, TAU};

use super::super::driven_chord::{ChordPath, MAX_ARMS};
use crate::math::angle::{turns_between, unwrap_to};
use crate::math::lanes::{Mask, Real};
use crate::math::vector::Vector;

/// Longest step, as a part of the chord: it turns by less than 65°.
const MAX_PART: f64 = 0.9;
/// Steps where the dyad may be flat, as parts of the chord. Paths whose turns remain ambiguous begin again
/// with the next.
const PARTS: [f64; 3] = [1.0 / 64.0, 1.0 / 4096.0, 1.0 / 1_048_576.0];
/// Upper bound of the arc sine of such a part, divided by it.
const ARC: f64 = 1.0625;
/// Steps, at most, along one path: more than the longest path takes, unless a chord nearly vanishes all the
/// time.
const MAX_STEPS: u32 = 32_768;
/// Distance (rad) from half a turn that directions on one stretch keep.
const SAFE: f64 = 0.0625;
/// Most that directions may differ (rad) at one end of a gap.
const MOST_AT_EDGE: f64 = 1.0;

/// A path on its way, one in each lane.
struct Walk<R: Real> {
    /// Direction of the chord, unwrapped; in a gap, that before it.
    angle: R,
    /// Whether the dyad may be flat since the last position where it certainly is not.
    in_doubt: R::Mask,
    /// Whether it certainly was open since then, and whether it may be closed again.
    was_open: R::Mask,
    is_behind: R::Mask,
    /// The least and the greatest direction where the dyad may be closed, before that and behind it.
    before: [R; 2],
    behind: [R; 2],
    failed: R::Mask,
}

impl ChordPath {
    /// The direction at the end of the path along which the arms turn by `turned`, and the lanes in which
    /// it must be found otherwise. The dyad is closed at both ends, or the lane is `skipped`. `is_only`: no
    /// other dyad has gaps, across which the shorter way would count too.
    #[inline(always)]
    pub(crate) fn end_angle<R: Real>(
        &self,
        turned: &[R; MAX_ARMS],
        skipped: R::Mask,
        is_only: bool,
    ) -> (R, R::Mask) {
        let mut speed = R::ZERO;
        for (turned, (arm, _)) in turned.iter().zip(&self.arms) {
            speed += R::splat(arm.norm()) * turned.abs();
        }
        let (mut angle, mut missing) = (R::ZERO, skipped.not());
        for part in PARTS {
            if missing.any() {
                let (end, failed) = self.walk(turned, speed, missing, (part, is_only));
                angle = R::select(missing, end, angle);
                missing = missing.and(failed);
            }
        }
        (angle, missing)
    }

    /// Goes along the paths of the lanes `asked`; also returns those in which the turns are ambiguous.
    #[inline(always)]
    fn walk<R: Real>(
        &self,
        turned: &[R; MAX_ARMS],
        speed: R,
        asked: R::Mask,
        (part, is_only): (f64, bool),
    ) -> (R, R::Mask) {
        let mut walk = Walk::new(self.start_angle);
        let (shortest, longest) = (R::splat(self.flat[0]), R::splat(self.flat[1]));
        let (mut done, mut chord) = (R::ZERO, Vector::<R>::splat(self.start));
        let per_speed = R::ONE / speed;
        let mut active = asked;
        for _ in 0..MAX_STEPS {
            let length = chord.norm();
            let room = (length - shortest).min(longest - length);
            let least = R::splat(part) * length;
            let is_end = R::ONE.le(done);
            let is_closed = is_end.or(least.le(room));
            let is_open = is_closed.not().and(least.le(-room));
            let unwrapped = unwrap_to(chord.angle(), walk.angle);
            walk.angle = R::select(active.and(is_open.not()), unwrapped, walk.angle);
            walk.leave_doubt(active.and(is_closed), is_only);
            walk.doubt(active.and(is_closed.or(is_open).not()), R::splat(ARC * part));
            walk.open(active.and(is_open));
            active = active.and(is_end.or(walk.failed).not());
            if !active.any() {
                return (walk.angle, walk.failed);
            }
            let within = R::select(is_open, -room, room.min(R::splat(MAX_PART) * length));
            let step = R::select(is_open.or(least.le(room)), within, least);
            let next = (done + step * per_speed).min(R::ONE);
            // The chord vanishes, or nothing moves.
            walk.failed = walk.failed.or(active.and(done.lt(next).not()));
            active = active.and(walk.failed.not());
            done = R::select(active, next, done);
            chord = Vector::splat(self.fixed);
            for (&turned, (arm, _)) in turned.iter().zip(&self.arms) {
                chord += Vector::at_angle(turned * done).turn(*arm);
            }
        }
        (walk.angle, walk.failed.or(active))
    }
}

impl<R: Real> Walk<R> {
    #[inline(always)]
    fn new(angle: f64) -> Self {
        Self {
            angle: R::splat(angle),
            in_doubt: R::Mask::NONE,
            was_open: R::Mask::NONE,
            is_behind: R::Mask::NONE,
            before: nothing(),
            behind: nothing(),
            failed: R::Mask::NONE,
        }
    }

    /// In these lanes the dyad may be flat on the next step, on which the direction changes by less than
    /// `arc`.
    #[inline(always)]
    fn doubt(&mut self, lanes: R::Mask, arc: R) {
        self.in_doubt = self.in_doubt.or(lanes);
        self.is_behind = self.is_behind.or(lanes.and(self.was_open));
        self.widen(lanes, arc);
    }

    /// In these lanes it certainly is open on the next step.
    #[inline(always)]
    fn open(&mut self, lanes: R::Mask) {
        // Whether it was closed between two gaps must be known.
        let is_unclear = self.is_behind.or(self.in_doubt.not());
        self.failed = self.failed.or(lanes.and(is_unclear));
        self.was_open = self.was_open.or(lanes);
    }

    /// In these lanes it certainly is closed.
    #[inline(always)]
    fn leave_doubt(&mut self, lanes: R::Mask, is_only: bool) {
        let leaving = lanes.and(self.in_doubt);
        if !leaving.any() {
            return;
        }
        self.widen(leaving, R::ZERO);
        let ([a, b], [c, d]) = (self.before, self.behind);
        // No closures: an intrinsic in one might be called.
        let (first, last) = (turns_between(c - b, R::ZERO), turns_between(d - a, R::ZERO));
        let is_narrow = (b - a).max(d - c).lt(R::splat(MOST_AT_EDGE));
        let is_known = is_narrow.and(first.le(last)).and(last.le(first));
        let stays_near = (b - a).lt(R::splat(PI - SAFE));
        let crossed = leaving.and(self.was_open);
        let clear = self.was_open.and(is_known).or(self.was_open.not().and(stays_near));
        let clear = if is_only { clear } else { R::Mask::NONE };
        self.failed = self.failed.or(leaving.and(clear.not()));
        let shorter = self.angle + R::splat(TAU) * first;
        self.angle = R::select(crossed, shorter, self.angle);
        let stays = leaving.not();
        self.in_doubt = self.in_doubt.and(stays);
        self.was_open = self.was_open.and(stays);
        self.is_behind = self.is_behind.and(stays);
        forget(&mut self.before, leaving);
        forget(&mut self.behind, leaving);
    }

    /// Adds the present direction, to within `arc`, to those where the dyad may be closed.
    #[inline(always)]
    fn widen(&mut self, lanes: R::Mask, arc: R) {
        let (low, high) = (self.angle - arc, self.angle + arc);
        widen(&mut self.before, lanes.and(self.was_open.not()), low, high);
        widen(&mut self.behind, lanes.and(self.was_open), low, high);
    }
}

/// Widens ranges to contain others, in some lanes.
#[inline(always)]
fn widen<R: Real>(range: &mut [R; 2], lanes: R::Mask, low: R, high: R) {
    range[0] = R::select(lanes, range[0].min(low), range[0]);
    range[1] = R::select(lanes, range[1].max(high), range[1]);
}

/// Empties ranges, in some lanes.
#[inline(always)]
fn forget<R: Real>(range: &mut [R; 2], lanes: R::Mask) {
    let [least, greatest] = nothing();
    range[0] = R::select(lanes, least, range[0]);
    range[1] = R::select(lanes, greatest, range[1]);
}

/// The least and the greatest of no numbers.
#[inline(always)]
fn nothing<R: Real>() -> [R; 2] {
    [R::splat(f64::INFINITY), R::splat(f64::NEG_INFINITY)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_4;

    /// Samples of a path, dense enough that a chord turns little from one to the next.
    const SAMPLES: u32 = 20_000;

    /// A number from −1 to 1.
    fn random(seed: &mut u64) -> f64 {
        *seed =
            seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// A chord of two arms, and their turns.
    fn random_path(seed: &mut u64) -> (ChordPath, [f64; MAX_ARMS]) {
        let mut vector = |size: f64| Vector::new(random(seed), random(seed)).scale(size);
        let (fixed, arms) = (vector(2.0), [(vector(1.0), 0), (vector(1.0), 1)]);
        let start = fixed + arms[0].0 + arms[1].0;
        let [a, b] = [random(seed).abs() * 2.0, random(seed).abs() * 2.0];
        // Often legs of one length.
        let b = if random(seed) < -0.5 { a } else { b };
        let mut turned = [0.0; MAX_ARMS];
        turned[..2].copy_from_slice(&[9.0 * random(seed), 9.0 * random(seed)]);
        let (flat, legs) = ([(a - b).abs(), a + b], [(1, 0.0), (2, 0.0)]);
        let arms = arms.to_vec();
        (ChordPath { fixed, arms, start, start_angle: start.angle(), flat, legs }, turned)
    }

    /// The direction at the end by dense samples, if both ends are closed and no step is ambiguous.
    fn sampled(path: &ChordPath, turned: &[f64; MAX_ARMS]) -> Option<f64> {
        let (mut angle, mut was_closed) = (path.start_angle, true);
        for sample in 0..=SAMPLES {
            let done = f64::from(sample) / f64::from(SAMPLES);
            let chord =
                path.arms.iter().zip(turned).fold(path.fixed, |sum, (&(arm, _), turned)| {
                    sum + Vector::at_angle(turned * done) * arm
                });
            let is_closed = path.flat[0] < chord.norm() && chord.norm() < path.flat[1];
            if is_closed {
                let step = unwrap_to(chord.angle(), angle) - angle;
                let most = if was_closed { FRAC_PI_4 } else { PI - 0.05 };
                if step.abs() > most {
                    return None;
                }
                angle += step;
            }
            was_closed = is_closed;
            if !is_closed && (sample == 0 || sample == SAMPLES) {
                return None;
            }
        }
        Some(angle)
    }

    #[test]
    fn directions_of_dense_samples() {
        let (mut seed, mut compared, mut missed, mut turns) = (1, 0, 0, 0);
        while compared < 1000 {
            let (path, turned) = random_path(&mut seed);
            let Some(expected) = sampled(&path, &turned) else { continue };
            let (angle, missing) = path.end_angle(&turned, false, true);
            compared += 1;
            if missing {
                missed += 1;
            } else {
                assert!((angle - expected).abs() < 1e-9, "{path:?} {turned:?}: {angle} {expected}");
            }
            turns += u32::from((expected - path.start_angle).abs() > PI);
        }
        assert!(missed < 3 && turns > 100, "{missed} {turns}");
    }

    /// With another dyad, only a path that certainly has no gap counts.
    #[test]
    fn gaps_beside_another_dyad_are_left_to_the_tracer() {
        let (fixed, start) = (Vector::new(2.0, 0.0), Vector::new(3.0, 0.0));
        let arms = vec![(Vector::new(1.0, 0.0), 0)];
        let mut path = ChordPath {
            fixed,
            arms,
            start,
            start_angle: 0.0,
            flat: [0.0, 4.0],
            legs: [(1, 0.0), (2, 0.0)],
        };
        let mut turned = [0.0; MAX_ARMS];
        turned[0] = 2.0 * TAU;
        assert!(!path.end_angle(&turned, false, false).1);
        path.flat[0] = 1.5;
        assert!(path.end_angle(&turned, false, false).1);
        assert!(!path.end_angle(&turned, false, true).1);
    }
}
