//! Places a design where its curve is most alike a target: similarities of whole mechanisms.

use std::f64::consts::TAU;

use super::course::Course;
use super::problem::{Problem, TRAVEL_POSITIONS};
use super::target::{FitTarget, Freedom, Timing};
use crate::description::Driver;
use crate::description::dimension::Dimension;
use crate::math::simd::Simd;
use crate::math::vector::Vector;
use crate::plan::mechanism::Mechanism;
use crate::search::retrieve::{Curve, Match, Retrieval};
use crate::search::target::Target;

/// Phases that are tried of a target with timing.
const PHASES: usize = 32;
/// Least arc of the driver on which an open path is sought, rad.
const LEAST_ARC: f64 = 0.5;
/// The greatest arc, rad.
const MOST_ARC: f64 = 6.2;
/// A similarity that turns and scales, to see whether the variables of a fit can follow.
const TRIAL: Placing =
    Placing { by: Vector::new(0.6, 0.9), shift: Vector::new(0.3, -0.2), is_mirrored: false };

/// A similarity of the plane: mirrored in the x axis first, then turned and scaled, then shifted.
#[derive(Debug, Clone, Copy)]
pub(super) struct Placing {
    pub by: Vector,
    pub shift: Vector,
    pub is_mirrored: bool,
}

/// A similarity that takes a curve to a target, and the driver's coordinates at its points.
pub(super) struct Placed {
    /// What is done to the mechanism.
    pub inner: Placing,
    /// What the target's own freedom does after that, as its numbers.
    pub outer: Vec<f64>,
    pub q: Vec<f64>,
}

impl Placing {
    /// Itself in two parts: what a mechanism does, then what a target's freedom does.
    fn split(self, freedom: Freedom) -> Option<(Self, Vec<f64>)> {
        let Self { by, shift, is_mirrored } = self;
        let alone = |by| Self { by, shift: Vector::ZERO, is_mirrored };
        match freedom {
            Freedom::None => Some((self, vec![])),
            Freedom::Place => {
                let size = Vector::ONE.scale(by.norm());
                Some((alone(size), vec![by.angle(), shift.x, shift.y]))
            }
            Freedom::Similarity => Some((alone(Vector::ONE), vec![by.x, by.y, shift.x, shift.y])),
            Freedom::Turned => Some((self, vec![0.0])),
            Freedom::Line { .. } => None,
        }
    }

    /// The dimensions of a mechanism that is moved as a whole; `None` if a point of the frame is not among them.
    pub(super) fn dimensions(&self, problem: &Problem, dimensions: &[f64]) -> Option<Vec<f64>> {
        let linkage = problem.mechanism.linkage();
        let kinds: Vec<Dimension> =
            problem.mechanism.dimensions().iter().map(|(_, kind)| kind).collect();
        let side = if self.is_mirrored { -1.0 } else { 1.0 };
        let size = self.by.norm();
        let mut moved = vec![0.0; dimensions.len()];
        for (index, &kind) in kinds.iter().enumerate() {
            let value = dimensions[index];
            moved[index] = match kind {
                Dimension::GroundX { joint } => {
                    let y = kinds.iter().position(|&kind| kind == Dimension::GroundY { joint })?;
                    self.point(Vector::new(value, dimensions[y])).x
                }
                Dimension::GroundY { joint } => {
                    let x = kinds.iter().position(|&kind| kind == Dimension::GroundX { joint })?;
                    self.point(Vector::new(dimensions[x], value)).y
                }
                Dimension::SlideAngle { slide } if linkage.slides[slide].on == linkage.ground => {
                    side * value + self.by.angle()
                }
                Dimension::SlideAngle { .. } | Dimension::SlideLinkAngle { .. } => side * value,
                Dimension::SlideOriginX { slide } | Dimension::SlideOriginY { slide }
                    if linkage.slides[slide].on == linkage.ground =>
                {
                    return None;
                }
                Dimension::Length { .. }
                | Dimension::JointX { .. }
                | Dimension::SlideOriginX { .. } => size * value,
                Dimension::JointY { .. }
                | Dimension::SlideOffset { .. }
                | Dimension::SlideOriginY { .. } => side * size * value,
            };
        }
        Some(moved)
    }

