"""Extremes beside a change point that is missed by little, where a link turns within a few mrad."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import pytest
from numpy.typing import NDArray

import assur

if TYPE_CHECKING:
    from collections.abc import Callable

Array: TypeAlias = NDArray[np.float64]
Of: TypeAlias = "Callable[[float, int, Array], Array]"


# Greatest condition of a position with digits enough in its third derivatives.
DIGITS = 300.0


def whitworth(crank: float, at: float) -> assur.Mechanism:
    """An inverted slider-crank with a ground link of length 1, drawn at an angle of its crank."""
    pin = (crank * math.cos(at), crank * math.sin(at))
    return assur.Mechanism(
        {"O": (0, 0), "A": pin, "D": (1, 0)},
        {"ground": "OD", "crank": "OA", "lever": "D", "block": "A"},
        "crank",
        slides={"s": assur.Slide("block", on="lever", along=("A", "D"))},
    )


def lever(crank: float, order: int, q: Array) -> Array:
    """A derivative of its lever's angle, arg(u − 1) with u = crank · e^(iq)."""
    u = crank * np.exp(1j * q)
    first = u / (u - 1.0)
    return np.real((first, -1j * u / (u - 1.0) ** 2, -u * (u + 1.0) / (u - 1.0) ** 3)[order - 1])


def distance(crank: float, order: int, q: Array) -> Array:
    """A derivative of |u − 1|, from those of its logarithm."""
    u = crank * np.exp(1j * q)
    one = -np.imag(u / (u - 1.0))
    two = -np.imag(-1j * u / (u - 1.0) ** 2)
    three = -np.imag(-u * (u + 1.0) / (u - 1.0) ** 3)
    factor = (one, two + one**2, three + 3.0 * one * two + one**3)[order - 1]
    return np.asarray(np.abs(u - 1.0) * factor)


def greatest(of: Callable[[Array], Array], nearest: float) -> float:
    """The greatest value of a function over a turn, sharpest at 0, by scans ever closer."""
    side = np.geomspace(nearest, math.pi, 4001)
    q = np.concatenate([-side[::-1], [0.0], side])
    for _ in range(9):
        values = of(q)
        at = int(np.argmax(values))
        q = np.linspace(q[max(at - 1, 0)], q[min(at + 1, len(q) - 1)], 41)
    return float(of(q).max())


@pytest.mark.parametrize("order", [1, 2, 3])
@pytest.mark.parametrize("miss", [2e-3, -7.1e-3, -4.06e-4, 1.3e-2, -5.9e-5, 2.4e-5])
def test_an_inverted_slider_crank_with_crank_nearly_as_long_as_the_ground(
    miss: float, order: int
) -> None:
    for at in (0.73, -0.54, 2.2):
        m = whitworth(1.0 + miss, at)
        crank = m.dimensions["crank.length"]
        way = 1.0 if float(m.solve(0.5, order=1)["s"].d1) > 0.0 else -1.0
        for name, of, sign in (("lever", lever, 1.0), ("s", distance, way)):
            found = m.extremes(name, order=order)
            for end, side in ((found.max, 1.0), (found.min, -1.0)):

                def own(q: Array, of: Of = of, r: float = crank, way: float = side * sign) -> Array:
                    return way * of(r, order, q)

                right = greatest(own, 1e-3 * abs(miss))
                assert side * end.value == pytest.approx(right, rel=1e-7), (at, name)


def test_dwells_of_a_sharp_turn() -> None:
    """Where the rate of the lever is near its greatest: within some mrad."""
    m = whitworth(1.002, 0.73)
    found = m.extremes("lever", order=1)
    level = 0.5 * found.max.value
    _, [[low, high]] = found.dwells(level)
    assert low < 0.0 < high < 0.01
    for q in (low, high):
        rate = lever(m.dimensions["crank.length"], 1, np.array([q]))
        assert float(rate[0]) == pytest.approx(level, rel=1e-8)


@pytest.mark.parametrize("seed", range(3))
def test_four_bars_that_nearly_pass_a_change_point(seed: int) -> None:
    """No position of a scan is beyond an extreme; positions are denser where it is sharp."""
    rng = np.random.default_rng(seed)
    for part in range(6):
        miss = 10.0 ** rng.uniform(-4.0, -2.0) * rng.choice([-1.0, 1.0])
        a, b, c = rng.uniform(0.5, 2.5, 3)
        grounds = [length for length in (b + c - a, a + c - b, a + b - c) if length > 0.2]
        ground = rng.choice(grounds)
        lengths = (a, b, c, ground + miss) if part % 2 else (a, b + miss, a + 0.3 * miss, b)
        crank, coupler, rocker, base = (float(length) for length in lengths)
        m = assur.FourBar(crank, coupler, rocker, base)
        limits = m.limits()
        near = np.geomspace(1e-3 * abs(miss), math.pi, 1500)
        turn = (m.q0 - math.pi, m.q0 + math.pi)
        for interval in limits.intervals.tolist():
            low, high = interval if math.isfinite(interval[0]) else turn
            centres = [k * math.pi for k in range(-3, 4)]
            q = np.unique([at + side * near for at in centres for side in (-1, 1)])
            margin = 1e-3 * (high - low)
            motion = m.solve(q[(q > low + margin) & (q < high - margin)], order=3, on_error="nan")
            for name in ("coupler", "rocker"):
                for order in (1, 2, 3):
                    found = m.extremes(name, order=order)
                    values = getattr(motion.link(name), f"d{order}")[motion.condition < DIGITS]
                    slack = 1e-6 * float(np.nanmax(np.abs(values)))
                    assert np.nanmax(values) <= found.max.value + slack, (lengths, name, order)
                    assert np.nanmin(values) >= found.min.value - slack, (lengths, name, order)
