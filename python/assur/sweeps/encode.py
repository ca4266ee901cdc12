"""Metrics as the core takes them: names become indices."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from assur.errors import InputError
from assur.kinematics import transmission
from assur.sweeps.terms import Combination, Leaf, Metric

if TYPE_CHECKING:
    from assur.kinematics.mechanism import Mechanism

Float: TypeAlias = npt.NDArray[np.float64]


def encoded(metric: Metric | float, mechanism: Mechanism, q: Float) -> Any:
    """Return a metric without functions for the core, and check that it has a meaning at q (flat).

    Numbers beside metrics stay as they are.
    """
    if isinstance(metric, Combination):
        sides = (encoded(side, mechanism, q) for side in (metric.left, metric.right))
        return ("combination", metric.sign, *sides)
    if not isinstance(metric, Leaf):
        return metric
    spec = _leaf(metric, mechanism)
    if metric.over is not None:
        spec = ("part", (*metric.over, _is_angle(mechanism)), spec)
    refusal = mechanism._core.refusal_of_metric(q, spec)
    if refusal is not None:
        message = f"{metric!r}: {refusal}"
        raise InputError(message)
    return spec


def _leaf(leaf: Leaf, mechanism: Mechanism) -> tuple[Any, ...]:
    if leaf.kind == "moves":
        return ("moves",)
    assert leaf.of is not None
    if leaf.kind == "least_transmission":
        pair, complement = transmission.lines(mechanism, leaf.of, leaf.options[0])
        return (leaf.kind, *(_line(mechanism, line) for line in pair), complement)
    if leaf.kind == "deviation":
        joint = mechanism._core.require("joint", leaf.of)
        return (leaf.kind, (joint, *leaf.options))
    return (leaf.kind, _coordinate(mechanism, leaf.of, leaf.order))


def _coordinate(mechanism: Mechanism, name: str, order: int) -> tuple[str, int, int, int]:
    joint, dot, axis = name.rpartition(".")
    if dot:
        if axis not in ("x", "y"):
            message = f'coordinate {name!r}: "{joint}.x" or "{joint}.y" is needed'
            raise InputError(message)
        return "joint", mechanism._core.require("joint", joint), "xy".index(axis), order
    if name in mechanism._joint_names:
        message = f'coordinate {name!r} is a joint: "{name}.x" or "{name}.y" is needed'
        raise InputError(message, joint=name)
    kind = "slide" if name in mechanism.slides else "link"
    return kind, mechanism._core.require(kind, name), 0, order


def _line(mechanism: Mechanism, line: transmission.Line) -> tuple[Any, ...]:
    if isinstance(line, transmission.JointLine):
        return ("joints", *(mechanism._core.require("joint", joint) for joint in line))
    names, angle = mechanism._core.dimension_names, f"{line.slide}.angle"
    index = names.index(angle) if angle in names else None
    return ("guide", mechanism._core.require("link", line.link), index)


def _is_angle(mechanism: Mechanism) -> bool:
    driver = mechanism._description.drivers
    return not any(name in mechanism.slides for name in driver if isinstance(name, str))
