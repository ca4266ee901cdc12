"""Angles of a sweep that look like degrees: its coordinates, parts of the turn, and limits."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

import numpy as np

from assur.errors import AssurWarning
from assur.kinematics.solve_arguments import LIKE_DEGREES, warn_if_degrees
from assur.kinematics.table import driven_angles
from assur.sweeps.metric_units import is_angle
from assur.sweeps.terms import Leaf

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.kinematics.mechanism import Mechanism
    from assur.sweeps.measuring import Measuring
    from assur.sweeps.terms import Condition


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
    return is_large and (never or limit.is_integer()) and is_angle(metric, mechanism)
