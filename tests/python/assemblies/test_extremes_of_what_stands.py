"""Derivatives of coordinates that stand, or turn evenly, while others go to infinity."""

from __future__ import annotations

import math

import numpy as np
import pytest

import assur


def double_rocker() -> tuple[dict[str, tuple[float, float]], dict[str, list[str]]]:
    m = assur.FourBar(3.0, 2.5, 2.0, 4.0)
    joints = {name: (float(x), float(y)) for name, (x, y) in m.joints.items()}
    return joints, {name: list(own) for name, own in m.links.items()}


def bar_on_the_coupler() -> assur.Mechanism:
    """A slide between two joints of the coupler: its value is constant."""
    joints, links = double_rocker()
    b, c = (np.array(joints[name]) for name in "BC")
    x, y = 0.3 * b + 0.7 * c + [0.4, 0.2]
    joints["P"] = (float(x), float(y))
    links["coupler"] = ["B", "C", "P"]
    links |= {"bar": ["B"], "block": ["P"]}
    slide = assur.Slide("block", on="bar", along=("B", "P"))
    return assur.Mechanism(joints, links, "crank", slides={"s": slide})


def parallelogram_on(pivot: str, pin: str, x: float) -> assur.Mechanism:
    """A second link parallel to the crank or the rocker, and a link between that translates."""
    joints, links = double_rocker()
    (x0, y0), (x1, y1) = joints[pivot], joints[pin]
    joints |= {"E": (x0 + x, y0 - 1.3), "F": (x1 + x, y1 - 1.3)}
    links["ground"].append("E")
    links |= {"parallel": ["E", "F"], "carried": [pin, "F"]}
    return assur.Mechanism(joints, links, "crank")


@pytest.mark.parametrize(
    ("mechanism", "name", "orders"),
    [
        (bar_on_the_coupler(), "s", (1, 2, 3)),
        (parallelogram_on("A", "B", 0.0), "carried", (1, 2, 3)),
        (parallelogram_on("A", "B", 0.0), "parallel", (2, 3)),
        (parallelogram_on("D", "C", 0.3), "carried", (1, 2, 3)),
        (bar_on_the_coupler(), "crank", (2, 3)),
    ],
)
def test_what_is_zero_has_no_poles(
    mechanism: assur.Mechanism, name: str, orders: tuple[int, ...]
) -> None:
    assert np.isfinite(mechanism.limits().intervals).all()
    for order in orders:
        found = mechanism.extremes(name, order=order)
        assert (found.min.value, found.max.value) == (0.0, 0.0)
        [low, high] = mechanism.limits().intervals[0]
        assert low <= found.min.q <= high
        for stretches in found.dwells(1e-3):
            assert stretches == [[low, high]]


def test_what_takes_part_keeps_its_poles() -> None:
    m = bar_on_the_coupler()
    for name in ("bar", "coupler", "rocker", "C.x"):
        ends = [m.extremes(name, order=order) for order in (1, 2, 3)]
        assert any(math.isinf(end.max.value) or math.isinf(end.min.value) for end in ends)
    # The link parallel to the rocker moves as the rocker does.
    m = parallelogram_on("D", "C", 0.3)
    for order in (0, 1, 2, 3):
        own, rocker = (m.extremes(name, order=order) for name in ("parallel", "rocker"))
        assert own.min.value == pytest.approx(rocker.min.value, rel=1e-9)
        assert own.max.value == pytest.approx(rocker.max.value, rel=1e-9)
