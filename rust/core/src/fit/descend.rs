//! Damped least squares of a block of designs side by side.

use std::sync::atomic::AtomicBool;

use super::point::Point;
use super::problem::Problem;
use super::start::send_to_nearest;
use super::step::damped_step;
use super::target::Timing;
use crate::description::error::SolveError;

/// Damping at first; its factors after a success and a failure; its least value.
const DAMPING: f64 = 1e-2;
const AFTER_SUCCESS: f64 = 0.2;
const AFTER_FAILURE: f64 = 6.0;
const LEAST_DAMPING: f64 = 1e-14;
/// Failures one after another that end a descent.
const MOST_FAILURES: usize = 14;
/// A descent ends after so many successes one after another that gain less than this part of the value.
const SMALL_GAIN: f64 = 1e-9;
const SMALL_GAINS: usize = 3;
/// The most that a free coordinate moves at once, rad or m.
const MOST_FOLLOW: f64 = 0.5;

/// A stage of a round.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stage {
    /// Points that descend.
    pub count: usize,
    /// By how many steps at most.
    pub steps: usize,
    /// Positions of their travel.
    pub travel: usize,
}

/// One descent.
struct Descent {
    at: Point,
    trial: Point,
    damping: f64,
    failures: usize,
    small_gains: usize,
}

impl Descent {
    fn is_done(&self) -> bool {
        self.failures >= MOST_FAILURES || self.small_gains >= SMALL_GAINS || self.at.value == 0.0
    }

    /// Sets the trial; `false` if there is none.
    fn propose(&mut self, problem: &Problem) -> bool {
        let Self { at, trial, .. } = self;
        let Some(step) = damped_step(&at.normal, self.damping, &at.x, &problem.bounds) else {
            return false;
        };
        trial.x.clear();
        trial.x.extend(at.x.iter().zip(&step).map(|(x, step)| x + step));
        for (x, [low, high]) in trial.x.iter_mut().zip(&problem.bounds) {
            *x = x.clamp(*low, *high);
        }
        trial.q.clone_from(&at.q);
        let width = 1 + step.len();
        for (target, positions, _) in problem.parts() {
            if let Timing::Free { .. } = target.timing {
                for position in positions {
                    let follow = &at.normal.follow[position * width..][..width];
                    let moved =
                        follow[0] + follow[1..].iter().zip(&step).map(|(a, b)| a * b).sum::<f64>();
                    trial.q[position] += moved.clamp(-MOST_FOLLOW, MOST_FOLLOW);
                }
            }
        }
        true
    }

    fn decide(&mut self) {
        if self.trial.value < self.at.value {
            let is_small = self.at.value - self.trial.value < SMALL_GAIN * self.at.value;
            self.small_gains = if is_small { self.small_gains + 1 } else { 0 };
            std::mem::swap(&mut self.at, &mut self.trial);
            self.damping = (self.damping * AFTER_SUCCESS).max(LEAST_DAMPING);
            self.failures = 0;
        } else {
            self.fail();
        }
    }

    fn fail(&mut self) {
        self.damping *= AFTER_FAILURE;
        self.failures += 1;
    }
}

/// Improves evaluated points of one assembly by some steps at most; the points, and how many were evaluated.
pub(super) fn descend(
    problem: &Problem,
    points: Vec<Point>,
    assembly: usize,
    Stage { steps, travel, .. }: Stage,
    cancel: &AtomicBool,
) -> Result<(Vec<Point>, u64), SolveError> {
    let start = |at: Point| Descent {
        trial: at.clone(),
        at,
        damping: DAMPING,
        failures: 0,
        small_gains: 0,
    };
    let mut points = points;
    let mut moved: Vec<&mut Point> = points.iter_mut().collect();
    send_to_nearest(problem, &mut moved, assembly, cancel)?;
    // What counts, and where, has changed since they were evaluated.
    problem.evaluate(&mut moved, (assembly, travel), cancel)?;
    let mut all: Vec<Descent> = points.into_iter().map(start).collect();
    let mut evaluations = 0;
    for _ in 0..steps {
        if all.iter().all(Descent::is_done) {
            break;
        }
        let mut tried = vec![];
        for descent in all.iter_mut().filter(|descent| !descent.is_done()) {
            if descent.propose(problem) {
                tried.push(descent);
            } else {
                descent.fail();
            }
        }
        evaluations += tried.len() as u64;
        let mut trials: Vec<&mut Point> =
            tried.iter_mut().map(|descent| &mut descent.trial).collect();
        problem.evaluate(&mut trials, (assembly, travel), cancel)?;
        for descent in tried {
            descent.decide();
        }
    }
    let mut points: Vec<Point> = all.into_iter().map(|descent| descent.at).collect();
    for point in &mut points {
        point.multipliers.update();
    }
    Ok((points, evaluations))
}
