//! The chord of a dyad in the frame of a fixed guide: x along the guide, y across it.

use super::chord::{CrankArm, DyadChord, Ends, FROM_PIN, TO_PIN};
use crate::math::lanes::Real;
use crate::math::stride::Stride;
use crate::math::vector::Vector;
use crate::plan::tape::DyadOp;
use crate::state::state::Context;

/// The chord of a dyad, less the fixed part of its loop.
pub(super) struct GuideChord<'a, R: Real, const G: usize> {
    chord: DyadChord<'a, R, G>,
    offset: Vector,
    /// The rotation into the frame.
    into: Vector,
    /// With a crank's pin: the crank, in the frame of the guide.
    arm: Vector,
    /// With a crank's pin: everything fixed, in the frame of the guide.
    frame: Vector,
}

/// The part of a chord that turns with a crank; zero if the chord has no pin.
#[derive(Clone, Copy)]
pub(super) struct TurningPart<W>(Vector<W>);

impl<'a, R: Real, const G: usize> GuideChord<'a, R, G> {
    /// The chord of `op`, with jets of `len` entries.
    #[inline(always)]
    pub(super) fn new(
        cx: &Context<'_>,
        op: &DyadOp,
        points: &'a [[Vector<R>; G]],
        units: &'a [[Vector<R>; G]],
        len: usize,
    ) -> Self {
        let dyad = &cx.constants.dyads[op.dyad];
        let chord = DyadChord::new(cx, op, points, units, len);
        let into = dyad.guides[1].conj();
        let from_pin = op.pin.is_some_and(|pin| pin.is_start);
        let [arm, frame] = if from_pin {
            [-chord.arm, chord.ground - chord.pivot]
        } else {
            [chord.arm, chord.pivot - chord.ground]
        };
        let frame = into * (frame - dyad.offset);
        Self { chord, offset: dyad.offset, into, arm: into * arm, frame }
    }

    /// The data that [`GuideChord::at`] needs for positions from register `g` on.
    #[inline(always)]
    pub(super) fn turning<W: Stride<R>, const ENDS: Ends>(&self, g: usize) -> TurningPart<W> {
        let at_pin = ENDS == FROM_PIN || ENDS == TO_PIN;
        TurningPart(if at_pin { self.chord.unit(g).turn(self.arm) } else { Vector::ZERO })
    }

    /// Entry `k` of the chord's jet, by one driver.
    #[inline(always)]
    pub(super) fn at<W: Stride<R>, const ENDS: Ends>(
        &self,
        k: usize,
        g: usize,
        TurningPart(entry): TurningPart<W>,
    ) -> Vector<W> {
        if ENDS == FROM_PIN || ENDS == TO_PIN {
            let entry = self.chord.derivative(k, entry);
            return if k == 0 { entry + Vector::splat(self.frame) } else { entry };
        }
        let chord = self.chord.at::<W, ENDS>(k, g, CrankArm::NONE);
        let chord = if k == 0 { chord - Vector::splat(self.offset) } else { chord };
        chord.turn(self.into)
    }
}
