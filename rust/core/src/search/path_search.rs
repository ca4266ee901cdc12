//! The search for a linkage that draws a path: random linkages, the most alike of them refined, then evolution.

use std::num::NonZeroUsize;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

use super::budget::Budget;
use super::evolve::{Breeder, Rules};
use super::levenberg_marquardt::Refiner;
use super::objective::{Candidate, Fineness, Limits, Objective};
use super::retrieve::{Retrieval, RetrievalMemory};
use super::target::Target;
use crate::batch::dispatch::{Entry, ForLevel, at_level};
use crate::description::Description;
use crate::math::random::Random;
use crate::math::simd::Simd;
use crate::math::vector::Vector;
use crate::population::random::RandomLinkages;

/// Random linkages whose curves are compared with the target.
const LIBRARY: usize = 2000;
/// Stages of refinement of the most alike: how many, for how many iterations, how finely.
const HALVING: [(usize, usize, Fineness); 5] = [
    (1500, 6, Fineness { positions: (64, 32), samples: 64, epsilon: None }),
    (375, 15, Fineness { positions: (64, 32), samples: 64, epsilon: None }),
    (125, 15, Fineness { positions: (64, 32), samples: 64, epsilon: Some(0.1) }),
    (125, 25, Fineness { positions: (96, 32), samples: 128, epsilon: Some(0.05) }),
    (50, 40, EVOLUTION),
];
/// How finely children are scored, and how finely they are checked.
const EVOLUTION: Fineness = Fineness { positions: (128, 64), samples: 128, epsilon: Some(0.02) };
const SOUND: Fineness = Fineness { positions: (512, 128), samples: 64, epsilon: None };
/// Islands and candidates on each; the part of the budget before they are one.
const ISLANDS: usize = 4;
const ON_ISLAND: usize = 4;
const APART: f64 = 0.6;
/// Part of the budget before the best are polished.
const EVOLVED: f64 = 0.9;
/// Children that are bred at the same time once the islands are one.
const BROOD: usize = 8;
/// Candidates that are polished, iterations, how finely.
const POLISHED: usize = 5;
const POLISH: [Fineness; 2] = [
    Fineness { positions: (192, 96), samples: 128, epsilon: Some(0.01) },
    Fineness { positions: (256, 96), samples: 256, epsilon: Some(0.004) },
];
const POLISH_ITERATIONS: usize = 40;

/// What is asked of a search.
#[derive(Debug, Clone)]
pub struct SearchRequest<'a> {
    /// The path's corners.
    pub points: &'a [[f64; 2]],
    /// Whether the last leads back to the first.
    pub is_closed: bool,
    /// The greatest number of joints.
    pub joints: usize,
    /// The least angle between the bars of a dyad, over the whole turn, rad.
    pub least_apex: f64,
    /// The greatest distance of a joint from the path's centroid over the whole turn, in root mean square radii of the path.
    pub frame: f64,
    /// The least arc of the crank on which an open path is drawn, rad.
    pub least_arc: f64,
    /// By which part a further joint must lower the error.
    pub joint_price: f64,
    /// Results differ with it.
    pub seed: u64,
    /// The time that it may take.
    pub time: Option<Duration>,
    /// The number of linkages that it may evaluate.
    pub evaluations: Option<u64>,
    /// The most threads.
    pub threads: NonZeroUsize,
    /// Level of vector instructions.
    pub simd: Simd,
    /// Setting it to true ends the search with the best so far.
    pub cancel: Option<&'a AtomicBool>,
}

/// A linkage that was found.
#[derive(Debug, Clone)]
pub struct FoundLinkage {
    /// It, drawn where it begins with the path. The traced joint is the last.
    pub description: Description,
    /// The crank's turn over the path, rad, positive counter-clockwise.
    pub arc: f64,
    /// The objective.
    pub value: f64,
    /// Number of joints.
    pub joints: usize,
}

/// Result of a search.
#[derive(Debug, Clone, Default)]
pub struct SearchResult {
    /// What was found, the best first.
    pub found: Vec<FoundLinkage>,
    /// Linkages that were evaluated.
    pub evaluations: u64,
    /// The time that it took.
    pub time: Duration,
}

/// Searches for linkages that draw a path. `None` if there is no path: fewer than two different points, or
/// one that is not finite.
#[must_use]
pub fn search_path(request: &SearchRequest<'_>) -> Option<SearchResult> {
    let target = Target::new(request.points, request.is_closed)?;
    Some(at_level(request.simd, Search { request, target: &target }))
}

