//! The positions of a packed linkage over a turn of its crank.

use std::f64::consts::TAU;

use super::packed::{PackedLinkage, Placement};
use crate::batch::dispatch::{Entry, Task};
use crate::math::lanes::{LANES, Real};
use crate::math::trig;
use crate::math::vector::Vector;

/// Crank angles, counted in the sense in which the crank turns.
#[derive(Debug, Clone, Default)]
pub(crate) struct Angles {
    pub cos: Vec<f64>,
    pub sin: Vec<f64>,
    /// Derivatives of the angles by the arc: on it the part at which a position lies.
    pub rates: Vec<f64>,
    /// Number of positions on the arc, which come first; the others are on the rest of the turn.
    pub arc: usize,
}

impl Angles {
    /// `count` positions on an arc with both ends (on a whole turn: without its end), and `rest` on the rest of
    /// the turn, numbers that fill registers.
    pub(crate) fn set<L: Entry>(
        &mut self,
        arc: f64,
        is_closed: bool,
        (count, rest): (usize, usize),
    ) {
        debug_assert!(count % LANES == 0 && rest % LANES == 0, "{count} and {rest} positions");
        let rest = if is_closed { 0 } else { rest };
        let steps = if is_closed { count } else { count - 1 } as f64;
        self.arc = count;
        let parts = (0..count).map(|t| t as f64 / steps);
        let beyond = (0..rest).map(|t| (t + 1) as f64 / (rest + 1) as f64);
        self.rates.clear();
        self.sin.clear();
        for (angle, rate) in parts
            .map(|part| (arc * part, part))
            .chain(beyond.map(|x| (arc + (TAU - arc) * x, 1.0 - x)))
        {
            self.rates.push(rate);
            self.sin.push(angle);
        }
        self.cos.resize(self.sin.len(), 0.0);
        L::call(&mut Turns { angles: self });
    }

    /// The number of positions.
    pub(crate) fn len(&self) -> usize {
        self.cos.len()
    }
}

/// Puts sines in the place of the angles, and cosines beside them.
struct Turns<'t> {
    angles: &'t mut Angles,
}

impl<R: Real> Task<R> for Turns<'_> {
    #[inline(always)]
    fn run(&mut self) {
        for first in (0..self.angles.sin.len()).step_by(R::LANES) {
            let (sin, cos) = trig::sin_cos(R::read(&self.angles.sin[first..]));
            sin.put(&mut self.angles.sin[first..]);
            cos.put(&mut self.angles.cos[first..]);
        }
    }
}

/// The positions of all joints.
#[derive(Debug, Clone, Default)]
pub(crate) struct Course {
    /// x at all positions and y at all positions, joint after joint.
    at: Vec<f64>,
    /// For each joint of a dyad the least and greatest square of the distance of its ends.
    chords: Vec<[f64; 2]>,
    /// For each joint the greatest square of its distance from the origin.
    reaches: Vec<f64>,
    positions: usize,
}

impl Course {
    /// The number of positions.
    pub(crate) fn positions(&self) -> usize {
        self.positions
    }

    /// A coordinate of a joint at all positions.
    pub(crate) fn coordinate(&self, joint: usize, axis: usize) -> &[f64] {
        &self.at[(2 * joint + axis) * self.positions..][..self.positions]
    }

    /// A joint at a position.
    pub(crate) fn point(&self, joint: usize, position: usize) -> Vector {
        let [x, y] = [0, 1].map(|axis| self.coordinate(joint, axis)[position]);
        Vector::new(x, y)
    }

    /// The registers of a joint from a position on.
    #[inline(always)]
    pub(super) fn register<R: Real>(&self, joint: usize, first: usize) -> Vector<R> {
        let x = 2 * joint * self.positions + first;
        Vector::new(R::read(&self.at[x..]), R::read(&self.at[x + self.positions..]))
    }

    /// The least and greatest square of the distance between the ends of a dyad.
    pub(crate) fn chord(&self, joint: usize) -> [f64; 2] {
        self.chords[joint]
    }

    /// The first position at which the ends of a dyad are as far apart as this.
    pub(crate) fn chord_position(&self, ends: [usize; 2], square: f64) -> usize {
        let own = |t: usize| (self.point(ends[1], t) - self.point(ends[0], t)).norm2();
        (0..self.positions).find(|&t| own(t) == square).unwrap_or(0)
    }

    /// The greatest square of the distance of a joint from the origin.
    pub(crate) fn reach(&self, joint: usize) -> f64 {
        self.reaches[joint]
    }

    /// The first position at which a joint is as far from the origin as this.
    pub(crate) fn reach_position(&self, joint: usize, square: f64) -> usize {
        (0..self.positions).find(|&t| self.point(joint, t).norm2() == square).unwrap_or(0)
    }
}