    /// What the numbers of a place do to a mechanism.
    pub(super) fn of_place(numbers: &[f64]) -> Option<Self> {
        let &[angle, x, y] = numbers else { return None };
        Some(Self { by: Vector::at_angle(angle), shift: Vector::new(x, y), is_mirrored: false })
    }

    fn point(&self, point: Vector) -> Vector {
        self.by * if self.is_mirrored { point.conj() } else { point } + self.shift
    }

    /// The coordinate of a driver that is an angle from the frame.
    pub(super) fn coordinate(&self, q: f64) -> f64 {
        self.by.angle() + if self.is_mirrored { -q } else { q }
    }
}

/// Finds where curves are most alike the first target of a problem that is a path.
pub(super) struct Placer {
    freedom: Freedom,
    when: When,
}

enum When {
    /// Any coordinates of the driver serve: the path, and the parts of its length at its points.
    Free(Box<Target>, Vec<f64>),
    /// These do, with a phase or without.
    Timed { points: Vec<Vector>, q: Vec<f64>, has_phase: bool },
}

impl Placer {
    /// `None` if there is no path, or if the variables cannot move the whole mechanism.
    pub(super) fn new(problem: &Problem) -> Option<Self> {
        let [target] = problem.targets.as_slice() else { return None };
        if !drives_from_the_frame(problem.mechanism) {
            return None;
        }
        let (inner, _) = TRIAL.split(target.freedom)?;
        let unit: Vec<f64> = vec![1.0; problem.variables.len()];
        let moved = inner.dimensions(problem, &problem.variables.dimensions(&unit))?;
        problem.variables.values(&moved)?;
        let points = target.points()?;
        let when = match &target.timing {
            Timing::Free { is_closed, .. } => When::Free(
                Box::new(Target::new(&points, *is_closed)?),
                fractions(&points, *is_closed),
            ),
            Timing::Fixed(q) | Timing::Phase(q) => When::Timed {
                points: points.iter().map(|&[x, y]| Vector::new(x, y)).collect(),
                q: q.clone(),
                has_phase: matches!(target.timing, Timing::Phase(_)),
            },
        };
        Some(Self { freedom: target.freedom, when })
    }

    /// Similarities that take a curve, at the positions of a turn, to the target: the best of each way along it.
    pub(super) fn place(&self, course: &Course, simd: Simd) -> Vec<Placed> {
        match &self.when {
            When::Free(target, fractions) => self.place_free(target, fractions, course, simd),
            When::Timed { .. } if !course.is_whole() => vec![],
            When::Timed { points, q, has_phase } => {
                self.place_timed(points, q, *has_phase, &course.points).into_iter().collect()
            }
        }
    }

    fn place_free(
        &self,
        target: &Target,
        fractions: &[f64],
        course: &Course,
        simd: Simd,
    ) -> Vec<Placed> {
        let retrieval = Retrieval::new(target, [LEAST_ARC, MOST_ARC]);
        let (mut curve, points) = (Curve::default(), &course.points);
        if !curve.read(points.len(), |t| points[t]) {
            return vec![];
        }
        let placed = |found: Match| {
            let Match { by, mean, .. } = found;
            let mean = if found.is_mirrored() { mean.conj() } else { mean };
            let placing = Placing {
                by: by.scale(target.radius),
                shift: target.centre + (retrieval.mean() - by * mean).scale(target.radius),
                is_mirrored: found.is_mirrored(),
            };
            let (inner, outer) = placing.split(self.freedom)?;
            let angle = |&part: &f64| {
                inner.coordinate(course.coordinate(retrieval.angle(&curve, &found, part)))
            };
            let q = fractions.iter().map(angle).collect();
            Some(Placed { inner, outer, q })
        };
        retrieval.compare_at(&curve, simd).into_iter().flatten().filter_map(placed).collect()
    }

