//! The search for a linkage that draws a path: random linkages, the most alike of them refined, then evolution.
//!
//! The caller has the clock: it makes the starts, asks for rounds of evolution until it has had enough, and takes
//! the results. A search that is limited in evaluations is the same on every machine and any number of threads.

use std::num::NonZeroUsize;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

use super::evolve::{Breeder, Rules};
use super::for_all::for_all;
use super::levenberg_marquardt::Refiner;
use super::limits::Limits;
use super::objective::{Candidate, Fineness, Objective};
use super::retrieve::{Retrieval, RetrievalMemory};
use super::target::Target;
use crate::batch::dispatch::{Entry, ForLevel, at_level};
use crate::batch::helpers::available_threads;
use crate::description::Description;
use crate::math::random::Random;
use crate::math::simd::Simd;
use crate::math::vector::Vector;
use crate::population::random::RandomLinkages;

/// Random linkages whose curves are compared with the target, and their joints.
const LIBRARY: usize = 2000;
const LIBRARY_JOINTS: [usize; 2] = [5, 13];
/// Greatest absolute cosine of their apex angles, at most that of the limits.
const LIBRARY_COSINE: f64 = 0.97;
/// Stages of refinement of the most alike: how many, for how many iterations, how finely.
const HALVING: [(usize, usize, Fineness); 5] = [
    (1500, 6, Fineness { positions: (64, 32), samples: 64, epsilon: None }),
    (375, 15, Fineness { positions: (64, 32), samples: 64, epsilon: None }),
    (125, 15, Fineness { positions: (64, 32), samples: 64, epsilon: Some(0.1) }),
    (125, 25, Fineness { positions: (96, 32), samples: 128, epsilon: Some(0.05) }),
    (50, 40, EVOLUTION),
];
/// How finely children are scored, and how finely they are checked.
const EVOLUTION: Fineness = Fineness { positions: (128, 64), samples: 128, epsilon: Some(0.008) };
const SOUND: Fineness = Fineness { positions: (512, 128), samples: 64, epsilon: None };
/// Islands, and candidates on each: a start decides more about a design than the evaluations that follow.
const ISLANDS: usize = 8;
const ON_ISLAND: usize = 4;
/// Evaluations of an island in a round, and children of all together in one.
const ROUND: u64 = 1000;
const BROOD: usize = 8;
/// How finely results are refined, and in how many iterations: there is still much to gain.
const POLISH: [Fineness; 2] = [
    Fineness { positions: (192, 96), samples: 128, epsilon: Some(0.01) },
    Fineness { positions: (256, 96), samples: 256, epsilon: Some(0.004) },
];
const POLISH_ITERATIONS: usize = 300;
/// Values that differ by less than this part are of the same design.
const SAME: f64 = 1e-3;
/// Barriers begin at this part of the frame, and at this multiple of the least apex angle; refinement may go beyond
/// the limits by so much.
const FRAME_MARGIN: f64 = 0.97;
const APEX_MARGIN: f64 = 1.02;
const BEYOND_FRAME: f64 = 1.2;
const BEYOND_APEX: f64 = 0.3;
/// The greatest arc of an open path, rad; its least is greater by this factor.
const MOST_ARC: f64 = 6.2;
const ARC_MARGIN: f64 = 1.02;

/// What is asked of a search.
#[derive(Debug, Clone, Copy)]
pub struct SearchRequest {
    /// Whether the path leads from its last corner back to the first.
    pub is_closed: bool,
    /// The greatest number of joints.
    pub joints: usize,
    /// The least angle between the bars of a dyad, over the whole turn, rad.
    pub least_apex: f64,
    /// The greatest distance of a joint from the path's centroid over the whole turn, in root mean square radii of
    /// the path.
    pub frame: f64,
    /// The least arc of the crank on which an open path is drawn, rad.
    pub least_arc: f64,
    /// By which part a further joint must lower the objective.
    pub joint_price: f64,
    /// Results differ with it.
    pub seed: u64,
    /// The most threads; `None` means one per core.
    pub threads: Option<NonZeroUsize>,
    /// Level of vector instructions.
    pub simd: Simd,
}

