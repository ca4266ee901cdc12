"""What keeps a design from going through given positions."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import short
from assur._validate import real_number
from assur.errors import InputError
from assur.kinematics.configuration import nearest, places_along, size_of
from assur.kinematics.curve.elements import SAME, ends_of, has_driven_angle
from assur.kinematics.solve import solve

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._faces import ConfigurationCurve
    from assur.kinematics.assembly import Assembly

__all__ = ["Defects"]


@dataclass(frozen=True, slots=True)
class Defects:
    """What keeps a design from going through given positions (Chase and Mirth 1993).

    Attributes
    ----------
    circuit : bool
        Whether they lie on different circuits: the linkage would have to be taken apart.
    branch : bool
        Whether they lie on different branches: the driver cannot lead from one to another.
    order : bool
        Whether one circuit goes through all of them, but in another order, whichever way round.
    branches : tuple of int
        The branch of each.

    Examples
    --------
    The two assemblies of a crank-rocker lie on different circuits:

    >>> import assur
    >>> m = assur.FourBar(1.0, 3.0, 2.5, 3.0)
    >>> places = [(assembly.q, assembly) for assembly in m.assemblies(1.0)]
    >>> defects = m.configuration_curve().defects(places)
    >>> defects.circuit, defects.branches
    (True, (0, 1))
    """

    circuit: bool
    branch: bool
    order: bool
    branches: tuple[int, ...]


def defects_of(curve: ConfigurationCurve, places: Sequence[tuple[float, Assembly]]) -> Defects:
    """See `ConfigurationCurve.defects`."""
    try:
        pairs: list[Any] = list(places)
    except TypeError:
        # A number, an array without axes, one mechanism.
        pairs = [places]
    if not all(isinstance(pair, tuple | list) and len(pair) == 2 for pair in pairs):
        message = f"places is {short(places)}: pairs (q, assembly) are needed, as find() gives"
        raise InputError(message)
    located = [_located(curve, real_number(q, "q"), assembly) for q, assembly in pairs]
    homes = {number: i for i, c in enumerate(curve.circuits) for number, _ in c.branches}
    branches = tuple(number for number, _ in located)
    on_one = len({homes[number] for number in branches}) <= 1
    order = on_one and bool(located) and not _is_in_order(curve, homes[branches[0]], located)
    return Defects(not on_one, len(set(branches)) > 1, order, branches)


def _located(curve: ConfigurationCurve, q: float, assembly: Assembly) -> tuple[int, float]:
    """Return the branch of a position, and its q in the branch's counted turns."""
    mechanism = curve.mechanism
    size = size_of(mechanism)
    place = places_along(solve(mechanism, q, order=0, assembly=assembly, from_user=True), size)
    is_angle = has_driven_angle(mechanism)
    for number, branch in enumerate(curve.branches):
        low, high = ends_of(branch, mechanism) if is_angle else (branch.low, branch.high)
        turns = range(1)
        if is_angle:
            turns = range(math.ceil((low - q) / math.tau), math.floor((high - q) / math.tau) + 1)
        for turn in turns:
            there = q + math.tau * turn
            if not low <= there <= high:
                continue
            motion = solve(mechanism, there, order=0, assembly=branch.assembly, on_error="nan")
            if nearest(places_along(motion, size)[np.newaxis], place) <= SAME:
                return number, there
    message = f"no branch goes through q = {q!r} in {assembly!r}: give the curve more positions"
    raise InputError(message, value=q)


def _is_in_order(curve: ConfigurationCurve, circuit: int, located: list[tuple[int, float]]) -> bool:
    """Whether a circuit goes through positions in their order, one way round or the other."""
    ways = curve.circuits[circuit].branches
    places = []
    for number, q in located:
        step = next(i for i, (branch, _) in enumerate(ways) if branch == number)
        low, high = ends_of(curve.branches[number], curve.mechanism)
        part = (q - low) / (high - low)
        places.append(step + (part if ways[step][1] > 0 else 1.0 - part))
    # Rounded, so that the same place twice is not a step backward by a whole round.
    steps = np.diff(np.array([*places, places[0]]).round(9))
    if len(places) < 3 or not steps.any():
        return True
    if not curve.circuits[circuit].is_closed:
        steps = steps[:-1]
        return bool((steps > 0.0).all() or (steps < 0.0).all())
    # Round the circuit once: the steps, each in the direction of the motion, make one round.
    around = len(ways)
    return any(
        abs(float((np.sign(way) * steps % around).sum()) - around) < 0.5 for way in (1.0, -1.0)
    )