    fn place_timed(
        &self,
        points: &[Vector],
        q: &[f64],
        has_phase: bool,
        curve: &[Vector],
    ) -> Option<Placed> {
        let count = points.len() as f64;
        let mean = |all: &[Vector]| {
            all.iter().fold(Vector::ZERO, |sum, &one| sum + one).scale(1.0 / count)
        };
        // A mechanism that turns in its frame turns its driver, which then is ahead by as much.
        let turns_back = !has_phase && self.freedom == Freedom::None;
        let phases = if has_phase || turns_back { PHASES } else { 1 };
        let target_mean = mean(points);
        let mut best: Option<(f64, Placing, f64)> = None;
        for k in 0..phases {
            let phase = TAU * k as f64 / phases as f64;
            let at: Vec<Vector> = q.iter().map(|q| at_angle(curve, q + phase)).collect();
            let middle = mean(&at);
            let (mut product, mut square) = (Vector::ZERO, 0.0);
            for (&point, &at) in points.iter().zip(&at) {
                product += (point - target_mean) * (at - middle).conj();
                square += (at - middle).norm2();
            }
            if turns_back {
                let back = Vector::at_angle(-phase);
                product = back.scale((product * back.conj()).x.max(0.0));
            }
            let gain = product.norm2() / square;
            if gain > 0.0 && gain.is_finite() && best.as_ref().is_none_or(|best| best.0 < gain) {
                let by = product.scale(1.0 / square);
                let shift = target_mean - by * middle;
                best = Some((gain, Placing { by, shift, is_mirrored: false }, phase));
            }
        }
        let (_, placing, phase) = best?;
        let (inner, outer) = placing.split(self.freedom)?;
        let q = q.iter().map(|q| inner.coordinate(q + phase)).collect();
        Some(Placed { inner, outer, q })
    }
}

/// Whether one driver turns a link from the frame: it turns with the whole mechanism.
pub(super) fn drives_from_the_frame(mechanism: &Mechanism) -> bool {
    let linkage = mechanism.linkage();
    matches!(linkage.drivers[..], [Driver::Angle { relative_to, .. }] if relative_to == linkage.ground)
}

/// A curve's point at an angle of the driver, between the positions of a turn.
fn at_angle(curve: &[Vector], angle: f64) -> Vector {
    let place = (angle / TAU).rem_euclid(1.0) * TRAVEL_POSITIONS as f64;
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "below the positions of a turn"
    )]
    let from = (place as usize).min(TRAVEL_POSITIONS - 1);
    let (start, end) = (curve[from], curve[(from + 1) % TRAVEL_POSITIONS]);
    start + (end - start).scale(place - from as f64)
}

/// The parts of a path's length at its points.
fn fractions(points: &[[f64; 2]], is_closed: bool) -> Vec<f64> {
    let distance = |a: [f64; 2], b: [f64; 2]| Vector::new(b[0] - a[0], b[1] - a[1]).norm();
    let mut lengths = vec![0.0];
    for ends in points.windows(2) {
        lengths.push(lengths[lengths.len() - 1] + distance(ends[0], ends[1]));
    }
    let mut total = lengths[lengths.len() - 1];
    if let ([first, ..], [.., last], true) = (points, points, is_closed) {
        total += distance(*last, *first);
    }
    lengths.iter().map(|length| length / total).collect()
}

impl FitTarget {
    /// Whether the order of coordinates is that of the points, forwards or backwards: within one turn.
    pub(super) fn keeps_order(&self, q: &[f64]) -> bool {
        let Timing::Free { is_ordered: true, .. } = self.timing else { return true };
        let steps = || q.windows(2).map(|ends| ends[1] - ends[0]);
        let whole: f64 = steps().map(f64::abs).sum();
        (steps().all(|step| step > 0.0) || steps().all(|step| step < 0.0)) && whole <= TAU
    }
}
