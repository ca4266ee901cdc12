"""What is asked of a search: conditions, limits of the work."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from assur import _core
from assur._arrays import real_number, short
from assur._validate import checked_threads, whole_number
from assur.errors import InputError

if TYPE_CHECKING:
    from assur.fitting.target import PathTarget

# A crank, a pivot and a dyad; beyond the greater number the search has no use for more.
JOINTS = (4, 40)
# An open path ends before the crank has gone round, rad.
MOST_ARC = 6.0
# The core's generator takes 64 bits; numbers of files and tables have 53.
MOST_SEED = 2**53


@dataclass(frozen=True, slots=True)
class Wanted:
    """Conditions that a linkage keeps, and how linkages are ranked."""

    joints: int
    min_apex_angle: float
    frame: float
    min_arc: float
    joint_price: float
    robust: float | None
    seed: int
    threads: int | None


def checked_wanted(
    target: PathTarget,
    joints: Any,
    min_apex_angle: Any,
    frame: Any,
    min_arc: Any,
    joint_price: Any,
    robust: Any,
    seed: Any,
    threads: Any,
) -> Wanted:
    """Return the conditions; errors name the argument, its number and what to do."""
    apex = _within(min_apex_angle, "min_apex_angle", 0.0, 0.5 * np.pi, "rad")
    size = real_number(frame, "frame")
    needed = 2.0 * target.reach
    if size < needed:
        message = (
            f"frame is {size:g}: the path itself needs {needed:.4g} of its radii; the frame is the "
            "diameter of the circle about the path's centroid that holds every joint"
        )
        raise InputError(message, value=size)
    arc = real_number(min_arc, "min_arc")
    if not 0.0 < arc <= MOST_ARC:
        message = (
            f"min_arc is {short(min_arc)} rad: more than 0 and at most {MOST_ARC:g} is needed, as "
            "an open path ends before the crank has gone round; closed=True closes the path"
        )
        raise InputError(message, value=arc)
    price = _within(joint_price, "joint_price", 0.0, 1.0, "")
    tolerance = None if robust is None else _within(robust, "robust", 0.0, 0.1, "")
    return Wanted(
        joints=whole_number(joints, "joints", *JOINTS),
        min_apex_angle=apex,
        frame=size,
        min_arc=arc,
        joint_price=price,
        robust=tolerance,
        seed=whole_number(seed, "seed", 0, MOST_SEED),
        threads=checked_threads(threads),
    )


def _within(value: Any, what: str, least: float, most: float, unit: str) -> float:
    """Return a number of at least the one and less than the other limit."""
    number = real_number(value, what)
    if not least <= number < most:
        of = f" {unit}" if unit else ""
        message = f"{what} is {number:g}{of}: from {least:g} to less than {most:.4g} is needed"
        if unit == "rad" and most < number <= 90.0:
            message += f"; np.deg2rad({number:g}) are degrees"
        raise InputError(message, value=number)
    return number


def started(target: PathTarget, wanted: Wanted) -> _core.PathSearch:
    """Return a search that has not begun."""
    # The core measures from the centroid.
    limits = (wanted.min_apex_angle, 0.5 * wanted.frame, wanted.min_arc, wanted.joint_price)
    return _core.PathSearch(
        target.points / target.unit,
        target.closed,
        wanted.joints,
        limits,
        wanted.seed,
        wanted.threads,
    )
