"""What a configuration curve consists of."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from assur.kinematics.configuration import lengths

if TYPE_CHECKING:
    from assur.kinematics.assembly import Assembly
    from assur.kinematics.model import MechanismModel

__all__ = ["Branch", "Circuit", "Fold"]

# Positions nearer than this (relative to the size) are those of one assembly.
SAME = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class Branch:
    """A stretch of the curve between two dead points of the driver.

    Attributes
    ----------
    assembly : Assembly
        Leads to every position of it: ``solve(q, assembly=branch.assembly)``.
    low, high : float
        Where it ends, rad (in counted turns) or m; infinite if the driver goes round.
    period : int or None
        Turns after which it closes, if the driver goes round.
    folds : tuple of int or None
        Indices of the folds at its low and its high end.

    Examples
    --------
    >>> import assur
    >>> branch = assur.FourBar(3.0, 2.5, 2.0, 4.0).configuration_curve().branches[0]
    >>> round(branch.low, 6), round(branch.high, 6), branch.period
    (-1.371564, 1.371564, None)
    """

    assembly: Assembly
    low: float
    high: float
    period: int | None
    folds: tuple[int | None, int | None] = (None, None)


@dataclass(frozen=True, slots=True, eq=False)
class Fold:
    """A dead point of the driver, where two branches meet.

    Attributes
    ----------
    q : float
        Coordinate of the driver, rad or m.
    group : str or None
        The dyad or group that is flat there.
    branches : tuple of int
        Indices of the branches.
    is_greatest : bool
        Whether q is greatest there on both branches, or least.

    Examples
    --------
    >>> import assur
    >>> folds = assur.FourBar(3.0, 2.5, 2.0, 4.0).configuration_curve().folds
    >>> [(round(fold.q, 6), fold.group, fold.is_greatest) for fold in folds]
    [(-1.371564, 'II(coupler, rocker)', False), (1.371564, 'II(coupler, rocker)', True)]
    """

    q: float
    group: str | None
    branches: tuple[int, int]
    is_greatest: bool


@dataclass(frozen=True, slots=True, eq=False)
class Circuit:
    """All positions that can be reached without taking the mechanism apart.

    Attributes
    ----------
    branches : tuple of (int, int)
        Indices of its branches in the order of the motion, each with the direction of q (+1 or −1).
    turns : int
        Turns of the driver when the motion closes: 0 if it swings between dead points.
    is_closed : bool
        Whether the motion closes; if not, it goes from one end to the other, where a joint goes to
        infinity or a slide that is a length reaches 0.

    Examples
    --------
    >>> import assur
    >>> circuit = assur.FourBar(3.0, 2.5, 2.0, 4.0).configuration_curve().circuits[0]
    >>> circuit.branches, circuit.turns, circuit.is_closed
    (((0, 1), (1, -1)), 0, True)
    """

    branches: tuple[tuple[int, int], ...]
    turns: int
    is_closed: bool


def ends_of(branch: Branch, mechanism: MechanismModel) -> tuple[float, float]:
    """Return the ends of a branch; one that closes begins at the drawing's coordinate.

    A slide that nothing stops goes as far as the sum of all lengths from there.
    """
    q0 = float(np.ravel(mechanism.q0)[0])
    if branch.period is not None:
        return q0, q0 + math.tau * branch.period
    reach = sum(lengths(mechanism))
    low = branch.low if math.isfinite(branch.low) else min(q0, branch.high) - reach
    high = branch.high if math.isfinite(branch.high) else max(q0, branch.low) + reach
    return low, high


def has_driven_angle(mechanism: MechanismModel) -> bool:
    """Whether the driver is an angle, not a slide."""
    driver = mechanism.description.drivers[0]
    return not isinstance(driver, str) or driver not in mechanism.slides