struct Search<'s> {
    request: &'s SearchRequest<'s>,
    target: &'s Target,
}

impl ForLevel for Search<'_> {
    type Output = SearchResult;

    fn run<L: Entry, const G: usize>(self) -> SearchResult {
        let request = self.request;
        let budget = Budget::new(request.time, request.evaluations, request.cancel);
        let limits = self.limits();
        let objective = Objective::new(self.target, limits, EVOLUTION);
        let sound = Objective::new(self.target, self.strict_limits(), SOUND);
        let rules = Rules {
            objective: &objective,
            sound: &sound,
            most_joints: request.joints,
            joint_price: request.joint_price,
        };
        let (starts, mut evaluations) = self.starts::<L>(&rules, &budget);
        let mut population = self.islands::<L>(&rules, starts, &budget, &mut evaluations);
        self.together::<L>(&rules, &mut population, &budget, &mut evaluations);
        let found = self.polish::<L>(&rules, population, &mut evaluations);
        SearchResult { found, evaluations, time: budget.elapsed() }
    }
}

impl Search<'_> {
    /// The limits that refinement keeps.
    fn limits(&self) -> Limits {
        let cos = |angle: f64| Vector::<f64>::at_angle(angle).x;
        let apex = self.request.least_apex;
        Limits {
            apex_cosine: cos(0.3 * apex),
            apex_barrier: cos(1.02 * apex),
            frame: 1.2 * self.request.frame,
            frame_barrier: 0.97 * self.request.frame,
            arc: [1.02 * self.request.least_arc, 6.2],
        }
    }

    /// The limits that results keep.
    fn strict_limits(&self) -> Limits {
        let apex_cosine = Vector::<f64>::at_angle(self.request.least_apex).x;
        Limits { apex_cosine, frame: self.request.frame, ..self.limits() }
    }

    /// Does something for all indices below a count, on all threads; results are in order.
    fn for_all<M: Default, T: Send>(
        &self,
        count: usize,
        work: impl Fn(usize, &mut M) -> T + Sync,
    ) -> Vec<T> {
        let next = AtomicUsize::new(0);
        let results: Mutex<Vec<(usize, T)>> = Mutex::new(Vec::with_capacity(count));
        let work_until_done = || {
            let mut memory = M::default();
            loop {
                let index = next.fetch_add(1, Ordering::Relaxed);
                if index >= count {
                    return;
                }
                let result = work(index, &mut memory);
                if let Ok(mut results) = results.lock() {
                    results.push((index, result));
                }
            }
        };
        thread::scope(|scope| {
            for _ in 1..self.request.threads.get().min(count) {
                scope.spawn(work_until_done);
            }
            work_until_done();
        });
        let mut results = results.into_inner().unwrap_or_default();
        results.sort_by_key(|(index, _)| *index);
        results.into_iter().map(|(_, result)| result).collect()
    }

    /// The most alike random linkages, refined: enough for all islands.
    fn starts<L: Entry>(&self, rules: &Rules<'_>, budget: &Budget<'_>) -> (Vec<Candidate>, u64) {
        let limits = self.limits();
        let wanted = RandomLinkages {
            joints: [5, self.request.joints.clamp(5, 13)],
            most_cosine: 0.97_f64.min(limits.apex_barrier),
        };
        let retrieval = Retrieval::new(self.target, limits);
        let mut candidates: Vec<Candidate> = self
            .for_all(LIBRARY, |index, memory: &mut RetrievalMemory| {
                retrieval.candidates::<L>(&wanted, (self.request.seed, index as u64), memory)
            })
            .into_iter()
            .flatten()
            .collect();
        let mut evaluations = 0;
        for (count, iterations, fineness) in HALVING {
            let objective = Objective::new(self.target, limits, fineness);
            candidates.sort_by(|a, b| a.value.total_cmp(&b.value));
            candidates.truncate(count);
            let refined = self.for_all(candidates.len(), |index, refiner: &mut Refiner| {
                let before = refiner.work.evaluations;
                let mut candidate = candidates[index].clone();
                if !budget.is_cancelled() {
                    refiner.refine::<L>(&objective, &mut candidate, iterations);
                }
                (candidate, refiner.work.evaluations - before)
            });
            candidates.clear();
            for (candidate, count) in refined {
                evaluations += count;
                if candidate.value.is_finite() {
                    candidates.push(candidate);
                }
            }
        }
        candidates.sort_by(|a, b| rules.score(a).total_cmp(&rules.score(b)));
        let mut breeder = Breeder::default();
        candidates.retain(|candidate| rules.is_sound::<L>(candidate, &mut breeder));
        candidates.dedup_by(|a, b| (a.value - b.value).abs() < 1e-3 * b.value);
        candidates.truncate(ISLANDS * ON_ISLAND);
        (candidates, evaluations)
    }

    /// Evolution on islands.
    fn islands<L: Entry>(
        &self,
        rules: &Rules<'_>,
        starts: Vec<Candidate>,
        budget: &Budget<'_>,
        evaluations: &mut u64,
    ) -> Vec<Candidate> {
        let mut islands = vec![vec![]; ISLANDS];
        for (index, start) in starts.into_iter().enumerate() {
            islands[index % ISLANDS].push(start);
        }
        islands.retain(|island| !island.is_empty());
        let rounds = islands.len().div_ceil(self.request.threads.get()).max(1);
        let before = *evaluations / islands.len().max(1) as u64;
        let started = budget.part_used();
        let evolved = self.for_all(islands.len(), |index, breeder: &mut Breeder| {
            let mut island = islands[index].clone();
            let random = &mut Random::new(self.request.seed, (LIBRARY + index) as u64);
            let first = breeder.refiner.work.evaluations;
            let round = index / self.request.threads.get();
            let end = started + (APART - started) * (round + 1) as f64 / rounds as f64;
            loop {
                let count = breeder.refiner.work.evaluations - first;
                if budget.is_used([end, APART], before + count, islands.len() as u64) {
                    return (island, count);
                }
                if let Some(child) = rules.breed::<L>(&island, random, breeder) {
                    rules.insert(&mut island, child, random);
                }
            }
        });
        let mut population = vec![];
        for (island, count) in evolved {
            *evaluations += count;
            population.extend(island);
        }
        population
    }

    /// Evolution of all together, some children at a time.
    fn together<L: Entry>(
        &self,
        rules: &Rules<'_>,
        population: &mut Vec<Candidate>,
        budget: &Budget<'_>,
        evaluations: &mut u64,
    ) {
        let mut random = Random::new(self.request.seed, (LIBRARY + ISLANDS) as u64);
        let breeders: Vec<Mutex<Breeder>> = (0..BROOD).map(|_| Mutex::default()).collect();
        while !population.is_empty() && !budget.is_used([EVOLVED; 2], *evaluations, 1) {
            let seed = random.bits();
            let brood = self.for_all(BROOD, |index, (): &mut ()| {
                let mut breeder = breeders[index].lock().ok()?;
                let before = breeder.refiner.work.evaluations;
                let own = &mut Random::new(seed, index as u64);
                let child = rules.breed::<L>(population, own, &mut breeder);
                Some((child, breeder.refiner.work.evaluations - before))
            });
            for (child, count) in brood.into_iter().flatten() {
                *evaluations += count;
                if let Some(child) = child {
                    rules.insert(population, child, &mut random);
                }
            }
        }
        population.sort_by(|a, b| rules.score(a).total_cmp(&rules.score(b)));
    }

    /// Refines the best once more, and describes them in the user's units.
    fn polish<L: Entry>(
        &self,
        rules: &Rules<'_>,
        population: Vec<Candidate>,
        evaluations: &mut u64,
    ) -> Vec<FoundLinkage> {
        let objectives =
            POLISH.map(|fineness| Objective::new(self.target, self.limits(), fineness));
        let polished = self.for_all(population.len(), |index, breeder: &mut Breeder| {
            let before = breeder.refiner.work.evaluations;
            let mut candidate = population[index].clone();
            for objective in &objectives {
                let mut finer = candidate.clone();
                breeder.refiner.evaluate::<L>(objective, &mut candidate);
                if index < POLISHED {
                    breeder.refiner.refine::<L>(objective, &mut finer, POLISH_ITERATIONS);
                    if rules.is_sound::<L>(&finer, breeder) {
                        candidate = finer;
                    }
                }
            }
            (candidate, breeder.refiner.work.evaluations - before)
        });
        let mut found = vec![];
        for (candidate, count) in polished {
            *evaluations += count;
            found.extend(self.describe(candidate));
        }
        found.sort_by(|a, b| a.value.total_cmp(&b.value));
        found
    }

    fn describe(&self, candidate: Candidate) -> Option<FoundLinkage> {
        let Candidate { mut linkage, arc, value } = candidate;
        let scale = Vector::new(self.target.radius, 0.0);
        linkage.transform(scale, self.target.centre, false);
        Some(FoundLinkage {
            description: linkage.describe("P")?,
            arc: arc * linkage.sense,
            value,
            joints: linkage.len(),
        })
    }
}
