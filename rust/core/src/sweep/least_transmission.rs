//! The least transmission angle.

use std::f64::consts::FRAC_PI_2;

use super::extremes::Decided;
use super::metric::{Growth, Metric, Need, Positions, Slopes};
use crate::batch::request::Quantity;
use crate::math::lanes::LANES;
use crate::math::trig::sin_cos;
use crate::math::vector::Vector;
use crate::query::metrics::acute;

/// One of the two lines whose angle is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Line {
    /// From the first joint to the second.
    Joints([usize; 2]),
    /// Along a guide on a link, at the angle of a dimension, or along the link.
    Guide(usize, Option<usize>),
}

/// The least acute angle between two lines, rad; for a slide the complement of the greatest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeastTransmission {
    /// The lines.
    pub lines: [Line; 2],
    /// Whether this is the angle to the normal of the second line.
    pub complement: bool,
}

impl Line {
    fn needs(self) -> Vec<Need> {
        let need = |quantity| Need { quantity, order: 0 };
        match self {
            Self::Joints(ends) => ends.map(|joint| need(Quantity::Joint(joint))).to_vec(),
            Self::Guide(link, _) => vec![need(Quantity::Angle(link))],
        }
    }

    fn count(self) -> usize {
        match self {
            Self::Joints(_) => 2,
            Self::Guide(..) => 1,
        }
    }

    /// Its direction at a position.
    #[inline]
    fn direction(self, values: &[&[f64]], dimensions: &[f64], at: usize) -> Vector {
        match (self, values) {
            (Self::Joints(_), [from, to]) => {
                Vector::new(to[2 * at] - from[2 * at], to[2 * at + 1] - from[2 * at + 1])
            }
            (Self::Guide(_, offset), [angle]) => {
                let offset = offset.and_then(|index| dimensions.get(index)).copied().unwrap_or(0.0);
                let (y, x) = sin_cos(angle[at] + offset);
                Vector::new(x, y)
            }
            _ => Vector::new(f64::NAN, f64::NAN),
        }
    }
}

impl Metric for LeastTransmission {
    fn needs(&self) -> Vec<Need> {
        self.lines.iter().flat_map(|line| line.needs()).collect()
    }

    fn of(&self, positions: &Positions<'_>) -> f64 {
        let directions = self.index(positions).map(|at| self.directions(positions, at));
        let angle = directions.map_or(f64::NAN, |[u, v]| acute(u, v));
        if self.complement { FRAC_PI_2 - angle } else { angle }
    }

    fn growth(&self) -> Growth {
        Growth::Falls
    }

    fn with_slopes(&self) -> Option<&dyn Slopes> {
        Some(self)
    }
}

impl Slopes for LeastTransmission {
    /// The angle changes as it does at the position that decides (the envelope theorem, J. M. Danskin 1966).
    fn slopes(&self, positions: &Positions<'_>) -> Vec<Vec<f64>> {
        let widths = self.needs().into_iter().map(Need::width);
        let mut slopes: Vec<Vec<f64>> =
            widths.map(|width| vec![0.0; width * positions.count()]).collect();
        let Some((at, turns)) = self.turning(positions) else { return slopes };
        let mut first = 0;
        for ((line, direction), sense) in self.lines.iter().zip(turns.directions).zip(turns.senses)
        {
            match line {
                Line::Joints(_) => {
                    let normal = direction.left().scale(sense / direction.norm2());
                    for (end, side) in [-1.0, 1.0].into_iter().enumerate() {
                        slopes[first + end][2 * at] += side * normal.x;
                        slopes[first + end][2 * at + 1] += side * normal.y;
                    }
                }
                Line::Guide(..) => slopes[first][at] += sense,
            }
            first += line.count();
        }
        slopes
    }

    fn by_dimensions(&self, positions: &Positions<'_>) -> Vec<(usize, f64)> {
        let Some((_, turns)) = self.turning(positions) else { return vec![] };
        let of = |(line, sense): (&Line, f64)| match line {
            Line::Guide(_, Some(dimension)) => Some((*dimension, sense)),
            _ => None,
        };
        self.lines.iter().zip(turns.senses).filter_map(of).collect()
    }
}

/// How the lines lie at the position that decides, and by how much the angle grows where each turns by 1 rad.
struct Turning {
    directions: [Vector; 2],
    senses: [f64; 2],
}

impl Decided for LeastTransmission {
    fn index(&self, positions: &Positions<'_>) -> Option<usize> {
        let [first, second] = self.lines;
        let (a, b) = positions.values.split_at(first.count().min(positions.values.len()));
        match (first, second, a, b) {
            (Line::Joints(_), Line::Joints(_), &[from, to], &[start, end]) => {
                self.least_of_lines([points(from), points(to)], [points(start), points(end)])
            }
            _ => self.least((0..positions.count()).map(|at| self.directions(positions, at))),
        }
    }
}

impl LeastTransmission {
    fn turning(&self, positions: &Positions<'_>) -> Option<(usize, Turning)> {
        let at = self.index(positions)?;
        let directions = self.directions(positions, at);
        let [u, v] = directions;
        // An acute angle falls where the angle from one line to the other grows beyond a right one.
        let grows = if u.cross(v) * u.dot(v) < 0.0 { -1.0 } else { 1.0 };
        let grows = if self.complement { -grows } else { grows };
        Some((at, Turning { directions, senses: [-grows, grows] }))
    }

    /// The directions of both lines at a position.
    #[inline]
    fn directions(&self, positions: &Positions<'_>, at: usize) -> [Vector; 2] {
        let [first, second] = self.lines;
        let (a, b) = positions.values.split_at(first.count().min(positions.values.len()));
        let dimensions = positions.dimensions;
        [first.direction(a, dimensions, at), second.direction(b, dimensions, at)]
    }

    /// The position of the least angle of lines between joints, with several positions side by side.
    fn least_of_lines(
        &self,
        [from, to]: [&[[f64; 2]]; 2],
        [start, end]: [&[[f64; 2]]; 2],
    ) -> Option<usize> {
        let along = |[a, b]: [&[f64; 2]; 2]| Vector::new(b[0] - a[0], b[1] - a[1]);
        let at = |at: usize| [along([&from[at], &to[at]]), along([&start[at], &end[at]])];
        let count = from.len().min(to.len()).min(start.len()).min(end.len());
        let (mut smallest, mut place) = (f64::INFINITY, None);
        for first in (0..count).step_by(LANES) {
            let used = LANES.min(count - first);
            let mut squares = [f64::INFINITY; LANES];
            for (lane, square) in squares[..used].iter_mut().enumerate() {
                let [u, v] = at(first + lane);
                let part = if self.complement { u.dot(v) } else { u.cross(v) };
                *square = part * part / (u.norm2() * v.norm2());
            }
            for (lane, &square) in squares.iter().enumerate() {
                if square < smallest {
                    (smallest, place) = (square, Some(first + lane));
                }
            }
        }
        place
    }

    /// The position whose directions have the least angle.
    #[inline]
    fn least(&self, directions: impl Iterator<Item = [Vector; 2]>) -> Option<usize> {
        let mut smallest = f64::INFINITY;
        let mut place = None;
        for (at, [u, v]) in directions.enumerate() {
            // The square of the sine, or of the cosine, has the order of the angle.
            let part = if self.complement { u.dot(v) } else { u.cross(v) };
            let square = part * part / (u.norm2() * v.norm2());
            if square < smallest {
                (smallest, place) = (square, Some(at));
            }
        }
        place
    }
}

/// x and y of each point.
fn points(values: &[f64]) -> &[[f64; 2]] {
    values.as_chunks::<2>().0
}
