"""The searches that the package shares, against roots and maxima in closed form."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from assur._search import bisected, narrowed

if TYPE_CHECKING:
    from assur._arrays import Float


def test_roots_to_the_last_bit_all_together() -> None:
    squares = np.arange(2.0, 50.0)
    low, high = bisected(lambda x: x * x < squares, np.zeros(48), squares, 70)
    assert (np.abs(low - np.sqrt(squares)) <= np.spacing(low)).all()
    assert (high - low <= np.spacing(low)).all()
    assert ((low * low < squares) & (high * high >= squares)).all()


def test_one_number_a_descending_interval_and_none() -> None:
    low, high = bisected(lambda x: x > math.pi, 4.0, 3.0, 60)
    assert float(high) <= math.pi < float(low) <= float(np.nextafter(high, 4.0))
    nothing = np.empty(0)
    assert bisected(lambda _: 1 / 0, nothing, nothing, 9)[0].size == 0
    assert [float(end) for end in bisected(lambda _: 1 / 0, 1.0, 2.0, 0)] == [1.0, 2.0]


def test_maxima_between_neighbours() -> None:
    tops = np.array([0.3, 2.0, -1.0])
    asked: list[Float] = []

    def height(x: Float) -> Float:
        asked.append(x)
        heights: Float = -np.square(x - tops[:, None])
        return heights

    # The last lies on an end: it is found there.
    low, high = np.array([0.0, 1.5, -1.0]), np.array([1.0, 3.0, 0.0])
    tried, best = narrowed(height, low, high, 11, 1e-8)
    assert tried.shape == (3, 11)
    np.testing.assert_allclose(tried[np.arange(3), best], tops, rtol=0.0, atol=1e-8)
    # A round leaves a tenth to a fifth of the interval: 10⁸ < 5¹².
    assert 8 <= len(asked) - 1 <= 12
