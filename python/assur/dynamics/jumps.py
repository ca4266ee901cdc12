"""Where loads may jump over the driver's coordinate, and how a motion is read there."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from assur.dynamics.along import DrivenMotion, motion_of
from assur.dynamics.run import Run
from assur.dynamics.steady import SteadyState
from assur.errors import InputError

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.dynamics.along import MotionLike
    from assur.dynamics.model import MachineModel

__all__ = ["BESIDE", "driven_motion", "jumps_between", "stations_between"]

# How far beside a jump loads are evaluated, rad (relative beyond 1 rad): beyond its rounding.
BESIDE = 1e-10
# Most jumps of a table that are looked for.
MAX_JUMPS = 1_000_000
# A coordinate this near to a jump is at it.
AT_JUMP = 1e-11


def stations_between(machine: MachineModel, low: float, high: float) -> list[float]:
    """Return where loads of one design that follow other coordinates are not smooth."""
    if not machine._core.follows[0] or machine.mechanism is None or machine._drivers > 1:
        return []
    return machine._core.stations(machine.mechanism._values.ravel().tolist(), low, high)


def jumps_between(machine: MachineModel, low: float, high: float) -> Float:
    """Return where the loads of one design may jump between two coordinates."""
    found = stations_between(machine, low, high)
    for (rows, periodic), own in zip(machine._core.tables, machine._core.jumps, strict=True):
        if not own:
            continue
        period = rows[-1] - rows[0]
        first, last = (low - own[-1]) / period, (high - own[0]) / period
        if periodic and not (last - first) * len(own) < MAX_JUMPS:
            message = f"a table's period of {period:g} has too many jumps from {low:g} to {high:g}"
            raise InputError(message, value=period)
        shifts = range(math.floor(first), math.ceil(last) + 1) if periodic else (0,)
        found += [q + shift * period for shift in shifts for q in own]
    every = np.unique(found)
    return every[(every >= low) & (every <= high)]


def driven_motion(
    machine: MachineModel, q: MotionLike, speed: Any, acceleration: Any, t: Any
) -> DrivenMotion:
    """Return the motion given by numbers, or that of a run beside the jumps of its loads."""
    motion = motion_of(q, speed, acceleration, t)
    return _one_sided(machine, motion) if isinstance(q, Run | SteadyState) else motion


def _one_sided(machine: MachineModel, motion: DrivenMotion) -> DrivenMotion:
    """Return a motion at the ends of its steps, moved off the jumps of the loads.

    The acceleration at the end of a step is that before a jump, at the start of the motion that
    behind it: the loads must be those of the same side.
    """
    q, speed = np.asarray(motion.q), np.asarray(motion.speed)
    if machine._drivers > 1 or q.ndim != 1 or q.size == 0 or not np.isfinite(q).all():
        return motion
    reach = 2.0 * BESIDE * max(1.0, float(np.abs(q).max()))
    jumps = jumps_between(machine, float(q.min()) - reach, float(q.max()) + reach)
    if not jumps.size:
        return motion
    after = np.searchsorted(jumps, q)
    nearest = np.minimum(
        np.abs(q - jumps[np.clip(after - 1, 0, None)]),
        np.abs(q - jumps[np.clip(after, None, jumps.size - 1)]),
    )
    size = np.maximum(1.0, np.abs(q))
    sense = np.sign(speed)
    if motion.senses is not None:
        sense = np.where(speed == 0.0, np.nan_to_num(motion.senses.sense), sense)
    side = np.where(np.arange(q.size) == 0, 1.0, -1.0) * sense
    moved = np.where(nearest <= AT_JUMP * size, q + side * BESIDE * size, q)
    return motion._replace(q=moved)
