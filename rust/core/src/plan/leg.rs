//! The leg of a dyad: the side that turns with one of its unknowns.

use super::dyad::Dyad;
use crate::math::lanes::Real;
use crate::math::vector::Vector;

/// The edges whose sum each leg is, two legs per dyad.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct LegEdges {
    /// For every leg its part of `edges`; `None` if the unknown turns no leg.
    parts: Vec<Option<[usize; 2]>>,
    /// Edges; true for one that is traversed backward.
    edges: Vec<(usize, bool)>,
}

impl LegEdges {
    pub(crate) fn of<'d>(dyads: impl Iterator<Item = &'d Dyad>) -> Self {
        let mut legs = Self::default();
        for dyad in dyads {
            for unknown in 0..2 {
                let first = legs.edges.len();
                let turned = dyad.path.iter().filter(|term| term.turns == Some(unknown));
                legs.edges.extend(turned.map(|term| (term.edge, term.backward)));
                legs.parts.push(dyad.leg[unknown].then_some([first, legs.edges.len()]));
            }
        }
        legs
    }

    /// The legs of one design, of every dyad.
    pub(crate) fn measure(&self, edge_vector: &[Vector], legs: &mut Vec<[Leg; 2]>) {
        legs.resize(self.parts.len() / 2, [Leg::default(); 2]);
        let legs = legs.iter_mut().flatten();
        for (leg, part) in legs.zip(&self.parts) {
            let &Some([first, end]) = part else { continue };
            let mut sum = Vector::ZERO;
            for &(edge, backward) in &self.edges[first..end] {
                let vector = edge_vector[edge];
                sum += if backward { -vector } else { vector };
            }
            *leg = Leg::constant(sum);
        }
    }
}

/// The square of a number keeps all its digits above this.
const LEAST_SQUARE: f64 = 1.0e-290;

/// The sum of the constant vectors that turn with one unknown rotation, and its length.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Leg<R = f64> {
    /// Vector in the frame of the class.
    pub vector: Vector<R>,
    /// Length.
    pub norm: R,
    /// Length².
    pub norm2: R,
    /// 1/length².
    pub inv_norm2: R,
    /// 1/vector, as complex numbers.
    pub inverse: Vector<R>,
    /// Whether it is known to be along x, as the leg of a binary link always is.
    pub along_x: bool,
}

impl<R: Real> Leg<R> {
    /// The leg with this vector.
    #[inline(always)]
    pub(crate) fn of(vector: Vector<R>) -> Self {
        let norm2 = vector.norm2();
        let inv_norm2 = R::ONE / norm2;
        let inverse = vector.conj().scale(inv_norm2);
        Self { vector, norm: norm2.sqrt(), norm2, inv_norm2, inverse, along_x: false }
    }

    /// 1/length.
    #[inline(always)]
    pub(crate) fn inv_norm(&self) -> R {
        self.norm * self.inv_norm2
    }

    /// The rotation that turns the leg to a vector of the same length.
    #[inline(always)]
    pub(crate) fn turn_to(&self, turned: Vector<R>) -> Vector<R> {
        if self.along_x { turned.scale(self.inverse.x) } else { turned * self.inverse }
    }
}

impl Leg {
    /// The leg of one design.
    #[inline(always)]
    pub(crate) fn constant(vector: Vector) -> Self {
        let along_x = vector.y == 0.0;
        let norm2 = vector.norm2();
        let inv_norm2 = 1.0 / norm2;
        // The root of a rounded square is exact, unless the square loses digits.
        let norm = if along_x && norm2 > LEAST_SQUARE { vector.x.abs() } else { norm2.sqrt() };
        Self { vector, norm, norm2, inv_norm2, inverse: vector.conj().scale(inv_norm2), along_x }
    }

    /// A vector that turns with the leg, divided by it; without a leg, the vector itself.
    pub(crate) fn part(&self, vector: Vector) -> Vector {
        if self.norm2 == 0.0 { vector } else { self.turn_to(vector) }
    }

    /// The same leg on every lane.
    #[inline(always)]
    pub(crate) fn on_lanes<R: Real>(&self) -> Leg<R> {
        Leg {
            vector: Vector::splat(self.vector),
            norm: R::splat(self.norm),
            norm2: R::splat(self.norm2),
            inv_norm2: R::splat(self.inv_norm2),
            inverse: Vector::splat(self.inverse),
            along_x: self.along_x,
        }
    }
}