/// A linkage that was found.
#[derive(Debug, Clone)]
pub struct FoundLinkage {
    /// It, drawn where it begins with the path. The traced joint is the last, P.
    pub description: Description,
    /// The crank's turn over the path, rad, positive counter-clockwise.
    pub arc: f64,
    /// The objective.
    pub value: f64,
}

/// A search in progress.
#[derive(Debug)]
pub struct PathSearch {
    request: SearchRequest,
    target: Target,
    islands: Vec<Island>,
    /// All candidates, once the islands are one.
    population: Vec<Candidate>,
    breeders: Vec<Mutex<Breeder>>,
    random: Random,
    evaluations: u64,
}

#[derive(Debug)]
struct Island {
    candidates: Vec<Candidate>,
    random: Random,
    breeder: Breeder,
}

/// A part of a search, to be done at a level.
struct Part<'p> {
    search: &'p mut PathSearch,
    kind: PartKind,
    cancel: &'p AtomicBool,
}

#[derive(Debug, Clone, Copy)]
enum PartKind {
    Start,
    Round { is_apart: bool },
    Finish,
}

impl ForLevel for Part<'_> {
    type Output = Vec<FoundLinkage>;

    fn run<L: Entry, const G: usize>(self) -> Vec<FoundLinkage> {
        match self.kind {
            PartKind::Start => self.search.start_at::<L>(self.cancel),
            PartKind::Round { is_apart: true } => self.search.round_apart::<L>(),
            PartKind::Round { is_apart: false } => self.search.round_together::<L>(),
            PartKind::Finish => return self.search.finish_at::<L>(self.cancel),
        }
        vec![]
    }
}

impl PathSearch {
    /// A search for linkages that draw the path through points. `None` if there is no path: fewer than two different
    /// points, or one that is not finite.
    #[must_use]
    pub fn new(points: &[[f64; 2]], request: SearchRequest) -> Option<Self> {
        Some(Self {
            request,
            target: Target::new(points, request.is_closed)?,
            islands: vec![],
            population: vec![],
            breeders: (0..BROOD).map(|_| Mutex::default()).collect(),
            random: Random::new(request.seed, (LIBRARY + ISLANDS) as u64),
            evaluations: 0,
        })
    }

    /// Linkages that were evaluated so far.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// The least objective so far; infinite without candidates.
    #[must_use]
    pub fn best(&self) -> f64 {
        let all = self.islands.iter().flat_map(|island| &island.candidates);
        all.chain(&self.population).map(|one| one.value).fold(f64::INFINITY, f64::min)
    }

    /// Makes the candidates that evolution starts from.
    pub fn start(&mut self, cancel: &AtomicBool) {
        let simd = self.request.simd;
        at_level(simd, Part { search: self, kind: PartKind::Start, cancel });
    }

    /// A round of evolution: on islands as long as they are apart, then of all together. `false` if there
    /// is nothing that could evolve.
    pub fn round(&mut self, is_apart: bool, cancel: &AtomicBool) -> bool {
        let simd = self.request.simd;
        at_level(simd, Part { search: self, kind: PartKind::Round { is_apart }, cancel });
        !(self.islands.is_empty() && self.population.is_empty())
    }

    /// The candidates, refined once more (unless that is cancelled), best first.
    #[must_use]
    pub fn finish(&mut self, cancel: &AtomicBool) -> Vec<FoundLinkage> {
        let simd = self.request.simd;
        at_level(simd, Part { search: self, kind: PartKind::Finish, cancel })
    }

    fn threads(&self) -> NonZeroUsize {
        let threads = self.request.threads.or_else(|| NonZeroUsize::new(available_threads()));
        threads.unwrap_or(NonZeroUsize::MIN)
    }

