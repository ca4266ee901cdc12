"""Positions of rest of machines: checks of the range, then the search in the core."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur._arrays import real_array, short
from assur.dynamics.preconditions import without_friction
from assur.errors import InputError, MotionError

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Float
    from assur.dynamics.model import MachineModel

__all__ = ["Equilibria"]

# Intervals of the search over a turn of an angle, or over the range of a slide.
INTERVALS = 256
# Longest range of an angle.
MOST_TURNS = 100


class Equilibria(NamedTuple):
    """Positions of rest of a machine, ascending, by `Machine.equilibria`.

    Attributes
    ----------
    q : ndarray
        Coordinates at which the reduced moment is zero, rad or m, (K,).
    stable : ndarray of bool
        Whether the machine returns after a small push: where the potential is least. Where the
        moment only touches zero, rest is not stable.
    frequency : ndarray
        Natural frequency √(V″/J) of small oscillations, rad/s (divided by 2π: Hz); NaN where rest
        is not stable or nothing has inertia.
    stiffness : ndarray
        V″, the slope of the moment that brings the machine back, N·m/rad (driven slide: N/m).
    indifferent : ndarray
        Ends of the intervals within which the moment is zero to rounding (a balanced crank: the
        whole turn), (L, 2). No q within them is listed.

    Examples
    --------
    A pendulum hangs, or stands where it falls at the least push:

    >>> import assur, numpy as np
    >>> pendulum = assur.Mechanism(
    ...     joints={"O": (0, 0), "A": (0.2, 0)},
    ...     links={"ground": ["O"], "rod": ["O", "A"]},
    ...     driver="rod",
    ... )
    >>> bob = assur.Body(mass=3.0, at="A")
    >>> rest = assur.Machine(pendulum, bodies={"rod": bob}, loads=[assur.Gravity()]).equilibria()
    >>> rest.q.round(6), rest.stable
    (array([-1.570796,  1.570796]), array([ True, False]))
    >>> rest.frequency[0].round(6), np.sqrt(9.81 / 0.2).round(6)  # rad/s
    (np.float64(7.003571), np.float64(7.003571))
    """

    q: Float
    stable: npt.NDArray[np.bool_]
    frequency: Float
    stiffness: Float
    indifferent: Float

    def __repr__(self) -> str:
        lines = ["<assur.Equilibria>"]
        for q, is_stable, frequency in zip(self.q, self.stable, self.frequency, strict=True):
            swing = f", {frequency:.6g} rad/s" if is_stable and np.isfinite(frequency) else ""
            lines.append(f"q = {q:.6g}: {'stable' if is_stable else 'not stable'}{swing}")
        lines += [f"q = {low:.6g} … {high:.6g}: indifferent" for low, high in self.indifferent]
        return "\n".join(lines if len(lines) > 1 else ["<assur.Equilibria: none>"])


def equilibria(machine: MachineModel, between: Any) -> Equilibria:
    """Return the positions of rest of a machine; see `Machine.equilibria`."""
    if machine.driver_count > 1:
        message = (
            f"the machine has {machine.driver_count} drivers: equilibria are found for one; "
            "hold the others: make a mechanism with links fixed at them"
        )
        raise InputError(message)
    without_friction(machine, "equilibria")
    if machine.shape:
        message = (
            f"the machine is a batch of designs of shape {machine.shape}, each with its own number "
            "of equilibria: call machine.design(index).equilibria()"
        )
        raise InputError(message)
    if machine.core.load_functions:
        message = (
            "a load is a function of (t, q, speed), which may change with time or speed: "
            "equilibria need constant loads, or tables over q (assur.Table)"
        )
        raise InputError(message)
    if machine.core.follows[1]:
        message = (
            "a load has while_=: it acts in one direction of motion, and at rest there is none; "
            "equilibria need loads that act at rest"
        )
        raise InputError(message)
    ends, is_turn, intervals = search_range(machine, between)
    dimensions = np.empty(0) if machine.mechanism is None else machine.mechanism.values.ravel()
    q, stable, stiffness, frequency, indifferent, jumps, incomplete, empty, failure = (
        machine.core.equilibria(dimensions, list(ends), is_turn, intervals)
    )
    if failure is not None:
        raise failure
    if empty:
        message = (
            f"the loads have no finite moment from q = {ends[0]:.9g} to {ends[1]:.9g}: a table "
            "does not cover it, or a load or a mass is too great"
        )
        raise MotionError(message, kind="not_finite", q=ends[0])
    if jumps:
        message = (
            f"the moment of the loads changes its sign in a jump at q = {jumps[0]:.15g}: a "
            "spring's length goes through zero there, or a table is steep; leave it out with "
            "between="
        )
        raise MotionError(message, q=jumps[0])
    if incomplete:
        message = (
            f"the moment of the loads varies too quickly between q = {ends[0]:.9g} and "
            f"{ends[1]:.9g} for a complete search: search shorter ranges with between="
        )
        raise MotionError(message)
    intervals_of_zero = np.array(indifferent, np.float64).reshape(-1, 2)
    answer = Equilibria(q, stable, frequency, stiffness, intervals_of_zero)
    for array in answer:
        array.flags.writeable = False
    return answer


def search_range(machine: MachineModel, between: Any) -> tuple[tuple[float, float], bool, int]:
    """Return the ends of the search, whether they are one position, and the count of intervals."""
    mechanism = machine.mechanism
    is_slide = mechanism is not None and mechanism.driver in mechanism.slides
    if between is None:
        if mechanism is None:
            knots, periodic = machine.core.tables[0]
            return (knots[0], knots[-1]), periodic, INTERVALS
        if is_slide:
            message = (
                f'the driver is the slide "{mechanism.driver}", which has no full turn: give '
                "between=(least, greatest), m"
            )
            raise InputError(message, slide=str(mechanism.driver))
        q0 = float(mechanism.q0)
        return (q0 - math.pi, q0 + math.pi), True, INTERVALS
    ends = real_array(between, "between")
    if ends.shape != (2,) or not np.isfinite(ends).all() or not ends[0] < ends[1]:
        message = f"between is {short(between)}: two finite numbers (least, greatest) are needed"
        raise InputError(message)
    low, high = float(ends[0]), float(ends[1])
    turns = 1 if is_slide else max(1, math.ceil(min((high - low) / math.tau, 1e300)))
    if turns > MOST_TURNS:
        message = (
            f"between is {short(between)}, {turns:.3g} turns: at most {MOST_TURNS} are searched"
        )
        raise InputError(message)
    return (low, high), False, INTERVALS * turns
