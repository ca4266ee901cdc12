//! All frictions that agree with the law at a position.

use nalgebra::{DMatrix, DVector};

use super::problem::{FrictionProblem, Law};
use super::quadrics::{MAX_UNKNOWNS, Quadrics};

/// Most paths that are followed for one block of pairs, as a power of 2: half a second.
pub(super) const MAX_PATHS: usize = 12;
/// The greatest imaginary part of a real solution, relative to its size: a double solution is known only
/// to the root of rounding.
const IMAGINARY: f64 = 1.0e-4;
/// Greatest distance of a solution from the end of its path, and of two results that are the same solution.
const NEAR: f64 = 1.0e-3;
const SAME: f64 = 1.0e-9;

/// A block of pairs with more paths than are followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct TooManyPaths;

impl FrictionProblem<'_> {
    /// All solutions: first the one to which the path from no friction leads, then the others by their loss of
    /// power. Empty: locked.
    pub(crate) fn solve(&self) -> Result<Vec<Vec<f64>>, TooManyPaths> {
        if self.pairs.is_empty() {
            return Ok(vec![Vec::new()]);
        }
        if self.is_contraction()
            && let Some(only) = self.only()
        {
            return Ok(vec![only]);
        }
        let mut all = self.all()?;
        all.sort_by(|a, b| self.loss(a).total_cmp(&self.loss(b)));
        let (reached, end) = self.follow(1.0);
        if reached >= 1.0 {
            match all.iter().position(|solution| is_same(solution, &end)) {
                Some(index) => all[..=index].rotate_right(1),
                None => all.insert(0, end),
            }
        }
        Ok(all)
    }

    /// The first of all solutions; the others are searched for only where the path from no friction ends.
    pub(crate) fn first(&self) -> Result<Option<Vec<f64>>, TooManyPaths> {
        if self.pairs.is_empty() {
            return Ok(Some(Vec::new()));
        }
        if self.is_contraction()
            && let Some(only) = self.only()
        {
            return Ok(Some(only));
        }
        let (reached, end) = self.follow(1.0);
        if reached >= 1.0 {
            return Ok(Some(end));
        }
        let all = self.all()?;
        Ok(all.into_iter().min_by(|a, b| self.loss(a).total_cmp(&self.loss(b))))
    }

    /// The factor of all coefficients, at most `most`, at which the solution that began without friction ends.
    pub(crate) fn safety(&self, most: f64) -> f64 {
        // Where nothing slides, friction takes no part however strong it is.
        if self.pairs.is_empty() { most } else { self.follow(most).0 }
    }

    /// The power that the friction takes.
    pub(crate) fn loss(&self, friction: &[f64]) -> f64 {
        self.pairs.iter().zip(friction).map(|(pair, friction)| friction.abs() * pair.rate).sum()
    }

    /// All solutions, block after block.
    fn all(&self) -> Result<Vec<Vec<f64>>, TooManyPaths> {
        let mut all = vec![vec![0.0; self.pairs.len()]];
        for block in self.blocks() {
            let mut longer = Vec::new();
            for earlier in &all {
                for block_solution in self.block(&block, earlier).of_block()? {
                    let mut solution = earlier.clone();
                    for (&pair, friction) in block.iter().zip(block_solution) {
                        solution[pair] = friction;
                    }
                    longer.push(solution);
                }
            }
            all = longer;
        }
        Ok(all)
    }

    /// All solutions of one block.
    fn of_block(&self) -> Result<Vec<Vec<f64>>, TooManyPaths> {
        let [only] = &self.pairs[..] else { return self.of_coupled() };
        if only.slopes[0] == [0.0; 2] {
            return Ok(vec![vec![-only.sense * only.law.size(only.base)]]);
        }
        self.of_coupled()
    }

    fn of_coupled(&self) -> Result<Vec<Vec<f64>>, TooManyPaths> {
        let n = self.pairs.len();
        let size = self.size();
        if size == 0.0 {
            // Without a force there is no friction.
            return Ok(vec![vec![0.0; n]]);
        }
        if self.is_contraction()
            && let Some(only) = self.only()
        {
            return Ok(vec![only]);
        }
        let (journals, guides): (Vec<usize>, Vec<usize>) =
            (0..n).partition(|&pair| matches!(self.pairs[pair].law, Law::Journal { .. }));
        let faces: Vec<_> = guides.iter().map(|&guide| self.pairs[guide].law.faces()).collect();
        let choices: usize = faces.iter().map(Vec::len).product();
        if journals.len() + 2 * guides.len() > MAX_PATHS || journals.len() > MAX_UNKNOWNS {
            return Err(TooManyPaths);
        }
        let mut solutions: Vec<Vec<f64>> = Vec::new();
        for mut choice in 0..choices {
            if self.is_cancelled() {
                break;
            }
            let chosen: Vec<_> = faces
                .iter()
                .map(|faces| {
                    let face = faces[choice % faces.len()];
                    choice /= faces.len();
                    face
                })
                .collect();
            for start in self.with_faces(&journals, &guides, &chosen) {
                self.add(&start, &mut solutions);
            }
        }
        Ok(solutions)
    }

    /// Adds the solution near a start if it exists and is new.
    fn add(&self, start: &[f64], solutions: &mut Vec<Vec<f64>>) {
        let Some(solution) = self.newton(start, 1.0) else { return };
        let size = amax(&solution).max(amax(start));
        let apart = start.iter().zip(&solution).all(|(a, b)| (a - b).abs() <= NEAR * size);
        if apart && !solutions.iter().any(|earlier| is_same(earlier, &solution)) {
            solutions.push(solution);
        }
    }

    /// Starts near all solutions if each guide has the given linear law.
    fn with_faces(
        &self,
        journals: &[usize],
        guides: &[usize],
        faces: &[[f64; 2]],
    ) -> Vec<Vec<f64>> {
        // The frictions on the guides, linear in 1 and the sizes u of the forces on the journals: those
        // have frictions −s ρ u.
        let (g, j) = (guides.len(), journals.len());
        let mut matrix = DMatrix::identity(g, g);
        let mut right = DMatrix::zeros(g, j + 1);
        let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
        let per_size = |journal: usize| -self.pairs[journal].sense * self.circle(journal);
        for (row, (&guide, &face)) in guides.iter().zip(faces).enumerate() {
            let pair = &self.pairs[guide];
            for (column, &on) in guides.iter().enumerate() {
                matrix[(row, column)] += pair.sense * dot(face, pair.slopes[on]);
            }
            right[(row, 0)] = -pair.sense * dot(face, pair.base);
            for (column, &on) in journals.iter().enumerate() {
                right[(row, column + 1)] = -pair.sense * dot(face, pair.slopes[on]) * per_size(on);
            }
        }
        // The library's decomposition has no empty matrices.
        let solved = if g == 0 { Some(right) } else { matrix.lu().solve(&right) };
        let Some(on_guides) = solved else { return Vec::new() };
        if j == 0 {
            let mut friction = vec![0.0; self.pairs.len()];
            for (row, &guide) in guides.iter().enumerate() {
                friction[guide] = on_guides[(row, 0)];
            }
            return vec![friction];
        }
        // In units of the greatest force, so that all numbers are near 1.
        let unit = journals
            .iter()
            .chain(guides)
            .map(|&pair| amax(&self.pairs[pair].base))
            .fold(0.0, f64::max);
        let form = |journal: usize, axis: usize| -> Vec<f64> {
            let pair = &self.pairs[journal];
            (0..=j)
                .map(|column| {
                    let mut factor = if column == 0 { pair.base[axis] / unit } else { 0.0 };
                    if let Some(&on) = column.checked_sub(1).and_then(|index| journals.get(index)) {
                        factor += pair.slopes[on][axis] * per_size(on);
                    }
                    for (row, &guide) in guides.iter().enumerate() {
                        let friction = on_guides[(row, column)];
                        let friction = if column == 0 { friction / unit } else { friction };
                        factor += pair.slopes[guide][axis] * friction;
                    }
                    factor
                })
                .collect()
        };
        let forms = journals.iter().map(|&journal| [form(journal, 0), form(journal, 1)]).collect();
        let mut starts = Vec::new();
        for sizes in (Quadrics { forms }).solutions(|| !self.is_cancelled()) {
            let is_real = sizes.iter().all(|u| u.im.abs() <= IMAGINARY * (1.0 + u.norm()));
            if !is_real {
                continue;
            }
            let sizes = DVector::from_iterator(j, sizes.iter().map(|u| u.re * unit));
            let mut friction = vec![0.0; self.pairs.len()];
            for (&journal, size) in journals.iter().zip(sizes.iter()) {
                friction[journal] = per_size(journal) * size;
            }
            for (row, &guide) in guides.iter().enumerate() {
                let mut sum = on_guides[(row, 0)];
                for (column, size) in sizes.iter().enumerate() {
                    sum += on_guides[(row, column + 1)] * size;
                }
                friction[guide] = sum;
            }
            starts.push(friction);
        }
        starts
    }

    /// The radius of a journal's friction circle.
    fn circle(&self, pair: usize) -> f64 {
        match self.pairs[pair].law {
            Law::Journal { circle } => circle,
            Law::Guide { .. } => 0.0,
        }
    }
}

