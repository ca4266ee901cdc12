"""Metrics as the core reads them: names become indices."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import numpy.typing as npt

from assur.errors import InputError
from assur.kinematics import transmission
from assur.sweeps import specs
from assur.sweeps.terms import Combination, Leaf, Metric

if TYPE_CHECKING:
    from assur.kinematics.mechanism import Mechanism

Float: TypeAlias = npt.NDArray[np.float64]


def encoded(metric: Metric, mechanism: Mechanism, q: Float) -> specs.Spec:
    """Return a metric without functions for the core; check that it has a meaning at q (flat)."""
    if isinstance(metric, Combination):
        left, right = (
            encoded(side, mechanism, q) if isinstance(side, Metric) else side
            for side in (metric.left, metric.right)
        )
        return specs.Combination(metric.sign, left, right)
    assert isinstance(metric, Leaf)
    spec = _leaf(metric, mechanism)
    if metric.over is not None:
        spec = specs.Part(spec, *metric.over, is_of_turn=_is_angle(mechanism))
    refusal = mechanism.core.refusal_of_metric(q, spec)
    if refusal is not None:
        message = f"{metric!r}: {refusal}"
        raise InputError(message)
    return spec


def _leaf(leaf: Leaf, mechanism: Mechanism) -> specs.Spec:
    if leaf.kind == "moves":
        return specs.Moves()
    assert leaf.of is not None
    if leaf.kind == "least_transmission":
        (first, second), complement = transmission.lines(mechanism, leaf.of, leaf.options[0])
        return specs.LeastTransmission(
            (_line(mechanism, first), _line(mechanism, second)), complement
        )
    if leaf.kind == "deviation":
        return specs.Deviation(mechanism.core.require("joint", leaf.of), *leaf.options)
    return specs.Scalar(leaf.kind, _coordinate(mechanism, leaf.of, leaf.order))


def _coordinate(mechanism: Mechanism, name: str, order: int) -> specs.Coordinate:
    joint, dot, axis = name.rpartition(".")
    if dot:
        if axis not in ("x", "y"):
            message = f'coordinate {name!r}: "{joint}.x" or "{joint}.y" is needed'
            raise InputError(message)
        index = mechanism.core.require("joint", joint)
        return specs.Coordinate("joint", index, "xy".index(axis), order)
    if name in mechanism.joint_names:
        message = f'coordinate {name!r} is a joint: "{name}.x" or "{name}.y" is needed'
        raise InputError(message, joint=name)
    kind = "slide" if name in mechanism.slides else "link"
    return specs.Coordinate(kind, mechanism.core.require(kind, name), 0, order)


def _line(mechanism: Mechanism, line: transmission.Line) -> specs.Line:
    if isinstance(line, transmission.JointLine):
        return specs.JointLine(*(mechanism.core.require("joint", joint) for joint in line))
    names, angle = mechanism.core.dimension_names, f"{line.slide}.angle"
    index = names.index(angle) if angle in names else None
    return specs.GuideLine(mechanism.core.require("link", line.link), index)


def _is_angle(mechanism: Mechanism) -> bool:
    driver = mechanism.description.drivers
    return not any(name in mechanism.slides for name in driver if isinstance(name, str))
