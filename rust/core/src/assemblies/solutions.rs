//! All assemblies of one group at a position: the complex assemblies of random parameters, followed
//! along the straight path to the group's own (coefficient-parameter homotopy: A. P. Morgan and
//! A. J. Sommese, Appl. Math. Comput. 29 (1989) 123).
//!
//! For almost all parameters on the way the number of solutions is the same, so the ends of the paths
//! include every isolated solution. The set of ends must be closed under conjugation; where it is not, a
//! path has jumped to another, and all are followed again with shorter steps and from other parameters.

use super::compare::{conjugate, is_near, is_same};
use super::eliminant::by_elimination;
use super::fibre::Fibre;
use super::follow::{follow, refine};
use super::forms::GroupForms;
use super::homotopy::{Homotopy, Parameters};
use super::linear::inverse;
use super::paths::Tightness;
use thiserror::Error;

use crate::math::simd::Simd;
use crate::math::vector::Vector;

/// A path that stops this near its end leads to a multiple solution.
const NEAR_END: f64 = 1.0 - 1.0e-5;
/// Rounds of Newton's iteration there; each halves the distance.
const ROUNDS: usize = 30;
/// Newton's iteration has found a multiple solution if its last step, relative to the solution, is less
/// than this.
const SETTLED: f64 = 1.0e-7;
/// Solutions this large are at infinity.
const FAR: f64 = 1.0e6;
/// The same near the end of a path that cannot be followed to its end.
const LARGE: f64 = 1.0e2;
/// Most loops of a group (half the number of its links): the 924 paths of six take seconds, those of seven
/// a minute.
const MOST_LOOPS: usize = 6;
/// Seeds of the random parameters, tried until two agree on the number of assemblies.
const SEEDS: std::ops::Range<u64> = 0x6173_7375_7221_0001..0x6173_7375_7221_0009;

/// The data of a group that serve all its designs.
#[derive(Debug)]
pub(super) struct GroupFibres {
    pub forms: GroupForms,
    /// From two sets of parameters; empty if the group is beyond the method.
    pub fibres: Vec<Fibre>,
}

impl GroupFibres {
    pub(super) fn new(forms: GroupForms, drawing: &Parameters) -> Self {
        let mut earlier_fibres: Vec<Fibre> = Vec::new();
        let can_be_followed = forms.half() <= MOST_LOOPS;
        for seed in SEEDS.filter(|_| can_be_followed) {
            let Some(fibre) = Fibre::new(&forms, drawing, seed) else { continue };
            // The number of assemblies is a property of the group: the greatest, where two differ.
            let agrees = |earlier: &Fibre| earlier.points.len() == fibre.points.len();
            let has_all =
                earlier_fibres.iter().all(|earlier| earlier.points.len() <= fibre.points.len());
            if let Some(index) = earlier_fibres.iter().position(agrees).filter(|_| has_all) {
                return Self { forms, fibres: vec![earlier_fibres.swap_remove(index), fibre] };
            }
            earlier_fibres.push(fibre);
        }
        Self { forms, fibres: Vec::new() }
    }

    /// The number of complex assemblies of random dimensions.
    pub(super) fn count(&self) -> usize {
        self.fibres.first().map_or(0, |fibre| fibre.points.len())
    }

    /// All solutions with given parameters: by elimination, where that is certain to find them all.
    pub(super) fn quick_solutions(&self, parameters: &Parameters) -> Solutions {
        match by_elimination(&self.forms, parameters, self.count()) {
            Some(points) => Solutions::regular(points),
            None => self.solutions(parameters),
        }
    }

    /// All solutions with given parameters.
    pub(super) fn solutions(&self, parameters: &Parameters) -> Solutions {
        let mut best: Option<Solutions> = None;
        for tightness in [Tightness::LOOSE, Tightness::TIGHT] {
            for fibre in &self.fibres {
                let solutions = Solutions::of(&self.forms, fibre, parameters, tightness);
                if solutions.failures.is_empty() {
                    return solutions;
                }
                let fewer = |best: &Solutions| solutions.failures.len() < best.failures.len();
                if best.as_ref().is_none_or(fewer) {
                    best = Some(solutions);
                }
            }
        }
        best.unwrap_or_default()
    }
}

