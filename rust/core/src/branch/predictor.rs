//! The groups' unknowns along a branch: first guesses of the iteration.

use super::branch::Branch;
use super::hermite::small_rotation;
use super::knot::{InitialGuess, Knot, Taylor2};
use super::location::BranchLocation;
use super::tracer::BranchTracer;
use crate::math::lanes::{LANES, Mask, Real};
use crate::math::vector::Vector;
use crate::state::state::{Context, State};

impl Branch {
    /// Whether the groups of a state are on the branch's side of their folds.
    #[inline(always)]
    pub(crate) fn same_det_sign<R: Real, const G: usize>(
        &self,
        state: &State<R, G>,
        g: usize,
    ) -> R::Mask {
        let mut wrong_side = R::Mask::NONE;
        for (groups, &expected) in state.work.det_sign.iter().zip(&self.det_signs) {
            let positive = R::ZERO.lt(groups[g]);
            wrong_side = wrong_side.or(if expected { positive.not() } else { positive });
        }
        wrong_side.not()
    }

    /// The groups' unknowns at a parameter, traced again from the knot before: for cells whose
    /// polynomial is too rough.
    #[cold]
    pub(crate) fn retrace(&self, cx: &Context<'_>, state: &mut State, at: f64) -> Option<Vec<f64>> {
        let (reduced, _) = self.reduce(at);
        let left = self.at.partition_point(|&k| k <= reduced).checked_sub(1)?;
        let angles = &self.angles[left * self.gain.len()..][..self.gain.len()];
        let taylor = self.unknowns_at(left, self.at[left]);
        let start = InitialGuess { angles, taylor: &taylor };
        let cx = Context { signs: self.signs(at), ..*cx };
        let point = |at: f64, q: &mut [f64]| q[0] = at;
        let mut tracer =
            BranchTracer::new(&cx, state, &point, &[1.0], (self.at[left], 1.0), &start);
        tracer.advance(reduced);
        let is_there = |knot: &&Knot| knot.at >= reduced && !knot.taylor.is_empty();
        let last = tracer.knots.last().filter(is_there)?;
        Some(last.taylor.iter().map(|unknown| unknown[0]).collect())
    }

    /// The groups' unknowns at a parameter in the cell after a knot.
    pub(crate) fn unknowns_at(&self, knot: usize, reduced: f64) -> Vec<Taylor2> {
        let count = self.cells.len() / self.at.len().max(1);
        let step = reduced - self.at[knot];
        self.cells[knot * count..][..count]
            .iter()
            .map(|cell| [cell.value(step), 0.0, 0.0])
            .collect()
    }

    /// An unknown slide at a location, the `index`-th of `count` unknowns; 0 on an empty branch.
    #[inline(always)]
    pub(crate) fn slide<R: Real>(
        &self,
        location: &BranchLocation<R>,
        index: usize,
        count: usize,
    ) -> R {
        let Some(cell) = self.cell_at(location, index, count) else { return R::ZERO };
        cell.coefficients[0] + cell.change(location.reduced)
    }

    /// An unknown rotation at a location; 1 on an empty branch.
    #[inline(always)]
    pub(crate) fn rotation<R: Real>(
        &self,
        location: &BranchLocation<R>,
        index: usize,
        count: usize,
    ) -> Vector<R> {
        let Some(cell) = self.cell_at(location, index, count) else { return Vector::ONE };
        cell.unit * small_rotation(cell.change(location.reduced))
    }

    /// The cell of each lane; neighbouring positions are mostly in one cell or two.
    #[inline(always)]
    fn cell_at<R: Real>(
        &self,
        location: &BranchLocation<R>,
        index: usize,
        count: usize,
    ) -> Option<LaneCells<R>> {
        if self.cells.len() < self.at.len() * count {
            return None;
        }
        let cell = |knot: usize| self.cells.get(knot * count + index);
        if let Some([first, last]) = location.pair {
            let (a, b) = (cell(first)?, cell(last)?);
            let later = R::ZERO.lt(location.is_last);
            let of_lane = |a: f64, b: f64| R::select(later, R::splat(b), R::splat(a));
            let mut coefficients = [R::ZERO; 6];
            for (coefficient, (&a, &b)) in
                coefficients.iter_mut().zip(a.coefficients.iter().zip(&b.coefficients))
            {
                *coefficient = of_lane(a, b);
            }
            let unit = Vector::new(of_lane(a.unit.x, b.unit.x), of_lane(a.unit.y, b.unit.y));
            return Some(LaneCells {
                at: of_lane(self.at[first], self.at[last]),
                coefficients,
                unit,
            });
        }
        let mut cells = [cell(location.knot[0])?; LANES];
        for lane in 1..R::LANES {
            cells[lane] = cell(location.knot[lane])?;
        }
        let mut coefficients = [R::ZERO; 6];
        for (k, coefficient) in coefficients.iter_mut().enumerate() {
            *coefficient = R::from_lanes(|lane| cells[lane].coefficients[k]);
        }
        let x = R::from_lanes(|lane| cells[lane].unit.x);
        let y = R::from_lanes(|lane| cells[lane].unit.y);
        let at = R::from_lanes(|lane| self.at[location.knot[lane]]);
        Some(LaneCells { at, coefficients, unit: Vector::new(x, y) })
    }
}

/// A cell for each lane.
struct LaneCells<R> {
    /// The knot before it.
    at: R,
    coefficients: [R; 6],
    unit: Vector<R>,
}

impl<R: Real> LaneCells<R> {
    /// Change of the unknown since the knot.
    #[inline(always)]
    fn change(&self, reduced: R) -> R {
        let step = reduced - self.at;
        let mut sum = R::ZERO;
        for coefficient in self.coefficients[1..].iter().rev() {
            sum = sum * step + *coefficient;
        }
        sum * step
    }
}
