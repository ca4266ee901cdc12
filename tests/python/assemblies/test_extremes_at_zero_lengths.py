"""Extremes of a cylinder that passes length 0, wherever that is from the drawing."""

from __future__ import annotations

import math

import numpy as np
import pytest

import assur

# The boom's turn from the position opposite to the one where the cylinder has no length.
TURNS = (0.0, 1e-9, -1e-9, 1e-6, 0.3, math.pi / 2, -2.9)


def boom(turn: float) -> assur.Mechanism:
    """A cylinder from a joint on the circle of a boom's eye: of length 10 |sin(q/2)|."""
    at = math.pi + turn
    return assur.Mechanism(
        {
            "foot": (-2, 1),
            "eye": (-2 + 5 * math.cos(at), 1 + 5 * math.sin(at)),
            "base": (3, 1),
            "lug": (4, 3),
        },
        {
            "ground": ["foot", "base"],
            "boom": ["foot", "eye"],
            "barrel": ["base", "lug"],
            "rod": ["eye"],
        },
        "boom",
        slides={
            "lift": assur.Slide(
                "rod", on="barrel", along=("base", "eye"), origin="base", length=True
            )
        },
    )


@pytest.mark.parametrize("turn", TURNS)
def test_a_length_has_a_kink_at_zero(turn: float) -> None:
    m = boom(turn)
    for order, least, greatest in (
        (0, 0.0, 10.0),
        (1, -5.0, 5.0),
        (2, -2.5, 0.0),
        (3, -1.25, 1.25),
    ):
        found = m.extremes("lift", order=order)
        assert found.min.value == pytest.approx(least, abs=1e-9), order
        assert found.max.value == pytest.approx(greatest, abs=1e-9), order
    at = m.extremes("lift").min.q
    assert math.remainder(at, math.tau) == pytest.approx(0.0, abs=1e-12)
    # It turns evenly, and by half a turn at length 0: once round in a turn of the boom.
    with pytest.raises(assur.InputError, match="turns fully"):
        m.extremes("rod")
    rate = m.extremes("rod", order=1)
    assert (rate.min.value, rate.max.value) == pytest.approx((0.5, 0.5), abs=1e-7)
    # What does not depend on it is smooth there.
    assert m.extremes("eye.x").max.value == pytest.approx(3.0, abs=1e-14)


@pytest.mark.parametrize("turn", TURNS)
def test_dwells_about_length_zero(turn: float) -> None:
    m = boom(turn)
    half = 2.0 * math.asin(0.05)
    [[low, high]], _ = m.extremes("lift").dwells(0.5)
    middle = round(0.5 * (low + high) / math.tau) * math.tau
    assert (low - middle, high - middle) == pytest.approx((-half, half), abs=1e-8)
    # The rate, 5 cos(q/2) on one side, steps from −5 to 5.
    half = 2.0 * math.acos(0.9)
    least, greatest = m.extremes("lift", order=1).dwells(0.5)
    for stretches, ends in ((least, (-half, 0.0)), (greatest, (0.0, half))):
        [[low, high]] = stretches
        turns = round((0.5 * (low + high) - 0.5 * sum(ends)) / math.tau) * math.tau
        assert (low - turns, high - turns) == pytest.approx(ends, abs=2e-6)


@pytest.mark.parametrize("turn", TURNS)
def test_a_joint_of_the_barrel_steps_at_length_zero(turn: float) -> None:
    m = boom(turn)
    q = np.concatenate([np.linspace(1e-5, math.tau - 1e-5, 4001), [1e-5, math.tau - 1e-5]])
    lug = m.solve(q, order=1).joint("lug")
    for component, name in enumerate(("lug.x", "lug.y")):
        for order, values in ((0, lug.value), (1, lug.d1)):
            found = m.extremes(name, order=order)
            own = values[:, component]
            assert found.min.value == pytest.approx(float(own.min()), abs=2e-5)
            assert found.max.value == pytest.approx(float(own.max()), abs=2e-5)
