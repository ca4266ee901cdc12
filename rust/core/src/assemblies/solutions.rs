//! All assemblies of one group at a position: the complex assemblies of random parameters, followed
//! along the straight path to the group's own (coefficient-parameter homotopy: A. P. Morgan and
//! A. J. Sommese, Appl. Math. Comput. 29 (1989) 123).
//!
//! For almost all parameters on the way the number of solutions is the same, so none is left out:
//! the ends of the paths include every isolated solution. The set of ends must be closed under
//! conjugation; where it is not, a path has passed to another, and all are followed again with
//! shorter steps and from other parameters.

use super::fibre::{Fibre, is_same};
use super::follow::{follow, refine};
use super::forms::GroupForms;
use super::homotopy::{Homotopy, Parameters};
use super::linear::inverse;
use super::paths::Tightness;
use crate::math::simd::Simd;
use crate::math::vector::Vector;

/// A path that stops this near its end leads to a multiple solution.
const NEAR_END: f64 = 1.0 - 1.0e-5;
/// Newton's rounds there, each of which halves the distance.
const ROUNDS: usize = 30;
/// A last step, relative to the solution, of a multiple one that was found.
const SETTLED: f64 = 1.0e-7;
/// Solutions this large are on their way to infinity.
const FAR: f64 = 1.0e6;
/// How near to its own conjugate (relative to its size) a solution may be real.
const REAL: f64 = 1.0e-6;
/// Seeds of the random parameters.
const SEEDS: [u64; 2] = [0x6173_7375_7221_0001, 0x6173_7375_7221_0002];

/// What is known of a group once for all its designs.
#[derive(Debug)]
pub(super) struct GroupFibres {
    pub forms: GroupForms,
    /// From several parameters; none if the group is beyond the method.
    pub fibres: Vec<Fibre>,
}

impl GroupFibres {
    pub(super) fn new(forms: GroupForms) -> Self {
        let fibres: Vec<Fibre> =
            SEEDS.iter().filter_map(|&seed| Fibre::new(&forms, seed)).collect();
        // Their numbers are a property of the group.
        let agree = fibres.windows(2).all(|two| two[0].points.len() == two[1].points.len());
        Self { forms, fibres: if agree { fibres } else { Vec::new() } }
    }

    /// The number of complex assemblies of random dimensions.
    pub(super) fn count(&self) -> usize {
        self.fibres.first().map_or(0, |fibre| fibre.points.len())
    }

    /// All solutions with given parameters.
    pub(super) fn solutions(&self, parameters: &Parameters) -> Solutions {
        let mut best: Option<Solutions> = None;
        for tightness in [Tightness::LOOSE, Tightness::TIGHT] {
            for fibre in &self.fibres {
                let found = Solutions::of(&self.forms, fibre, parameters, tightness);
                if found.doubts() == 0 {
                    return found;
                }
                if best.as_ref().is_none_or(|best| found.doubts() < best.doubts()) {
                    best = Some(found);
                }
            }
        }
        best.unwrap_or_default()
    }
}

/// How a path ended that found no regular solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PathEnd {
    /// The solution goes to infinity: the group has fewer with these dimensions.
    AtInfinity,
    /// Two paths or more end on one solution.
    Multiple,
    /// Newton's iteration of the real closures leads elsewhere.
    Unconfirmed,
    /// The path could not be followed beyond this part of it.
    Stuck {
        /// 0 to 1.
        at: f64,
    },
}

/// The ends of a group's paths.
#[derive(Debug, Clone, Default)]
pub(super) struct Solutions {
    /// Different finite solutions; whether several paths end on it.
    pub points: Vec<(Vec<Vector>, bool)>,
    pub failures: Vec<PathEnd>,
    /// Solutions whose conjugate is missing.
    pub unpaired: usize,
}

impl Solutions {
    fn of(
        forms: &GroupForms,
        fibre: &Fibre,
        parameters: &Parameters,
        tightness: Tightness,
    ) -> Self {
        let homotopy = Homotopy::between(forms, &fibre.parameters, parameters);
        let ends = follow(&homotopy, &fibre.points, tightness, 1.0, Simd::best());
        let mut solutions = Self::default();
        for (point, &at) in ends.points.into_iter().zip(&ends.at) {
            let size = point.iter().map(|x| x.norm()).fold(0.0, f64::max);
            if at >= 1.0 && size < FAR {
                solutions.add(point);
            } else if size >= FAR {
                solutions.failures.push(PathEnd::AtInfinity);
            } else if at > NEAR_END {
                let refined = refine(&homotopy, &[point], ROUNDS);
                let is_settled = refined.last[0] < SETTLED;
                match refined.points.into_iter().next() {
                    Some(point) if is_settled && point.iter().all(|x| x.norm() < FAR) => {
                        solutions.add_multiple(point);
                    }
                    _ => solutions.failures.push(PathEnd::AtInfinity),
                }
            } else {
                solutions.failures.push(PathEnd::Stuck { at });
            }
        }
        let points = &solutions.points;
        let has_conjugate = |point: &[Vector]| {
            let mirrored = conjugate(point);
            points.iter().any(|(other, _)| is_near(&mirrored, other))
        };
        solutions.unpaired = points.iter().filter(|(point, _)| !has_conjugate(point)).count();
        solutions
    }

    /// Adds the regular end of a path.
    fn add(&mut self, point: Vec<Vector>) {
        match self.points.iter_mut().find(|(other, _)| is_same(&point, other)) {
            Some((_, is_multiple)) => {
                *is_multiple = true;
                self.failures.push(PathEnd::Multiple);
            }
            None => self.points.push((point, false)),
        }
    }

    /// Adds the end of a path on a multiple solution, which is less accurate.
    fn add_multiple(&mut self, point: Vec<Vector>) {
        match self.points.iter_mut().find(|(other, _)| is_near(&point, other)) {
            Some((_, is_multiple)) => *is_multiple = true,
            None => self.points.push((point, true)),
        }
        self.failures.push(PathEnd::Multiple);
    }

    /// How many ends are not accounted for.
    fn doubts(&self) -> usize {
        self.failures.len() + self.unpaired
    }

    /// The solutions that may be real.
    pub(super) fn real(&self) -> impl Iterator<Item = &(Vec<Vector>, bool)> {
        self.points.iter().filter(|(point, _)| is_near(point, &conjugate(point)))
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

/// Conj Y, conj X: the mirror image of a solution.
fn conjugate(point: &[Vector]) -> Vec<Vector> {
    let (x, y) = point.split_at(point.len() / 2);
    y.iter().chain(x).map(|x| x.conj()).collect()
}

fn is_near(a: &[Vector], b: &[Vector]) -> bool {
    let difference: f64 = a.iter().zip(b).map(|(&a, &b)| (a - b).norm2()).sum();
    let size: f64 = 1.0 + a.iter().map(|a| a.norm2()).sum::<f64>();
    difference <= REAL * REAL * size
}
