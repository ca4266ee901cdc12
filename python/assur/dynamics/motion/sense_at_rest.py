"""The sense of a motion where its speed is 0, which friction needs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from assur._arrays import Float

# A speed in place of 0 that has a sense: its square is 0, and it drags with no force.
CREEPING = 1e-150


class Senses(NamedTuple):
    """The senses of a motion of one driver where its speed is 0, or 0 but for rounding.

    `sense` is +1 or −1, NaN where it stays at rest (and 0 where it moves); `begins` is where it
    leaves its rest at such a position, held by static friction until then.
    """

    sense: Float
    begins: npt.NDArray[np.bool_]

    def reshaped(self, shape: tuple[int, ...]) -> Senses:
        """Return the same for positions of a shape."""
        return Senses(np.broadcast_to(self.sense, shape), np.broadcast_to(self.begins, shape))

    def flat(self) -> Senses:
        """Return the same in one row."""
        return Senses(self.sense.ravel(), self.begins.ravel())

    @property
    def rests(self) -> npt.NDArray[np.bool_]:
        """Return where it stays at rest."""
        return np.isnan(self.sense)

    def creeping(self, speed: Float, with_begins: bool) -> Float:
        """Return the speeds; where they are 0, one next to nothing in the direction of the sense.

        Positions at which it leaves its rest keep 0, unless asked for `with_begins`.
        """
        kept = self.rests | (self.begins & (not with_begins))
        return np.where((self.sense != 0.0) & ~kept, CREEPING * self.sense, speed)


def senses_of_run(q: Float, speed: Float, acceleration: Float) -> Senses:
    """Return the senses at the ends of a run's steps.

    Its acceleration at the end of a step is that just before: so is the sense, but for the start
    and where it leaves its rest.
    """
    count = q.size
    sense, begins = np.zeros(count), np.zeros(count, np.bool_)
    # The sense of every step, 0 where it stays at rest: there it has no acceleration either.
    steps = np.sign(np.diff(q))
    short = np.where(speed[1:] != 0.0, np.sign(speed[1:]), np.sign(speed[:-1]))
    steps = np.where((steps == 0.0) & (acceleration[1:] != 0.0), short, steps)
    # Where it turns back, rounding decides on the sign of its speed.
    is_rounding = np.append(False, np.sign(speed[1:]) * steps < 0.0)
    for row in np.flatnonzero((speed == 0.0) | is_rounding).tolist():
        before = steps[row - 1] if row else np.sign(acceleration[row])
        after = steps[row] if row < count - 1 else 0.0
        begins[row] = before == 0.0 and after != 0.0
        direction = before or after
        sense[row] = direction or np.nan
    return Senses(sense, begins)


def senses_of_states(speed: Any, acceleration: Any) -> Senses:
    """Return the senses at single times of a run: those of the acceleration."""
    rests = np.asarray(speed) == 0.0
    sense = np.where(rests, np.sign(acceleration), 0.0)
    return Senses(np.where(rests & (sense == 0.0), np.nan, sense), np.zeros(rests.shape, np.bool_))