fn amax(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |most, number| most.max(number.abs()))
}

fn is_same(left: &[f64], right: &[f64]) -> bool {
    let size = amax(left).max(amax(right));
    left.iter().zip(right).all(|(a, b)| (a - b).abs() <= SAME * size)
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicBool;

    use super::*;
    use crate::dynamics::friction::problem::SlidingPair;

    /// Numbers from −1 to 1, by the generator of Knuth's MMIX.
    struct Random(u64);

    impl Random {
        fn next(&mut self) -> f64 {
            self.0 = self
                .0
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        }
    }

    /// Journals, then guides, that all depend on one another as strongly as `feedback`.
    fn problem(
        random: &mut Random,
        [journals, guides]: [usize; 2],
        feedback: f64,
    ) -> FrictionProblem<'static> {
        let n = journals + guides;
        let pairs = (0..n).map(|pair| SlidingPair {
            law: if pair < journals {
                Law::Journal { circle: 0.1 + 0.05 * random.next() }
            } else {
                Law::Guide { coefficient: 0.2, half_length: 0.5 + 0.3 * random.next() }
            },
            sense: if random.next() > 0.0 { 1.0 } else { -1.0 },
            rate: 1.0,
            base: [100.0 * random.next(), 100.0 * random.next()],
            slopes: (0..n).map(|_| [feedback * random.next(), feedback * random.next()]).collect(),
        });
        FrictionProblem { pairs: pairs.collect(), cancel: None }
    }

    #[test]
    fn where_nothing_slides_friction_never_locks() {
        let nothing = FrictionProblem::default();
        assert_eq!(nothing.safety(1e6), 1e6);
        assert_eq!(nothing.solve(), Ok(vec![Vec::new()]));
    }

    #[test]
    fn a_path_ends_where_the_law_drowns_in_rounding() {
        // Beside a singular position: normal forces are 1e8 times greater than the frictions.
        let guide = |[coefficient, half_length]: [f64; 2], sense, base, slopes: [[f64; 2]; 3]| {
            let (law, slopes) = (Law::Guide { coefficient, half_length }, slopes.to_vec());
            SlidingPair { law, sense, rate: 1.0, base, slopes }
        };
        let pairs = vec![
            guide(
                [0.014_335_723_934_473_008, 0.487_763_657_020_098_2],
                -1.0,
                [-18_956_707.311_518_88, -198_053_629.169_717_64],
                [
                    [0.160_407_692_097_974_35, 1.675_884_236_651_251],
                    [0.0; 2],
                    [-1.012_783_603_581_830_5, -0.952_469_903_379_340_1],
                ],
            ),
            guide(
                [0.017_311_613_656_474_222, 0.375_769_397_653_465_45],
                -1.0,
                [1.190_716_382_995_337_8e16, 136_768_321.862_583_7],
                [
                    [-4_827_481.003_133_687, 0.0],
                    [-16_310_563.301_798_245, 0.0],
                    [16_363_132.508_705_877, 0.0],
                ],
            ),
            guide(
                [0.022_002_664_786_105_977, 0.216_759_229_161_221_12],
                1.0,
                [-119_689_334.063_893_94, 198_053_629.169_717_64],
                [
                    [1.012_783_603_581_830_5, -1.675_884_236_651_251],
                    [0.0; 2],
                    [-0.160_407_692_097_974_4, 0.952_469_903_379_340_1],
                ],
            ),
        ];
        let problem = FrictionProblem { pairs, cancel: None };
        let safety = problem.safety(1e6);
        assert!(safety > 1.0 && safety < 1e6, "{safety}");
        let cancelled = AtomicBool::new(true);
        let problem = FrictionProblem { cancel: Some(&cancelled), ..problem };
        assert_eq!(problem.safety(1e6), 0.0);
    }

    #[test]
    fn the_first_solution_is_the_first_of_all() {
        let mut random = Random(11);
        let mut several = 0;
        for case in 0..300 {
            let kinds = [[3, 0], [2, 1], [0, 2]][case % 3];
            let problem = problem(&mut random, kinds, 3.0 + (case % 5) as f64 * 3.0);
            let (first, all) = (problem.first(), problem.solve());
            let (Ok(first), Ok(all)) = (first, all) else { panic!("too many paths") };
            several += usize::from(all.len() > 1);
            match (first, all.first()) {
                (None, None) => {}
                (Some(first), Some(listed)) => {
                    assert!(is_same(&first, listed), "{first:?} {listed:?}");
                }
                (first, listed) => panic!("{first:?} {listed:?}"),
            }
        }
        assert!(several > 5, "{several}");
    }

    #[test]
    fn none_is_missed_that_many_starts_find() {
        let mut random = Random(7);
        let (mut several, mut none) = (0, 0);
        for (count, kinds) in [(60, [3, 0]), (40, [2, 1]), (20, [0, 2]), (10, [4, 1])] {
            for case in 0..count {
                let problem = problem(&mut random, kinds, 3.0 + f64::from(case % 5) * 3.0);
                let all = problem.solve().unwrap_or_else(|_| panic!("too many"));
                for solution in &all {
                    let missed = problem.residual(solution, 1.0).amax();
                    assert!(missed <= 1e-11 * (amax(solution) + problem.size()), "{missed}");
                }
                several += usize::from(all.len() > 1);
                none += usize::from(all.is_empty());
                for _ in 0..300 {
                    let wide = 10.0_f64.powf(2.0 + 2.0 * random.next());
                    let start: Vec<f64> =
                        problem.pairs.iter().map(|_| wide * random.next()).collect();
                    let Some(root) = problem.newton(&start, 1.0) else { continue };
                    let is_listed = all.iter().any(|solution| is_same(solution, &root));
                    assert!(is_listed, "{kinds:?} {case}: {root:?} is not one of {all:?}");
                }
            }
        }
        assert!(several > 5 && none > 10, "{several} {none}");
    }

    #[test]
    fn a_contraction_has_one_solution() {
        let mut random = Random(3);
        for _ in 0..200 {
            let problem = problem(&mut random, [2, 1], 1.0);
            assert!(problem.is_contraction());
            let all = problem.all().unwrap_or_else(|_| panic!("too many"));
            assert!(all.len() == 1 && problem.safety(1.0) == 1.0);
            let only = problem.solve().unwrap_or_else(|_| panic!("too many"));
            assert!(is_same(&only[0], &problem.follow(1.0).1));
        }
    }
}
