//! Fits: rounds of starts, the best of which descend.

use std::cmp::Ordering;
use std::sync::atomic::AtomicBool;

use super::conditions::KEPT as MISS;
use super::descend::{Stage, descend};
use super::place::{Placing, drives_from_the_frame};
use super::point::Point;
use super::problem::{Compiled, FitRequest, Problem};
use super::start::{Start, Starts};
use super::target::Freedom;
use crate::description::error::SolveError;
use crate::plan::mechanism::Mechanism;
use crate::search::for_all::for_all;

/// Random designs of a round, and of a block of them.
const DESIGNS: usize = 2048;
const BLOCK: usize = 128;
/// Positions of the travel in the stages of a round.
const EARLY: usize = 128;
const LATE: usize = 256;
const FINE: usize = 512;
/// Stages of a round: how many descend, by how many steps, over how many positions of the travel. Multipliers of
/// conditions change between stages.
///
/// Where a dyad nearly folds, the square of its transmission angle changes by about the square of the driver's step:
/// half a step of the first stages is 0.025, of the last 0.006.
const STAGES: [Stage; 8] = [
    stage(64, 12, EARLY),
    stage(24, 30, EARLY),
    stage(8, 40, LATE),
    stage(8, 40, LATE),
    stage(8, 40, LATE),
    stage(8, 60, FINE),
    stage(4, 100, FINE),
    stage(3, 600, FINE),
];
/// Designs that descend side by side.
const SIDE_BY_SIDE: usize = 16;
/// Results that are kept.
const KEPT: usize = 16;
/// Designs whose numbers differ by less than this part are the same.
const SAME: f64 = 1e-4;

const fn stage(count: usize, steps: usize, travel: usize) -> Stage {
    Stage { count, steps, travel }
}

/// Sums of squares below this part of the target's size are rounding.
const EXACT: f64 = 1e-24;

/// A design that a fit has found.
#[derive(Debug, Clone)]
pub struct Fitted {
    /// Its dimensions.
    pub dimensions: Vec<f64>,
    /// Index of its assembly in the request.
    pub assembly: usize,
    /// The driver's coordinates at all positions, target after target.
    pub q: Vec<f64>,
    /// The numbers that belong to targets, target after target: the phase, then those of [`super::target::Freedom`].
    pub free: Vec<f64>,
    /// The sum of squared residuals.
    pub sum: f64,
    /// By how much limits are missed, in their units; not positive where they are kept.
    pub misses: Vec<f64>,
}

/// A fit in progress: the caller has the clock and asks for rounds until it has had enough.
#[derive(Debug)]
pub struct Fit {
    compiled: Compiled,
    /// Different designs, best first.
    found: Vec<Start>,
    /// Without any that keeps all limits: the one that misses them the least.
    nearest: Option<Start>,
    rounds: u64,
    evaluations: u64,
    /// Descents that ended at the best design, or at another one as good.
    agreeing: u64,
}

impl Fit {
    /// Of a request whose targets have as many wanted values as weights and coordinates.
    #[must_use]
    pub fn new(request: FitRequest) -> Self {
        Self {
            compiled: Compiled::new(request),
            found: vec![],
            nearest: None,
            rounds: 0,
            evaluations: 0,
            agreeing: 0,
        }
    }

    /// Designs that were evaluated so far.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// The least sum of squared residuals so far; infinite without designs.
    #[must_use]
    pub fn best(&self) -> f64 {
        self.found.first().map_or(f64::INFINITY, |start| 2.0 * start.1.misfit)
    }