/// The cosine of a dyad's apex angle (between its bars) for the square of the distance of its ends.
pub(crate) fn apex_cosine([a, b]: [f64; 2], square: f64) -> f64 {
    (a * a + b * b - square) / (2.0 * a * b)
}

/// Finds the positions of joint `first` and of those after it; `false` if a dyad does not close, or the cosine of its apex angle leaves ± `most_cosine`.
pub(crate) fn sweep<L: Entry>(
    linkage: &PackedLinkage,
    angles: &Angles,
    (first, most_cosine): (usize, f64),
    course: &mut Course,
) -> bool {
    let (joints, positions) = (linkage.len(), angles.len());
    course.positions = positions;
    course.at.resize(2 * joints * positions, 0.0);
    course.chords.resize(joints, [0.0; 2]);
    course.reaches.resize(joints, 0.0);
    let mut task = Sweep { linkage, angles, first, most_cosine, course, closes: false };
    L::call(&mut task);
    task.closes
}

struct Sweep<'s> {
    linkage: &'s PackedLinkage,
    angles: &'s Angles,
    first: usize,
    most_cosine: f64,
    course: &'s mut Course,
    closes: bool,
}

impl<R: Real> Task<R> for Sweep<'_> {
    #[inline(always)]
    fn run(&mut self) {
        let linkage = self.linkage;
        for (joint, placement) in linkage.placements.iter().enumerate().skip(self.first) {
            let numbers = linkage.numbers[joint];
            let vector = Vector::<R>::splat(Vector::new(numbers[0], numbers[1]));
            match *placement {
                Placement::Pivot => self.place::<R>(joint, |_, _| vector),
                Placement::Crank => {
                    let sense = R::splat(linkage.sense);
                    let angles = self.angles;
                    self.place::<R>(joint, |course, t| {
                        let turn = Vector::new(
                            R::read(&angles.cos[t..]),
                            sense * R::read(&angles.sin[t..]),
                        );
                        course.register::<R>(0, t) + turn * vector
                    });
                }
                Placement::Rigid { ends: [i, j] } => self.place::<R>(joint, |course, t| {
                    let from = course.register::<R>(i, t);
                    from + vector * (course.register(j, t) - from)
                }),
                Placement::Dyad { ends, side } => {
                    if !self.dyad::<R>(joint, ends, side) {
                        return;
                    }
                }
            }
        }
        self.closes = true;
    }
}

impl Sweep<'_> {
    /// Stores a joint at all positions.
    #[inline(always)]
    fn place<R: Real>(&mut self, joint: usize, at: impl Fn(&Course, usize) -> Vector<R>) {
        let positions = self.course.positions;
        let mut reach = R::ZERO;
        for t in (0..positions).step_by(R::LANES) {
            let point = at(self.course, t);
            reach = point.norm2().max(reach);
            let x = 2 * joint * positions + t;
            point.x.put(&mut self.course.at[x..]);
            point.y.put(&mut self.course.at[x + positions..]);
        }
        self.course.reaches[joint] = greatest_lane(reach);
    }

    /// Places the inner joint of a dyad: P = I + u d + h left(d), d from I to J.
    #[inline(always)]
    fn dyad<R: Real>(&mut self, joint: usize, [i, j]: [usize; 2], side: f64) -> bool {
        let [a, b] = self.linkage.numbers[joint];
        let (a2, half) = (R::splat(a * a), R::splat(0.5));
        let difference = R::splat(0.5 * (a - b) * (a + b));
        let side = R::splat(side);
        let positions = self.course.positions;
        let (mut least, mut greatest) = (R::splat(f64::INFINITY), R::ZERO);
        let mut reach = R::ZERO;
        for t in (0..positions).step_by(R::LANES) {
            let from = self.course.register::<R>(i, t);
            let chord = self.course.register::<R>(j, t) - from;
            let square = chord.norm2();
            (least, greatest) = (square.min(least), square.max(greatest));
            let inverse = R::ONE / square;
            let along = half + difference * inverse;
            let height = (a2 * inverse - along * along).max(R::ZERO).sqrt() * side;
            let point = from + Vector::new(along, height) * chord;
            reach = point.norm2().max(reach);
            let x = 2 * joint * positions + t;
            point.x.put(&mut self.course.at[x..]);
            point.y.put(&mut self.course.at[x + positions..]);
        }
        let low = (0..R::LANES).fold(f64::INFINITY, |low, lane| low.min(least.lane(lane)));
        let high = greatest_lane(greatest);
        self.course.reaches[joint] = greatest_lane(reach);
        self.course.chords[joint] = [low, high];
        // A NaN anywhere makes both lengths or both squares NaN somewhere: no comparison holds.
        let [first, last] = [low, high].map(|square| apex_cosine([a, b], square));
        first <= self.most_cosine && last >= -self.most_cosine
    }
}

#[inline(always)]
fn greatest_lane<R: Real>(x: R) -> f64 {
    (0..R::LANES).fold(0.0, |most, lane| most.max(x.lane(lane)))
}
