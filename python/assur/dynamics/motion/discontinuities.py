"""Where loads and friction jump over the driver's coordinate, and how a motion is read there."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from assur.dynamics.motion.motion_input import DrivenMotion, motion_of
from assur.dynamics.motion.run import Run
from assur.dynamics.motion.steady import SteadyState
from assur.errors import InputError

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Float
    from assur.dynamics.model import MachineModel
    from assur.dynamics.motion.motion_input import MotionLike

__all__ = ["BESIDE", "driven_motion", "jumps_between", "stations_between"]

# How far beside a jump loads are evaluated, rad (relative beyond 1 rad): beyond its rounding.
BESIDE = 1e-10
# The same beside a reversal of a pair with friction, which must not seem to rest there: the
# relative speed of a rod a hundred cranks long is a hundredth of the crank's.
BESIDE_REVERSAL = 1e-9
# Greatest number of jumps of a table to look for.
MAX_JUMPS = 1_000_000
# A coordinate this near to a jump is at it.
AT_JUMP = 1e-11


def stations_between(machine: MachineModel, low: float, high: float) -> list[float]:
    """Return where loads of one design that follow other coordinates are not smooth."""
    if not machine.core.follows[0] or machine.mechanism is None or machine.driver_count > 1:
        return []
    return machine.core.stations(machine.mechanism.values.ravel().tolist(), low, high)


def _reversals_between(machine: MachineModel, low: float, high: float) -> list[float]:
    """Return where pairs with friction of one design reverse: the friction jumps there."""
    if not machine.friction or machine.mechanism is None or machine.driver_count > 1:
        return []
    return machine.core.reversals(machine.mechanism.values.ravel().tolist(), low, high)


def jumps_between(
    machine: MachineModel, low: float, high: float, *, friction: bool = False
) -> Float:
    """Return where the loads of one design, or its friction too, may jump between coordinates."""
    jumps = stations_between(machine, low, high)
    jumps += _reversals_between(machine, low, high) if friction else []
    for (rows, periodic), own_jumps in zip(machine.core.tables, machine.core.jumps, strict=True):
        if not own_jumps:
            continue
        period = rows[-1] - rows[0]
        first, last = (low - own_jumps[-1]) / period, (high - own_jumps[0]) / period
        if periodic and not (last - first) * len(own_jumps) < MAX_JUMPS:
            message = f"a table's period of {period:g} has too many jumps from {low:g} to {high:g}"
            raise InputError(message, value=period)
        shifts = range(math.floor(first), math.ceil(last) + 1) if periodic else (0,)
        jumps += [q + shift * period for shift in shifts for q in own_jumps]
    every = np.unique(jumps)
    return every[(every >= low) & (every <= high)]


def driven_motion(
    machine: MachineModel, q: MotionLike, speed: Any, acceleration: Any, t: Any
) -> DrivenMotion:
    """Return the motion given by numbers, or that of a run beside its jumps."""
    motion = motion_of(q, speed, acceleration, t)
    if not isinstance(q, Run | SteadyState):
        return motion
    return _one_sided(machine, motion, q.run if isinstance(q, SteadyState) else q)


def _one_sided(machine: MachineModel, motion: DrivenMotion, run: Run) -> DrivenMotion:
    """Return a motion at the ends of its steps, moved off the jumps of loads and friction.

    The acceleration at the end of a step is that before a jump, at the start of the motion that
    after it: loads and friction must be those of the same side.
    """
    q, speed = np.asarray(motion.q), np.asarray(motion.speed)
    if machine.driver_count > 1 or q.ndim != 1 or q.size == 0 or not np.isfinite(q).all():
        return motion
    size = np.maximum(1.0, np.abs(q))
    reach = 2.0 * BESIDE * float(size.max())
    low, high = float(q.min()) - reach, float(q.max()) + reach
    at_reversal = _is_at(q, np.array(_reversals_between(machine, low, high)))
    at_jump = at_reversal | _is_at(q, jumps_between(machine, low, high))
    if not at_jump.any():
        return motion
    sense = np.sign(speed)
    if motion.senses is not None:
        sense = np.where(speed == 0.0, np.nan_to_num(motion.senses.sense), sense)
    onward = np.where(np.arange(q.size) == 0, 1.0, -1.0)
    way = np.where(at_reversal, BESIDE_REVERSAL, BESIDE) * size * onward
    moved, states = np.where(at_jump, q + way * sense, q), [speed, np.asarray(motion.acceleration)]
    rows = at_jump & (speed != 0.0)
    if rows.any():
        # This close, the run itself gives the speed: its own effort stays zero.
        if run.along_q:
            state = run.at(q=np.clip(moved[rows], low + reach, high - reach))
        else:
            times = run.t[rows] + (way / np.where(rows, np.abs(speed), 1.0))[rows]
            state = run.at(np.clip(times, run.t[0], run.t[-1]))
        moved[rows] = state.q
        states = [column.copy() for column in states]
        for column, values in zip(states, (state.speed, state.acceleration), strict=True):
            column[rows] = values
    return motion._replace(q=moved, speed=states[0], acceleration=states[1])


def _is_at(q: Float, places: Float) -> npt.NDArray[np.bool_]:
    """Return which coordinates are at one of these ascending places."""
    if not places.size:
        return np.zeros(q.shape, dtype=bool)
    after = np.searchsorted(places, q)
    before = places[np.clip(after - 1, 0, None)]
    behind = places[np.clip(after, None, places.size - 1)]
    nearest = np.minimum(np.abs(q - before), np.abs(q - behind))
    at: npt.NDArray[np.bool_] = nearest <= AT_JUMP * np.maximum(1.0, np.abs(q))
    return at