/// The end of a path that did not lead to its own solution.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum PathEnd {
    /// The solution goes to infinity: the group has fewer with these dimensions.
    #[error("a complex assembly is at infinity with these dimensions")]
    AtInfinity,
    /// Two paths or more end on one solution, at a dead point of the group.
    #[error("two assemblies meet")]
    Multiple,
    /// A single path ends where the group can move while its driver is locked: there are more
    /// assemblies than can be listed.
    #[error("it moves while its driver is locked, so it has more assemblies than can be listed")]
    Loose,
    /// The mirror image of a complex solution is missing: a path has jumped to another.
    #[error("the mirror image of a complex assembly was not found: one may be missing")]
    Unpaired,
    /// Newton's iteration of the real closures leads elsewhere.
    #[error("an assembly could not be confirmed by Newton's iteration: it is left out")]
    Unconfirmed,
    /// The path could not be followed beyond this part of it.
    #[error("a path could not be followed beyond {:.3} % of it: one assembly may be missing", 100.0 * at)]
    Stuck {
        /// 0 to 1.
        at: f64,
    },
}

/// A solution where paths end.
#[derive(Debug, Clone)]
pub(super) struct Solution {
    /// Components of x, then of y.
    pub point: Vec<Vector>,
    /// The paths that end there.
    paths: usize,
    /// Whether it is a multiple one: the equations are singular.
    pub is_multiple: bool,
}

/// The ends of a group's paths.
#[derive(Debug, Clone, Default)]
pub(super) struct Solutions {
    list: Vec<Solution>,
    pub failures: Vec<PathEnd>,
}

impl Solutions {
    /// Solutions that are all different.
    fn regular(points: Vec<Vec<Vector>>) -> Self {
        let solution = |point| Solution { point, paths: 1, is_multiple: false };
        Self { list: points.into_iter().map(solution).collect(), failures: Vec::new() }
    }

    fn of(
        forms: &GroupForms,
        fibre: &Fibre,
        parameters: &Parameters,
        tightness: Tightness,
    ) -> Self {
        let homotopy = Homotopy::between(forms, &fibre.parameters, parameters);
        let ends = follow(&homotopy, &fibre.points, tightness, 1.0, Simd::default());
        let mut solutions = Self::default();
        for (point, &at) in ends.points.into_iter().zip(&ends.at) {
            let size = point.iter().map(|x| x.norm()).fold(0.0, f64::max);
            if at >= 1.0 && size < FAR {
                solutions.add(point, false);
            } else if size >= FAR {
                solutions.failures.push(PathEnd::AtInfinity);
            } else if at > NEAR_END {
                let refined = refine(&homotopy, &[point], ROUNDS);
                let is_settled = refined.last[0] < SETTLED;
                match refined.points.into_iter().next() {
                    Some(point) if is_settled && point.iter().all(|x| x.norm() < FAR) => {
                        solutions.add(point, true);
                    }
                    // On the way to infinity a solution is already large.
                    _ if size > LARGE => solutions.failures.push(PathEnd::AtInfinity),
                    _ => solutions.failures.push(PathEnd::Loose),
                }
            } else {
                solutions.failures.push(PathEnd::Stuck { at });
            }
        }
        let list = &solutions.list;
        let has_conjugate = |solution: &&Solution| {
            let mirrored = conjugate(&solution.point);
            list.iter().any(|candidate| is_near(&mirrored, &candidate.point))
        };
        let unpaired = list.iter().filter(|solution| !has_conjugate(solution)).count();
        let single = |solution: &&Solution| solution.is_multiple && solution.paths == 1;
        let loose = list.iter().filter(single).count();
        solutions.failures.extend(std::iter::repeat_n(PathEnd::Unpaired, unpaired));
        solutions.failures.extend(std::iter::repeat_n(PathEnd::Loose, loose));
        solutions
    }

    /// Adds the end of a path; on a multiple solution it is less accurate.
    fn add(&mut self, point: Vec<Vector>, is_multiple: bool) {
        let is_known = |candidate: &&mut Solution| {
            if is_multiple {
                is_near(&point, &candidate.point)
            } else {
                is_same(&point, &candidate.point)
            }
        };
        match self.list.iter_mut().find(is_known) {
            Some(solution) => {
                solution.paths += 1;
                solution.is_multiple = true;
                self.failures.push(PathEnd::Multiple);
            }
            None => self.list.push(Solution { point, paths: 1, is_multiple }),
        }
    }

    /// The solutions that may be real.
    pub(super) fn real(&self) -> impl Iterator<Item = &Solution> {
        self.list.iter().filter(|solution| is_near(&solution.point, &conjugate(&solution.point)))
    }
}

/// Values of a group's unknowns, rad or in sizes, at a real solution.
pub(super) fn unknowns(forms: &GroupForms, parameters: &Parameters, point: &[Vector]) -> Vec<f64> {
    let value = |(index, guide): (usize, &Option<(usize, usize)>)| match *guide {
        None => point[index].angle(),
        Some((edge, turn)) => {
            let direction = parameters[forms.edges + edge][0];
            let turned = if turn == 0 { direction } else { direction * point[turn - 1] };
            (point[index] * inverse(turned)).x
        }
    };
    forms.guides.iter().enumerate().map(value).collect()
}