    /// Whether the best design misses nothing but rounding.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.best() <= EXACT * self.compiled.size
    }

    /// How often the best design was found.
    #[must_use]
    pub fn agreeing(&self) -> u64 {
        self.agreeing
    }

    /// The designs found so far, best first.
    #[must_use]
    pub fn found(&self, mechanism: &Mechanism) -> Vec<Fitted> {
        self.found.iter().map(|start| self.fitted(mechanism, start)).collect()
    }

    /// Of designs that miss a limit the one that misses it the least.
    #[must_use]
    pub fn nearest(&self, mechanism: &Mechanism) -> Option<Fitted> {
        self.nearest.as_ref().map(|start| self.fitted(mechanism, start))
    }

    /// A design as users take it: moved to its place where that is free.
    fn fitted(&self, mechanism: &Mechanism, (assembly, point): &Start) -> Fitted {
        let problem = self.compiled.of(mechanism);
        let (x, free) = point.x.split_at(problem.variables.len());
        let mut dimensions = problem.variables.dimensions(x);
        let mut q = point.q.clone();
        for (target, positions, extra) in problem.parts() {
            let numbers = &point.x[extra + target.extra() - target.freedom.numbers()..]
                [..target.freedom.numbers()];
            if let (Freedom::Place, Some(place)) = (target.freedom, Placing::of_place(numbers))
                && let Some(moved) = place.dimensions(&problem, &dimensions)
            {
                dimensions = moved;
                if drives_from_the_frame(mechanism) {
                    for q in &mut q[positions] {
                        *q = place.coordinate(*q);
                    }
                }
            }
        }
        Fitted {
            dimensions,
            assembly: *assembly,
            q,
            free: free.to_vec(),
            sum: 2.0 * point.misfit,
            misses: point.multipliers.misses.clone(),
        }
    }

    /// One round, with the mechanism of the request.
    ///
    /// # Errors
    ///
    /// [`SolveError::Interrupted`]: what was found before stays.
    pub fn round(&mut self, mechanism: &Mechanism, cancel: &AtomicBool) -> Result<(), SolveError> {
        let mut starts = self.starts(mechanism, cancel)?;
        for stage in STAGES {
            starts.sort_by(best_first);
            starts.truncate(stage.count);
            starts = self.descend(mechanism, starts, stage, cancel)?;
        }
        self.rounds += 1;
        for start in starts {
            self.keep(start);
        }
        self.found.sort_by(|a, b| a.1.misfit.total_cmp(&b.1.misfit));
        self.found.truncate(KEPT);
        Ok(())
    }

    fn starts(
        &mut self,
        mechanism: &Mechanism,
        cancel: &AtomicBool,
    ) -> Result<Vec<Start>, SolveError> {
        let problem: Problem = self.compiled.of(mechanism);
        let starts = Starts::new(problem);
        let first = self.rounds * DESIGNS as u64;
        let made = for_all(problem.threads, DESIGNS / BLOCK, |block, (): &mut ()| {
            let first = first + (block * BLOCK) as u64;
            starts.make(first..first + BLOCK as u64, block % problem.assemblies.len(), cancel)
        });
        let mut all = vec![];
        for made in made {
            all.extend(made?);
        }
        self.evaluations += DESIGNS as u64;
        Ok(all)
    }

    fn descend(
        &mut self,
        mechanism: &Mechanism,
        mut starts: Vec<Start>,
        stage: Stage,
        cancel: &AtomicBool,
    ) -> Result<Vec<Start>, SolveError> {
        let mut blocks: Vec<(usize, Vec<Point>)> = vec![];
        starts.sort_by_key(|start| start.0);
        for (assembly, point) in starts {
            match blocks.last_mut() {
                Some((same, block)) if *same == assembly && block.len() < SIDE_BY_SIDE => {
                    block.push(point);
                }
                _ => blocks.push((assembly, vec![point])),
            }
        }
        let problem = self.compiled.of(mechanism);
        let done = for_all(problem.threads, blocks.len(), |index, (): &mut ()| {
            let (assembly, block) = &blocks[index];
            let descended = descend(&problem, block.clone(), *assembly, stage, cancel);
            descended.map(|(points, evaluations)| (*assembly, points, evaluations))
        });
        let mut all = vec![];
        for done in done {
            let (assembly, points, evaluations) = done?;
            self.evaluations += evaluations;
            all.extend(points.into_iter().map(|point| (assembly, point)));
        }
        Ok(all)
    }

    /// Keeps a design unless it is there already.
    fn keep(&mut self, start: Start) {
        for (target, positions, _) in self.compiled.parts() {
            if !target.keeps_order(&start.1.q[positions]) {
                return;
            }
        }
        if start.1.multipliers.worst() > MISS {
            if self
                .nearest
                .as_ref()
                .is_none_or(|one| one.1.multipliers.worst() > start.1.multipliers.worst())
            {
                self.nearest = Some(start);
            }
            return;
        }
        let best = self.found.iter().map(|one| one.1.misfit).fold(f64::INFINITY, f64::min);
        let value = start.1.misfit;
        // What rounding leaves of an exact design differs from descent to descent.
        let exact = EXACT * self.compiled.size;
        if value < best * (1.0 - SAME) && best > exact {
            self.agreeing = 1;
        } else if value <= (best * (1.0 + SAME)).max(exact) {
            self.agreeing += 1;
        }
        let count = self.compiled.variables.len();
        let is_same = |other: &Start| {
            let far = |(a, b): (&f64, &f64)| (a - b).abs() > SAME * (a.abs() + b.abs());
            other.0 == start.0 && !start.1.x[..count].iter().zip(&other.1.x[..count]).any(far)
        };
        match self.found.iter_mut().find(|other| is_same(other)) {
            Some(other) if other.1.misfit > value => *other = start,
            Some(_) => {}
            None => self.found.push(start),
        }
    }
}

fn best_first(a: &Start, b: &Start) -> Ordering {
    a.1.value.total_cmp(&b.1.value)
}
