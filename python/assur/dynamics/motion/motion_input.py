"""What reactions and efforts accept as a motion: numbers, a run, a state, a motion by a law."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from assur._arrays import finite_array
from assur.dynamics.motion.run import Run, State
from assur.dynamics.motion.sense_at_rest import Senses, senses_of_run, senses_of_states
from assur.dynamics.motion.steady import SteadyState
from assur.errors import InputError
from assur.kinematics.timed import TimedMotion

if TYPE_CHECKING:
    from assur._arrays import Float

# Coordinates, or a motion that has been computed.
MotionLike: TypeAlias = "npt.ArrayLike | Run | SteadyState | State | TimedMotion"


class DrivenMotion(NamedTuple):
    """Coordinates, speeds and accelerations of the drivers, and times.

    A run with one driver also has its sense where the speed is 0.
    """

    q: Any
    speed: Any
    acceleration: Any
    t: Any
    senses: Senses | None = None


def motion_of(q: Any, speed: Any, acceleration: Any, t: Any) -> DrivenMotion:
    """Return the motion given by numbers, or that of a run at the ends of its steps."""
    if not isinstance(q, Run | SteadyState | State | TimedMotion):
        return DrivenMotion(q, speed, acceleration, t)
    what = type(q).__name__
    for name, value in (("speed", speed), ("acceleration", acceleration), ("t", t)):
        # A given 0.0 looks like the default.
        if not (isinstance(value, float) and value == 0.0):
            message = f"{name} is given with a {what}, which has its own: leave it out"
            raise InputError(message)
    state = q.run if isinstance(q, SteadyState) else q
    parts = state.q, state.speed, state.acceleration
    senses: Senses | None = None
    # A law does not say how friction holds a machine in a dwell.
    if isinstance(state, Run) and np.ndim(state.q) == 1:
        senses = senses_of_run(*parts)
    elif isinstance(state, State) and np.shape(state.q) == np.shape(state.t):
        senses = senses_of_states(*parts[1:])
    return DrivenMotion(*parts, state.t, senses)


def times(t: npt.ArrayLike, shape: tuple[int, ...]) -> Float:
    """Return the times of all positions of all designs."""
    array = finite_array(t, "t")
    try:
        return np.broadcast_to(array, shape)
    except ValueError as error:
        message = f"t has the shape {array.shape}, the positions {shape}: they do not fit"
        raise InputError(message) from error
