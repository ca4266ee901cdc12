"""Deviations of paths without length, exactly straight or round, and with few positions."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import assur
from assur import metric
from models.mechanisms import named_drawings
from oracles.kinematics import textbook

Q = np.linspace(0.0, 2 * np.pi, 72, endpoint=False)


def off(m: assur.Mechanism, joint: str, q: Any = Q, **options: Any) -> dict[str, float]:
    """By shape and relative or not."""
    asked = {
        f"{shape} {relative}": metric.deviation(joint, shape=shape, relative=relative, **options)
        for shape in ("line", "circle")
        for relative in (False, True)
    }
    return {name: float(value) for name, value in assur.sweep(m, {}, q, metrics=asked).items()}


def test_a_point_that_stands() -> None:
    found = off(assur.FourBar(1.0, 3.0, 2.5, 3.0), "D")
    assert found["line False"] == found["circle False"] == 0.0
    assert np.isnan(found["line True"])
    assert np.isnan(found["circle True"])


@pytest.mark.parametrize("part", [0.1, 0.5, 1.0])
def test_a_circle(part: float) -> None:
    found = off(assur.FourBar(1.0, 3.0, 2.5, 3.0), "B", part=part)
    assert found["circle False"] < 1e-15
    assert found["circle True"] < 1e-15
    if part == 1.0:
        return  # lines of all directions fit equally well
    count = {0.1: 8, 0.5: 37}[part]
    circle = np.column_stack([np.cos(Q), np.sin(Q)])
    assert found["line False"] == pytest.approx(textbook.off_line(circle, count, True, False))


@pytest.mark.parametrize("angle", [0.0, 0.7, np.pi / 2])
@pytest.mark.parametrize("part", [0.1, 0.5, 1.0])
def test_a_straight_line(angle: float, part: float) -> None:
    """A circle may be infinitely large: it is no farther off than the line."""
    m = assur.SliderCrank(1.0, 3.0).with_dimensions({"bore.angle": angle})
    found = off(m, "B", Q + angle, part=part)
    assert found["line False"] < 1e-14
    assert found["line True"] < 1e-14
    assert found["circle False"] < 1e-14
    assert found["circle True"] < 1e-14


def test_peaucellier_draws_lines_and_circles() -> None:
    m = named_drawings.CLASS_II["peaucellier"]()
    low, high = named_drawings.RANGES["peaucellier"]
    q = np.linspace(low, high, 61)
    path = m.solve(q, order=0)
    for joint in m.joints:
        if joint in m.links["ground"]:
            continue
        found = off(m, joint, q, part=0.5)
        own = path.joint(joint).value
        off_line = textbook.off_line(own, 31, False, False)
        assert found["line False"] == pytest.approx(off_line, rel=1e-6, abs=1e-12)
        # The oracle has no circle through points on a line; it may be infinitely large.
        off_circle = 0.0 if off_line < 1e-12 else textbook.off_circle(own, 31, False, False)
        assert found["circle False"] == pytest.approx(off_circle, rel=1e-6, abs=1e-12)


def test_few_positions() -> None:
    m = assur.FourBar(1.0, 3.0, 2.5, 3.0)
    q = np.array([0.0, 0.5, 1.1, 1.4])
    path = m.solve(q, order=0).joint("C").value
    found = off(m, "C", q, part=1.0)
    assert found["line False"] == pytest.approx(textbook.off_line(path, 4, False, False), rel=1e-9)
    expected = textbook.off_circle(path, 4, False, True)
    assert found["circle True"] == pytest.approx(expected, rel=1e-7)
