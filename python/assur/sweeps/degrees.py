"""Angles of a sweep that look like degrees: its coordinates, parts of the turn, and limits."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

import numpy as np

from assur.errors import AssurWarning
from assur.kinematics.solve_arguments import LIKE_DEGREES, warn_if_degrees
from assur.kinematics.table import driven_angles
from assur.sweeps.terms import Combination, Leaf

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.kinematics.mechanism import Mechanism
    from assur.sweeps.measuring import Measuring
    from assur.sweeps.terms import Condition, Metric

# Metrics in the unit of their coordinate.
IN_ITS_UNIT = ("span", "min", "max", "mean", "rms")
PLACES = ("argmin", "argmax")


def warn_of_degrees(mechanism: Mechanism, q: Float, measuring: Measuring | None = None) -> None:
    """Warn of angles in rad that look like degrees; `sweep` calls it."""
    warn_if_degrees(mechanism, q)
    if measuring is None:
        return
    for leaf in measuring.leaves:
        # `over` needs one driver.
        if leaf.over is not None and driven_angles(mechanism)[0] and _are_whole(*leaf.over):
            most = max(map(abs, leaf.over))
            message = (
                f"{leaf!r}: over is in rad, {most:g} rad are {most / (2.0 * np.pi):.3g} turns; for "
                f"degrees: np.radians({most:g})"
            )
            warnings.warn(message, AssurWarning, stacklevel=3)
    for condition in measuring.conditions:
        if _is_in_degrees(condition, mechanism):
            limit = condition.limit
            message = f"{condition!r}: {limit:g} is in rad; {limit:g}° is np.radians({limit:g})"
            warnings.warn(message, AssurWarning, stacklevel=3)


def _are_whole(*ends: float) -> bool:
    """Whether both ends look like degrees, as coordinates do."""
    least, most = LIKE_DEGREES
    return all(end.is_integer() for end in ends) and least < max(map(abs, ends)) < most


def _is_in_degrees(condition: Condition, mechanism: Mechanism) -> bool:
    """Whether the limit of an angle is more than a turn, and a whole number."""
    metric, limit = condition.metric, abs(condition.limit)
    is_large = limit > 2.0 * np.pi
    # A link may turn several times, a transmission angle is at most π/2.
    never = isinstance(metric, Leaf) and metric.kind == "min_transmission_angle"
    return is_large and (never or limit.is_integer()) and _is_angle(metric, mechanism)


def _is_angle(metric: Metric, mechanism: Mechanism) -> bool:
    if isinstance(metric, Combination):
        # A factor may convert it to degrees.
        sides = (side for side in (metric.left, metric.right) if not isinstance(side, float))
        return metric.sign in "+-" and all(_is_angle(side, mechanism) for side in sides)
    if not isinstance(metric, Leaf):
        return False
    if metric.kind == "min_transmission_angle":
        return True
    if metric.kind in PLACES:
        return driven_angles(mechanism)[0]
    is_link = metric.of in dict(mechanism.description.links)
    return metric.kind in IN_ITS_UNIT and metric.order == 0 and is_link


def unit_of_metric(metric: Metric, mechanism: Mechanism) -> str:
    """Return rad of an angle, m of a length, and nothing of what has another unit, or none."""
    if _is_angle(metric, mechanism):
        return "rad"
    if not isinstance(metric, Leaf) or metric.order:
        return ""
    is_length = metric.kind == "deviation" and not metric.options[-1]
    return "m" if is_length or metric.kind in (*IN_ITS_UNIT, *PLACES) else ""
