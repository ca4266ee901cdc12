//! Evolution of a few linkages: changes, each refined, take the place of those that are worse.

use super::levenberg_marquardt::Refiner;
use super::moves::propose::Proposer;
use super::objective::{Candidate, Objective};
use crate::batch::dispatch::Entry;
use crate::math::random::Random;
use crate::population::course::Course;

/// Iterations in the three stages of a child, and how much worse than its parent it may be after the
/// first two.
const ITERATIONS: [usize; 3] = [12, 25, 25];
const WORSE: [f64; 2] = [2.0, 1.2];
/// How often the better of two is the parent.
const TOURNAMENT: f64 = 0.75;
/// How often a child that is better than its parent takes the parent's place, and not that of the worst.
const REPLACES_PARENT: f64 = 0.7;

/// What all children of a search share.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rules<'o> {
    pub objective: &'o Objective<'o>,
    /// The same at many positions: whether what is found keeps its limits there.
    pub sound: &'o Objective<'o>,
    pub most_joints: usize,
    /// By which part a further joint must lower the value.
    pub joint_price: f64,
}

/// Memory of a thread.
#[derive(Debug, Default)]
pub(super) struct Breeder {
    pub refiner: Refiner,
    course: Course,
    sound: Refiner,
}

impl Breeder {
    /// Objectives that were evaluated in it.
    pub(super) fn evaluations(&self) -> u64 {
        self.refiner.work.evaluations
    }
}

impl Rules<'_> {
    /// Puts the best first.
    pub(super) fn sort(&self, candidates: &mut [Candidate]) {
        candidates.sort_by(|a, b| self.score(a).total_cmp(&self.score(b)));
    }

    /// What candidates are ranked by.
    pub(super) fn score(&self, candidate: &Candidate) -> f64 {
        candidate.value * libm::exp(self.joint_price * candidate.linkage.len() as f64)
    }

    /// A child of one of the candidates, refined and sound, with its parent's index.
    pub(super) fn breed<L: Entry>(
        &self,
        population: &[Candidate],
        random: &mut Random,
        breeder: &mut Breeder,
    ) -> Option<(usize, Candidate)> {
        let mut index = random.index(population.len());
        if random.happens(TOURNAMENT) {
            let other = random.index(population.len());
            if self.score(&population[other]) < self.score(&population[index]) {
                index = other;
            }
        }
        let parent = &population[index];
        let Breeder { refiner, course, .. } = breeder;
        let (objective, most_joints) = (self.objective, self.most_joints);
        let mut proposer = Proposer { refiner, objective, random, most_joints, course };
        let mut child = proposer.propose::<L>(parent)?;
        if child.linkage.len() > most_joints {
            return None;
        }
        let best = population.iter().map(|one| self.score(one)).fold(f64::INFINITY, f64::min);
        for (stage, &iterations) in ITERATIONS.iter().enumerate() {
            breeder.refiner.refine::<L>(objective, &mut child, iterations);
            let score = self.score(&child);
            let most = WORSE.get(stage).map_or(f64::INFINITY, |times| times * self.score(parent));
            if !child.value.is_finite() || (score > most && (stage == 0 || score > best)) {
                return None;
            }
        }
        self.is_sound::<L>(&child, breeder).then_some((index, child))
    }

    /// Whether a candidate keeps its limits at many positions.
    pub(super) fn is_sound<L: Entry>(&self, candidate: &Candidate, breeder: &mut Breeder) -> bool {
        let work = &mut breeder.sound.work;
        let value = self.sound.value::<L>(&candidate.linkage, candidate.arc, work);
        value.is_finite() && candidate.linkage.links().is_some()
    }

    /// Gives a child the place of the candidate of its structure, if there is one, else that of its parent or of the
    /// worst, if it is better: so that no structure crowds out the others.
    pub(super) fn insert(
        &self,
        population: &mut [Candidate],
        (parent, child): (usize, Candidate),
        random: &mut Random,
    ) {
        let is_better = |index: usize| self.score(&child) < self.score(&population[index]);
        let is_same = |one: &Candidate| one.linkage.placements == child.linkage.placements;
        let place = if let Some(own) = population.iter().position(is_same) {
            own
        } else if is_better(parent) && random.happens(REPLACES_PARENT) {
            parent
        } else {
            let by_score = |a: &usize, b: &usize| {
                self.score(&population[*a]).total_cmp(&self.score(&population[*b]))
            };
            let Some(worst) = (0..population.len()).max_by(by_score) else { return };
            worst
        };
        if is_better(place) {
            population[place] = child;
        }
    }
}
