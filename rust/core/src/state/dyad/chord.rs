//! The chord of a dyad, from its start to its end, on the unchecked path: between any two points, or with
//! a crank's pin or a ground point at one end, whose jets are computed instead of stored.

use crate::math::lanes::Real;
use crate::math::stride::Stride;
use crate::math::vector::Vector;
use crate::plan::tape::{CrankPin, DyadOp};
use crate::state::state::Context;

/// The kinds of points that a chord connects.
pub(super) type Ends = u8;
pub(super) const POINTS: Ends = 0;
pub(super) const FROM_PIN: Ends = 1;
pub(super) const TO_PIN: Ends = 2;
pub(super) const FROM_GROUND: Ends = 3;
pub(super) const TO_GROUND: Ends = 4;

/// The ends of a dyad's chord.
pub(super) struct DyadChord<'a, R: Real, const G: usize> {
    start: &'a [[Vector<R>; G]],
    end: &'a [[Vector<R>; G]],
    units: &'a [Vector<R>],
    backward: bool,
    pub arm: Vector,
    pub pivot: Vector,
    pub ground: Vector,
}

/// The vector from a crank's pivot to its pin; zero if the chord has no pin.
#[derive(Clone, Copy)]
pub(super) struct CrankArm<W>(Vector<W>);

impl<W: Real> CrankArm<W> {
    pub(super) const NONE: Self = Self(Vector::ZERO);
}

/// The kinds of points that the chord of a dyad connects.
#[inline(always)]
pub(super) fn ends_of(op: &DyadOp) -> Ends {
    match (&op.pin, op.on_ground) {
        (Some(pin), _) if pin.is_start => FROM_PIN,
        (Some(_), _) => TO_PIN,
        (None, [_, true]) => TO_GROUND,
        (None, [true, false]) => FROM_GROUND,
        (None, [false, false]) => POINTS,
    }
}

impl<'a, R: Real, const G: usize> DyadChord<'a, R, G> {
    /// The chord of `op`, with jets of `len` entries.
    #[inline(always)]
    pub(super) fn new(
        cx: &Context<'_>,
        op: &DyadOp,
        points: &'a [[Vector<R>; G]],
        units: &'a [[Vector<R>; G]],
        len: usize,
    ) -> Self {
        let pin = op.pin.unwrap_or(CrankPin::NONE);
        let edge = cx.constants.edge_vector.get(pin.edge).copied().unwrap_or(Vector::ZERO);
        let ground = match ends_of(op) {
            FROM_PIN | TO_GROUND => op.end,
            _ => op.start,
        };
        Self {
            start: &points[op.start * len..op.start * len + len],
            end: &points[op.end * len..op.end * len + len],
            units: units.get(pin.driver).map_or(&[], |units| &units[..]),
            backward: pin.conj,
            arm: if pin.backward { -edge } else { edge },
            pivot: cx.constants.fixed[pin.pivot],
            ground: cx.constants.fixed[ground],
        }
    }

    /// The data that [`DyadChord::at`] needs for positions from register `g` on.
    #[inline(always)]
    pub(super) fn arm<W: Stride<R>, const ENDS: Ends>(&self, g: usize) -> CrankArm<W> {
        if ENDS != FROM_PIN && ENDS != TO_PIN {
            return CrankArm::NONE;
        }
        CrankArm(self.unit(g).turn(self.arm))
    }

    /// The rotation of the crank.
    #[inline(always)]
    pub(super) fn unit<W: Stride<R>>(&self, g: usize) -> Vector<W> {
        let unit = W::load_vectors(self.units, g);
        if self.backward { unit.conj() } else { unit }
    }

    /// Entry `k` of the jet of a vector that turns with the crank.
    #[inline(always)]
    pub(super) fn derivative<W: Real>(&self, k: usize, mut vector: Vector<W>) -> Vector<W> {
        for _ in 0..k {
            vector = if self.backward { -vector.left() } else { vector.left() };
        }
        vector
    }

    /// Entry `k` of the chord's jet, by one driver. The operations are those that would place the pin,
    /// so the bits are the same.
    #[inline(always)]
    pub(super) fn at<W: Stride<R>, const ENDS: Ends>(
        &self,
        k: usize,
        g: usize,
        CrankArm(entry): CrankArm<W>,
    ) -> Vector<W> {
        let ground = if k == 0 { Vector::splat(self.ground) } else { Vector::ZERO };
        match ENDS {
            POINTS => {
                return W::load_vectors(&self.end[k], g) - W::load_vectors(&self.start[k], g);
            }
            FROM_GROUND => return W::load_vectors(&self.end[k], g) - ground,
            TO_GROUND => return ground - W::load_vectors(&self.start[k], g),
            _ => {}
        }
        let entry = self.derivative(k, entry);
        let pivot = if k == 0 { Vector::splat(self.pivot) } else { Vector::ZERO };
        let pin = pivot + entry;
        if ENDS == FROM_PIN { ground - pin } else { pin - ground }
    }
}