    /// The limits that refinement keeps.
    fn limits(&self) -> Limits {
        let cos = |angle: f64| Vector::<f64>::at_angle(angle).x;
        let SearchRequest { least_apex, frame, least_arc, .. } = self.request;
        Limits {
            apex_cosine: cos(BEYOND_APEX * least_apex),
            apex_barrier: cos(APEX_MARGIN * least_apex),
            frame: BEYOND_FRAME * frame,
            frame_barrier: FRAME_MARGIN * frame,
            arc: [(ARC_MARGIN * least_arc).min(MOST_ARC), MOST_ARC],
        }
    }

    /// The limits that results keep.
    fn strict_limits(&self) -> Limits {
        let apex_cosine = Vector::<f64>::at_angle(self.request.least_apex).x;
        Limits { apex_cosine, frame: self.request.frame, ..self.limits() }
    }

    fn objective(&self, fineness: Fineness) -> Objective<'_> {
        Objective::new(&self.target, self.limits(), fineness)
    }

    fn sound(&self) -> Objective<'_> {
        Objective::new(&self.target, self.strict_limits(), SOUND)
    }

    fn rules<'o>(&self, objective: &'o Objective<'o>, sound: &'o Objective<'o>) -> Rules<'o> {
        let SearchRequest { joints, joint_price, .. } = self.request;
        Rules { objective, sound, most_joints: joints, joint_price }
    }

    /// The most alike random linkages, refined: enough for all islands.
    fn start_at<L: Entry>(&mut self, cancel: &AtomicBool) {
        let mut candidates = self.retrieve::<L>();
        for (count, iterations, fineness) in HALVING {
            let objective = self.objective(fineness);
            candidates.sort_by(|a, b| a.value.total_cmp(&b.value));
            candidates.truncate(count);
            let refined =
                for_all(self.threads(), candidates.len(), |index, refiner: &mut Refiner| {
                    let before = refiner.work.evaluations;
                    let mut candidate = candidates[index].clone();
                    if !cancel.load(Ordering::Relaxed) {
                        refiner.refine::<L>(&objective, &mut candidate, iterations);
                    }
                    (candidate, refiner.work.evaluations - before)
                });
            candidates.clear();
            let mut evaluations = 0;
            for (candidate, count) in refined {
                evaluations += count;
                if candidate.value.is_finite() {
                    candidates.push(candidate);
                }
            }
            drop(objective);
            self.evaluations += evaluations;
        }
        let (objective, sound) = (self.objective(EVOLUTION), self.sound());
        let rules = self.rules(&objective, &sound);
        let mut breeder = Breeder::default();
        rules.sort(&mut candidates);
        candidates.retain(|candidate| rules.is_sound::<L>(candidate, &mut breeder));
        candidates.dedup_by(|a, b| (a.value - b.value).abs() < SAME * b.value);
        candidates.truncate(ISLANDS * ON_ISLAND);
        let mut islands: Vec<Island> = (0..ISLANDS.min(candidates.len()))
            .map(|index| Island {
                candidates: vec![],
                random: Random::new(self.request.seed, (LIBRARY + index) as u64),
                breeder: Breeder::default(),
            })
            .collect();
        for (index, candidate) in candidates.into_iter().enumerate() {
            islands[index % ISLANDS].candidates.push(candidate);
        }
        self.islands = islands;
    }

    /// The curves of random linkages that are most alike the target.
    fn retrieve<L: Entry>(&self) -> Vec<Candidate> {
        let limits = self.limits();
        let [least, most] = LIBRARY_JOINTS;
        let wanted = RandomLinkages {
            joints: [least.min(self.request.joints), most.min(self.request.joints)],
            most_cosine: LIBRARY_COSINE.min(limits.apex_barrier),
        };
        let retrieval = Retrieval::new(&self.target, limits.arc);
        let seed = self.request.seed;
        for_all(self.threads(), LIBRARY, |index, memory: &mut RetrievalMemory| {
            retrieval.candidates::<L>(&wanted, (seed, index as u64), memory)
        })
        .into_iter()
        .flatten()
        .collect()
    }

    /// A round on all islands.
    fn round_apart<L: Entry>(&mut self) {
        let mut islands = std::mem::take(&mut self.islands);
        let (objective, sound) = (self.objective(EVOLUTION), self.sound());
        let rules = self.rules(&objective, &sound);
        let shared: Vec<Mutex<&mut Island>> = islands.iter_mut().map(Mutex::new).collect();
        let counts = for_all(self.threads(), shared.len(), |index, (): &mut ()| {
            let Ok(mut island) = shared[index].lock() else { return 0 };
            let Island { candidates, random, breeder } = &mut **island;
            let before = breeder.evaluations();
            loop {
                let count = breeder.evaluations() - before;
                if count >= ROUND {
                    return count;
                }
                if let Some(child) = rules.breed::<L>(candidates, random, breeder) {
                    rules.insert(candidates, child, random);
                }
            }
        });
        drop(shared);
        self.evaluations += counts.into_iter().sum::<u64>();
        self.islands = islands;
    }

    /// A round of all candidates together: some children at a time.
    fn round_together<L: Entry>(&mut self) {
        for island in std::mem::take(&mut self.islands) {
            self.population.extend(island.candidates);
        }
        if self.population.is_empty() {
            return;
        }
        let mut population = std::mem::take(&mut self.population);
        let seed = self.random.bits();
        let (objective, sound) = (self.objective(EVOLUTION), self.sound());
        let rules = self.rules(&objective, &sound);
        let brood = for_all(self.threads(), BROOD, |index, (): &mut ()| {
            let mut breeder = self.breeders[index].lock().ok()?;
            let before = breeder.evaluations();
            let own = &mut Random::new(seed, index as u64);
            let child = rules.breed::<L>(&population, own, &mut breeder);
            Some((child, breeder.evaluations() - before))
        });
        let own = &mut Random::new(seed, BROOD as u64);
        let mut evaluations = 0;
        for (child, count) in brood.into_iter().flatten() {
            evaluations += count;
            if let Some(child) = child {
                rules.insert(&mut population, child, own);
            }
        }
        self.evaluations += evaluations;
        self.population = population;
    }

    fn finish_at<L: Entry>(&mut self, cancel: &AtomicBool) -> Vec<FoundLinkage> {
        let mut population = self.population.clone();
        population.extend(self.islands.iter().flat_map(|island| island.candidates.clone()));
        let (objective, sound) = (self.objective(EVOLUTION), self.sound());
        let rules = self.rules(&objective, &sound);
        rules.sort(&mut population);
        let objectives = POLISH.map(|fineness| self.objective(fineness));
        let polished = for_all(self.threads(), population.len(), |index, breeder: &mut Breeder| {
            let before = breeder.evaluations();
            let mut candidate = population[index].clone();
            for objective in &objectives {
                let mut finer = candidate.clone();
                breeder.refiner.evaluate::<L>(objective, &mut candidate);
                if cancel.load(Ordering::Relaxed) {
                    continue;
                }
                breeder.refiner.refine::<L>(objective, &mut finer, POLISH_ITERATIONS);
                if rules.is_sound::<L>(&finer, breeder) {
                    candidate = finer;
                }
            }
            (candidate, breeder.evaluations() - before)
        });
        let mut candidates = vec![];
        let mut evaluations = 0;
        for (candidate, count) in polished {
            evaluations += count;
            candidates.push(candidate);
        }
        rules.sort(&mut candidates);
        candidates.dedup_by(|a, b| (a.value - b.value).abs() < SAME * b.value);
        let found = candidates.into_iter().filter_map(|one| self.describe(one)).collect();
        self.evaluations += evaluations;
        found
    }

    /// A candidate in the user's units.
    fn describe(&self, candidate: Candidate) -> Option<FoundLinkage> {
        let Candidate { mut linkage, arc, value } = candidate;
        let scale = Vector::new(self.target.radius, 0.0);
        linkage.transform(scale, self.target.centre, false);
        Some(FoundLinkage { description: linkage.describe("P")?, arc: arc * linkage.sense, value })
    }
}
