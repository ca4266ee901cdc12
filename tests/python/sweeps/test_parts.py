"""Metrics over a part of the positions: its ends, its order, and too few positions."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import assur
from assur import metric
from oracles.kinematics import textbook

COUPLER = assur.Mechanism(
    joints={"A": (0, 0), "B": (1, 0), "C": (4.1, 3.2), "D": (4.8, 0), "P": (3, 4)},
    links={"ground": "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"},
    driver="crank",
)


def measured(q: Any, m: assur.Mechanism = COUPLER, **asked: metric.Metric) -> dict[str, float]:
    return {name: float(value) for name, value in assur.sweep(m, {}, q, metrics=asked).items()}


def has(q: Any, over: tuple[float, float], steps: range) -> bool:
    """Whether a part has the positions with these numbers, by the means of a point on the crank."""
    found = measured(q, x=metric.mean("B.x", over=over), y=metric.mean("B.y", over=over))
    inside = q[np.array(steps) % len(q)]
    expected = np.cos(inside).mean(), np.sin(inside).mean()
    return bool(np.allclose([found["x"], found["y"]], expected, rtol=0, atol=1e-13))


@pytest.mark.parametrize("steps", [36, 72, 360])
def test_ends_are_in_it_whatever_they_are_rounded_to(steps: int) -> None:
    q = np.linspace(0.0, 2 * np.pi, steps, endpoint=False)
    step = 360 // steps
    for first, last in ((0, 90), (30, 60), (60, 180), (350, 370), (300, 420), (270, 360)):
        steps_inside = range(first // step, last // step + 1)
        ends = np.radians(float(first)), np.radians(float(last))
        by_steps = first // step * (2 * np.pi / steps), last // step * (2 * np.pi / steps)
        sums = sum([np.radians(1.0)] * first), sum([np.radians(1.0)] * last)
        for over in (ends, by_steps, sums, (ends[0] - 2 * np.pi, ends[1] - 2 * np.pi)):
            assert has(q, over, steps_inside), (first, last)
    without_ends = range(30 // step + 1, 60 // step)
    assert has(q, (np.radians(30) + 1e-9, np.radians(60) - 1e-9), without_ends)


def test_ends_of_a_slide() -> None:
    cylinder = assur.Mechanism(
        joints={"A": (0, 0), "B": (1.0, 0), "C": (0.2, 0.9)},
        links={"ground": "AB", "boom": "AC", "barrel": ["B"], "rod": ["C"]},
        slides={
            "drive": assur.Slide("rod", "barrel", angle=float(np.arctan2(0.9, -0.8)), origin="B")
        },
        driver="drive",
    )
    q = np.arange(1.0, 1.61, 0.1)
    assert 1.0 + 0.1 + 0.1 + 0.1 != 1.3
    found = measured(q, cylinder, n=metric.span("drive", over=(1.1, 1.3)))
    assert found["n"] == pytest.approx(0.2, abs=1e-14)


@pytest.mark.parametrize("turn", [2 * np.pi, -2 * np.pi])
def test_a_window_across_the_end_of_the_turn_is_one_stretch(turn: float) -> None:
    q = np.linspace(0.0, turn, 72, endpoint=False)
    path = COUPLER.solve(q).joint("P").value
    over = (np.radians(300), np.radians(420))
    whole = np.take(path, range(60, 85) if turn > 0 else range(-84, -59), axis=0, mode="wrap")
    for shape, part in (("line", 1.0), ("line", 0.5), ("circle", 1.0), ("circle", 0.4)):
        oracle = {"line": textbook.off_line, "circle": textbook.off_circle}[shape]
        size = int(part * 24 + 1e-9) + 1
        asked = metric.deviation("P", shape=shape, part=part, over=over)  # type: ignore[arg-type]
        found = measured(q, off=asked)["off"]
        assert found == pytest.approx(oracle(whole, size, False, False), rel=1e-7)
    # Of all positions it is the whole path.
    every = measured(q, one=metric.deviation("P", over=(1.0, 9.0)), all=metric.deviation("P"))
    assert every["one"] == every["all"]


def test_the_first_of_equal_extremes_is_the_first_of_the_part() -> None:
    q = np.linspace(0.0, 2 * np.pi, 8, endpoint=False)
    place = metric.argmax("crank", order=1, over=(5.0, 7.5))
    assert measured(q, at=place)["at"] == q[7]


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        (metric.deviation("P", over=(0.0, 0.1)), "part=0.5 of 2 positions are 1: too few, 3"),
        (metric.deviation("P", part=1.0, over=(0.0, 0.1)), "positions are 2: too few, 3"),
        (metric.deviation("P", shape="circle", part=1.0, over=(0.0, 0.2)), "are 3: too few, 4"),
        (metric.deviation("P", over=(0.001, 0.002)), "of 0 positions are 0: too few, 3"),
        (metric.deviation("P", part=0.01), "part=0.01 of 72 positions are 1: too few, 3"),
    ],
)
def test_too_few_positions(asked: metric.Metric, message: str) -> None:
    q = np.linspace(0.0, 2 * np.pi, 72, endpoint=False)
    with pytest.raises(assur.InputError, match=message):
        measured(q, off=asked)
    with pytest.raises(assur.InputError, match=message):
        measured(q, off=1.0 + 2.0 * asked)


@pytest.mark.parametrize(
    "q",
    [
        np.linspace(0.0, 2 * np.pi, 73),
        np.linspace(0.0, 3 * np.pi, 72),
        np.linspace(0.0, 2 * np.pi, 72, endpoint=False)[::-1][np.arange(72) * 5 % 72],
    ],
)
def test_positions_that_do_not_follow_each_other(q: Any) -> None:
    over = (6.0, 7.0)
    found = measured(q, most=metric.max("P.y", over=over))
    inside = ((q - 6.0) % (2 * np.pi)) <= 1.0
    assert found["most"] == COUPLER.solve(q[inside]).joint("P").value[:, 1].max()
    with pytest.raises(assur.InputError, match="do not follow each other"):
        measured(q, off=metric.deviation("P", over=over))
