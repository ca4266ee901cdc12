//! The unknowns of groups along a way: where the iteration for a position begins.

use super::cell::{Cell, small_turn};
use super::state::{Context, State};
use super::track::{Spot, Track};
use super::walk::{Knot, Seed, Start, Walker};
use crate::lanes::{Mask, Real};
use crate::plane::Vector;

impl Track {
    /// Whether the groups of a state are on this way's side of their folds.
    #[inline(always)]
    pub(crate) fn bends_as<R: Real, const G: usize>(
        &self,
        state: &State<R, G>,
        g: usize,
    ) -> R::Mask {
        let mut other = R::Mask::NONE;
        for (groups, &bend) in state.bends.iter().zip(&self.bends) {
            let positive = R::ZERO.lt(groups[g]);
            other = other.or(if bend { positive.not() } else { positive });
        }
        other.not()
    }

    /// The unknowns of groups at a parameter, walked to from the knot before: where the
    /// polynomial between two knots is too rough.
    #[cold]
    pub(crate) fn approach(
        &self,
        cx: &Context<'_>,
        state: &mut State,
        at: f64,
    ) -> Option<Vec<f64>> {
        let (place, _) = self.reduced(at);
        let left = self.at.partition_point(|&k| k <= place).checked_sub(1)?;
        let angles = &self.angles[left * self.gain.len()..][..self.gain.len()];
        let seeds = self.seeds(left, self.at[left]);
        let start = Start { angles, seeds: &seeds };
        let cx = Context { signs: self.signs(at), ..*cx };
        let point = |at: f64, q: &mut [f64]| q[0] = at;
        let mut walker = Walker::new(&cx, state, &point, &[1.0], (self.at[left], 1.0), &start);
        walker.advance(place);
        let there = |knot: &&Knot| knot.at >= place && !knot.seeds.is_empty();
        let last = walker.knots.last().filter(there)?;
        Some(last.seeds.iter().map(|seed| seed[0]).collect())
    }

    /// The unknowns of groups at a place in the cell after a knot.
    pub(super) fn seeds(&self, knot: usize, place: f64) -> Vec<Seed> {
        let count = self.cells.len() / self.at.len().max(1);
        let step = place - self.at[knot];
        self.cells[knot * count..][..count].iter().map(|cell| [cell.at(step), 0.0, 0.0]).collect()
    }

    /// An unknown slide of the groups (of so many unknowns) at places.
    #[inline(always)]
    pub(crate) fn slide<R: Real>(&self, spot: &Spot<R>, place: usize, count: usize) -> R {
        if self.cells.len() < self.at.len() * count || self.at.is_empty() {
            // The way does not even begin: nothing on it is covered.
            return R::ZERO;
        }
        let (change, _) = self.change(spot, place, count);
        self.of_cells(spot, place, count, |cell| cell.coefficients[0]) + change
    }

    /// An unknown rotation likewise.
    #[inline(always)]
    pub(crate) fn rotation<R: Real>(
        &self,
        spot: &Spot<R>,
        place: usize,
        count: usize,
    ) -> Vector<R> {
        if self.cells.len() < self.at.len() * count || self.at.is_empty() {
            return Vector::ONE;
        }
        let (change, unit) = self.change(spot, place, count);
        unit * small_turn(change)
    }

    /// How far an unknown is from that at the knot before, and the unit vector there.
    #[inline(always)]
    fn change<R: Real>(&self, spot: &Spot<R>, place: usize, count: usize) -> (R, Vector<R>) {
        let at = if let Some([first, last]) = spot.pair {
            let later = R::ZERO.lt(spot.is_last);
            R::select(later, R::splat(self.at[last]), R::splat(self.at[first]))
        } else {
            R::from_lanes(|lane| self.at[spot.knot[lane]])
        };
        let step = spot.place - at;
        let mut sum = R::ZERO;
        for k in (1..6).rev() {
            sum = sum * step + self.of_cells(spot, place, count, |cell| cell.coefficients[k]);
        }
        let x = self.of_cells(spot, place, count, |cell| cell.unit.x);
        let y = self.of_cells(spot, place, count, |cell| cell.unit.y);
        (sum * step, Vector::new(x, y))
    }

    /// A number of each lane's cell; neighbouring positions are mostly in one cell or two.
    #[inline(always)]
    fn of_cells<R: Real>(
        &self,
        spot: &Spot<R>,
        place: usize,
        count: usize,
        of: impl Fn(&Cell) -> f64,
    ) -> R {
        let cell = |knot: usize| of(&self.cells[knot * count + place]);
        match spot.pair {
            Some([first, last]) => {
                R::select(R::ZERO.lt(spot.is_last), R::splat(cell(last)), R::splat(cell(first)))
            }
            None => R::from_lanes(|lane| cell(spot.knot[lane])),
        }
    }
}
