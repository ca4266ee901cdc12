//! The position nearest to a given one, and from there along values.

use std::sync::atomic::{AtomicBool, Ordering};

use super::follow::{End, size};
use super::inverse::Inverse;
use super::motion::{Assembled, Motion, Point};
use crate::description::error::SolveError;
use crate::plan::mechanism::Mechanism;
use crate::state::status::Status;

/// Values of one position found in two ways, rad or in sizes.
const SAME: f64 = 1.0e-7;
/// A fold is this near (rad, or in sizes) to where following it ends: half of all digits are lost there.
const AT_FOLD: f64 = 1.0e-3;
/// From a fold itself both ways go on alike: the next position is this near at most.
const FROM_FOLD: f64 = 0.5;

/// A design to follow from a position on.
#[derive(Debug, Clone, Copy)]
pub struct Start<'s> {
    /// Its mechanism.
    pub mechanism: &'s Mechanism,
    /// Its dimensions.
    pub dimensions: &'s [f64],
    /// The assembly, by its signs at the drawing.
    pub signs: &'s [i8],
    /// Coordinates of the drivers, rad or m.
    pub q: &'s [f64],
}

/// A position that was followed.
#[derive(Debug, Clone, PartialEq)]
pub struct Followed {
    /// Coordinates of the drivers, rad or m; NaN without a position.
    pub q: Vec<f64>,
    /// Whether there is one.
    pub status: Status,
}

impl Inverse {
    /// Follows a design, in its assembly, along rows of values. The first position is the one that is reached
    /// straight from the start or, if that way ends, the nearest one; each other one is reached straight from
    /// the one before.
    ///
    /// # Errors
    ///
    /// Those of [`Inverse::find`].
    pub fn follow(
        &self,
        start: Start<'_>,
        values: &[f64],
        cancel: Option<&AtomicBool>,
    ) -> Result<Vec<Followed>, SolveError> {
        let Start { mechanism, dimensions, signs, q } = start;
        mechanism.check(dimensions, q, signs)?;
        let drivers = self.drivers();
        if q.len() != drivers || !values.len().is_multiple_of(drivers) {
            return Err(SolveError::Shape("a value of every coordinate is needed".into()));
        }
        let failed = |status| Followed { q: vec![f64::NAN; drivers], status };
        let rows = values.chunks_exact(drivers);
        if mechanism.dimensions().first_fault(dimensions).is_some() {
            return Ok(rows.map(|_| failed(Status::BadDimension)).collect());
        }
        if q.iter().any(|q| !q.is_finite()) {
            return Ok(rows.map(|_| failed(Status::BadInput)).collect());
        }
        let assembled = Assembled { mechanism, dimensions, signs };
        let motion = Motion::new(assembled, &self.coordinates, &self.derivatives, cancel);
        let from = motion.scaled(q);
        let mut follower = Follower { inverse: self, start, motion, cancel, here: None };
        let mut followed = Vec::with_capacity(rows.len());
        for row in rows {
            if cancel.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
                return Err(SolveError::Interrupted);
            }
            if row.iter().any(|value| !value.is_finite()) {
                followed.push(failed(Status::BadInput));
                continue;
            }
            followed.push(match follower.next(&from, row)? {
                Ok(q) => Followed { q, status: Status::Ok },
                Err(status) => failed(status),
            });
        }
        Ok(followed)
    }
}

/// A design that is followed.
struct Follower<'f> {
    inverse: &'f Inverse,
    start: Start<'f>,
    motion: Motion<'f>,
    cancel: Option<&'f AtomicBool>,
    /// The last position.
    here: Option<Point>,
}

/// The position of an assembly that is nearest, if any, or why there is none.
type Nearest = Result<Point, Status>;

impl Follower<'_> {
    /// The position at a row of values.
    fn next(&mut self, start: &[f64], row: &[f64]) -> Result<Result<Vec<f64>, Status>, SolveError> {
        let before = self.here.take();
        let is_first = before.is_none();
        let from = if is_first { self.motion.at(start) } else { before.clone() };
        let there = match from {
            Some(from) => match self.motion.arrive(&from, row) {
                End::Reached(point) => Ok(point),
                End::Lost(point) => {
                    let is_at_fold = point.q == from.q;
                    let within = if is_at_fold { FROM_FOLD } else { AT_FOLD };
                    match self.nearest(&point.q, row, within)? {
                        Ok(fold) if !is_at_fold => {
                            // From the fold itself no way leads on: the next one begins beside it.
                            let q = self.motion.in_units(&fold.q);
                            self.here = Some(point);
                            return Ok(Ok(q));
                        }
                        Err(_) if is_first => self.nearest(start, row, f64::INFINITY)?,
                        near => near,
                    }
                }
            },
            // The assembly does not exist at the start, or folds there.
            None => self.nearest(start, row, f64::INFINITY)?,
        };
        let q = there.as_ref().map(|point| self.motion.in_units(&point.q));
        let q = q.map_err(|&status| status);
        // After a gap it goes on from the last position.
        self.here = there.ok().or(before);
        Ok(q)
    }

    /// Of all positions of the assembly with these values the one nearest to `near`, within a distance.
    fn nearest(&mut self, near: &[f64], row: &[f64], within: f64) -> Result<Nearest, SolveError> {
        let Start { mechanism, dimensions, .. } = self.start;
        let answers = self.inverse.find(mechanism, dimensions, row, self.cancel)?;
        let status = if answers.found.is_empty() { Status::Unreachable } else { Status::Lost };
        let mut best: Option<(f64, Point)> = None;
        for answer in answers.found {
            let q = self.motion.turned(&self.motion.scaled(&answer.q), near);
            let apart: Vec<f64> = q.iter().zip(near).map(|(a, b)| a - b).collect();
            let distance = size(&apart);
            let is_nearer = best.as_ref().is_none_or(|(nearest, _)| distance < *nearest);
            if distance > within || !is_nearer {
                continue;
            }
            // In this assembly the coordinates may have other values there.
            let Some(point) = self.motion.probe(&q) else { continue };
            let missing = self.motion.missing(&self.motion.targets(row, &point), &point);
            if size(&missing) <= SAME {
                best = Some((distance, point));
            }
        }
        Ok(best.and_then(|(_, point)| self.motion.at(&point.q)).ok_or(status))
    }
}
