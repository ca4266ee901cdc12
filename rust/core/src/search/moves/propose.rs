//! Which change is made to a candidate: chosen at random, the best of a few where that is cheap.

use super::collapse::collapse;
use super::offset::offset;
use super::perturb::perturb;
use super::reattach::reattach;
use super::traced::new_traced;
use crate::batch::dispatch::Entry;
use crate::math::random::Random;
use crate::population::course::Course;
use crate::search::levenberg_marquardt::Refiner;
use crate::search::objective::{Candidate, Objective};

/// How many offsets and new dyads are compared, by what one step promises and by value.
const OFFSETS: usize = 12;
const DYADS: usize = 60;
/// How many collapses with offsets are compared, after so many iterations.
const COLLAPSES: usize = 4;
const COLLAPSE_ITERATIONS: usize = 4;
/// A kind of change.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Move {
    Offset,
    NewTraced,
    Perturb,
    Reattach,
    Collapse,
    CollapseAndOffset,
    Refine,
}

/// Shares of moves, in hundredths: while joints may be added, and where there are as many as allowed.
const GROWING: [(Move, f64); 7] = [
    (Move::Offset, 35.0),
    (Move::NewTraced, 10.0),
    (Move::Perturb, 20.0),
    (Move::Reattach, 10.0),
    (Move::Collapse, 10.0),
    (Move::CollapseAndOffset, 8.0),
    (Move::Refine, 7.0),
];
const GROWN: [(Move, f64); 5] = [
    (Move::Perturb, 40.0),
    (Move::CollapseAndOffset, 30.0),
    (Move::Reattach, 12.0),
    (Move::Collapse, 6.0),
    (Move::Refine, 12.0),
];

fn choose(moves: &[(Move, f64)], random: &mut Random) -> Move {
    let mut left = 100.0 * random.unit();
    for &(kind, share) in moves {
        left -= share;
        if left < 0.0 {
            return kind;
        }
    }
    Move::Refine
}

/// Proposes changes of candidates.
pub(crate) struct Proposer<'p, 'o> {
    pub refiner: &'p mut Refiner,
    pub objective: &'p Objective<'o>,
    pub random: &'p mut Random,
    /// The greatest number of joints.
    pub most_joints: usize,
    /// Positions of what is changed.
    pub course: &'p mut Course,
}

impl Proposer<'_, '_> {
    /// A changed candidate, not evaluated; `None` if the change led nowhere.
    pub(crate) fn propose<L: Entry>(&mut self, parent: &Candidate) -> Option<Candidate> {
        let can_grow = parent.linkage.len() + 1 < self.most_joints;
        let kind = choose(if can_grow { &GROWING } else { &GROWN }, self.random);
        let mut child = parent.clone();
        match kind {
            Move::Refine => {}
            Move::Perturb => perturb(&mut child.linkage, self.random),
            Move::Offset => return self.best_offset::<L>(parent, OFFSETS),
            Move::Reattach | Move::Collapse | Move::NewTraced | Move::CollapseAndOffset => {
                self.see_positions::<L>(parent);
                child.linkage = match kind {
                    Move::Reattach => reattach(&parent.linkage, self.course, self.random)?,
                    Move::Collapse => collapse(&parent.linkage, self.course, self.random)?,
                    Move::NewTraced => return self.best_traced::<L>(parent),
                    _ => return self.best_collapse::<L>(parent),
                };
            }
        }
        Some(child)
    }

    /// Solves the positions of a candidate.
    fn see_positions<L: Entry>(&mut self, parent: &Candidate) {
        self.objective.value::<L>(&parent.linkage, parent.arc, &mut self.refiner.work);
        self.course.clone_from(self.refiner.work.course());
    }

    /// The offset of which one step promises most.
    fn best_offset<L: Entry>(&mut self, parent: &Candidate, count: usize) -> Option<Candidate> {
        self.see_positions::<L>(parent);
        let mut best: Option<(f64, Candidate)> = None;
        for _ in 0..count {
            let Some(linkage) = offset(&parent.linkage, self.course, self.random, self.most_joints)
            else {
                continue;
            };
            let child = Candidate { linkage, ..*parent };
            let promise = self.refiner.promise::<L>(self.objective, &child);
            if best.as_ref().is_none_or(|(least, _)| promise < *least) {
                best = Some((promise, child));
            }
        }
        best.filter(|(promise, _)| promise.is_finite()).map(|(_, child)| child)
    }

    /// The best of some dyads whose apex is traced.
    fn best_traced<L: Entry>(&mut self, parent: &Candidate) -> Option<Candidate> {
        let mut best: Option<Candidate> = None;
        for _ in 0..DYADS {
            let Some(linkage) = new_traced(&parent.linkage, self.course, self.random) else {
                continue;
            };
            if linkage.len() > self.most_joints {
                continue;
            }
            let mut child = Candidate { linkage, ..*parent };
            self.refiner.evaluate::<L>(self.objective, &mut child);
            if best.as_ref().is_none_or(|best| child.value < best.value) {
                best = Some(child);
            }
        }
        best.filter(|child| child.value.is_finite())
    }

    /// The best of some collapses, each with an offset.
    fn best_collapse<L: Entry>(&mut self, parent: &Candidate) -> Option<Candidate> {
        let mut best: Option<Candidate> = None;
        let before = self.course.clone();
        for _ in 0..COLLAPSES {
            let Some(linkage) = collapse(&parent.linkage, &before, self.random) else { continue };
            let smaller = Candidate { linkage, ..*parent };
            let Some(mut child) = self.best_offset::<L>(&smaller, COLLAPSES) else { continue };
            self.refiner.refine::<L>(self.objective, &mut child, COLLAPSE_ITERATIONS);
            if best.as_ref().is_none_or(|best| child.value < best.value) {
                best = Some(child);
            }
        }
        best.filter(|child| child.value.is_finite())
    }
}
