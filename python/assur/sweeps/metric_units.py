"""The units of metrics."""

from __future__ import annotations

from typing import TYPE_CHECKING

from assur.kinematics.table import driven_angles
from assur.sweeps.terms import Combination, Leaf

if TYPE_CHECKING:
    from assur.kinematics.mechanism import Mechanism
    from assur.sweeps.terms import Metric

# Metrics in the unit of their coordinate.
IN_ITS_UNIT = ("span", "min", "max", "mean", "rms", "function_error")
PLACES = ("argmin", "argmax")


def is_angle(metric: Metric, mechanism: Mechanism) -> bool:
    """Whether a metric is an angle, rad."""
    if isinstance(metric, Combination):
        # A factor may convert it to degrees.
        sides = (side for side in (metric.left, metric.right) if not isinstance(side, float))
        return metric.sign in "+-" and all(is_angle(side, mechanism) for side in sides)
    if not isinstance(metric, Leaf):
        return False
    if metric.kind == "min_transmission_angle":
        return True
    if metric.kind in PLACES:
        return driven_angles(mechanism)[0]
    is_link = metric.of in dict(mechanism.description.links)
    return _is_in_its_unit(metric) and metric.order == 0 and is_link


def unit_of_metric(metric: Metric, mechanism: Mechanism) -> str:
    """Return rad of an angle, m of a length, and nothing of what has another unit, or none."""
    if is_angle(metric, mechanism):
        return "rad"
    if not isinstance(metric, Leaf) or metric.order:
        return ""
    is_length = metric.kind == "deviation" and not metric.options[-1]
    return "m" if is_length or _is_in_its_unit(metric) or metric.kind in PLACES else ""


def _is_in_its_unit(metric: Leaf) -> bool:
    # With a free scale a function has the unit of its values.
    is_scaled = metric.kind == "function_error" and metric.options[-1] == "free"
    return metric.kind in IN_ITS_UNIT and not is_scaled
