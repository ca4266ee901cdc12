"""Where friction locks a machine, or holds its loads."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur._arrays import real_number, short
from assur._search import bisected
from assur._validate import MAX_POINTS, whole_number
from assur.dynamics.forces.kinetostatics import reactions
from assur.dynamics.motion.equilibria import search_range
from assur.dynamics.motion.motion_input import DrivenMotion
from assur.dynamics.preconditions import one_design
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt

    from assur._arrays import Float
    from assur.dynamics.model import MachineModel

__all__ = ["SelfLocking"]

# Halvings of an interval between two positions: down to rounding.
HALVINGS = 52


class SelfLocking(NamedTuple):
    """Intervals of q in which friction locks a machine, by `Machine.self_locking`.

    Attributes
    ----------
    locked : ndarray
        Ends of the intervals in which the drive cannot move the machine against its loads, however
        strong it is, (L, 2).
    holding : ndarray
        Ends of those in which the loads would drive the machine without friction, but friction
        holds it: the drive must help, (K, 2).

    Examples
    --------
    >>> import assur, numpy as np
    >>> press = assur.Machine(
    ...     assur.SliderCrank(0.1, 0.4),
    ...     loads=[assur.Force("B", (-1000.0, 0.0))],
    ...     friction={name: assur.JointFriction(0.1, radius=0.03) for name in "OAB"},
    ... )

    The force alone starts nothing within:

    >>> np.degrees(press.self_locking().holding).round(2)
    array([[  0.  ,   3.44],
           [175.42, 180.  ]])
    """

    locked: Float
    holding: Float


def self_locking(
    machine: MachineModel, sense: Any, speed: Any, acceleration: Any, between: Any, n: Any
) -> SelfLocking:
    """Return where friction locks a machine; see `Machine.self_locking`."""
    one_design(machine, "self_locking")
    if machine.driver_count > 1:
        message = (
            f"the machine has {machine.driver_count} drivers: self_locking is over one coordinate"
        )
        raise InputError(message)
    mechanism = machine.mechanism
    if mechanism is None or not machine.friction:
        message = "the machine has no friction: give it some, friction="
        raise InputError(message)
    way = real_number(sense, "sense")
    if way not in (-1.0, 1.0):
        message = f"sense is {short(sense)}: +1 or −1 is needed"
        raise InputError(message)
    rate, change = real_number(speed, "speed"), real_number(acceleration, "acceleration")
    if rate * way < 0.0:
        message = f"speed is {rate:g} and sense {way:g}: they must agree"
        raise InputError(message)
    count = whole_number(n, "n", 2, MAX_POINTS)
    ends, is_turn, _ = search_range(machine, between)
    q = np.linspace(*ends, count + 1)
    bare = type(machine)(mechanism, bodies=machine.bodies, loads=machine.loads)

    def locked(at: Float) -> npt.NDArray[np.bool_]:
        motion = DrivenMotion(at, rate, change, 0.0)
        solved = reactions(machine, motion, None, "nan", sense=way)
        return np.asarray(solved.locked)

    def holding(at: Float) -> npt.NDArray[np.bool_]:
        motion = DrivenMotion(at, rate, change, 0.0)
        rubbing = reactions(machine, motion, None, "nan", sense=way).driver * way
        free = reactions(bare, motion, None, "nan", sense=way).driver * way
        return np.asarray((free < 0.0) & (rubbing > 0.0))

    return SelfLocking(*(_intervals(of, q, is_turn) for of in (locked, holding)))


def _intervals(of: Callable[[Float], npt.NDArray[np.bool_]], q: Float, is_turn: bool) -> Float:
    """Return the ends of the intervals in which a condition holds, each to rounding."""
    holds = of(q)
    if holds.all():
        return np.array([[q[0], q[-1]]])
    if is_turn:
        # Begin where it does not hold: an interval may go over the end of the turn.
        first = int(np.flatnonzero(~holds[:-1])[0])
        q = np.concatenate([q[first:-1], q[: first + 1] + math.tau])
        holds = np.concatenate([holds[first:-1], holds[: first + 1]])
    changes = np.flatnonzero(holds[1:] != holds[:-1])
    before = holds[changes]
    low, high = bisected(lambda at: of(at) == before, q[changes], q[changes + 1], HALVINGS)
    # The end at which it holds.
    edges = np.where(before, low, high).tolist()
    if holds[0]:
        edges.insert(0, q[0])
    if holds[-1]:
        edges.append(q[-1])
    return np.array(edges, np.float64).reshape(-1, 2)
