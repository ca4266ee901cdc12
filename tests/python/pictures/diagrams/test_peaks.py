"""Extremes between samples, against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest

from assur.pictures.diagrams.peaks import peaks

X = np.linspace(0.0, 6.0, 13)


def test_by_solving_again_with_slopes_and_by_a_parabola() -> None:
    """sin x has its extremes at π/2 and 3π/2; the samples are half a radian apart."""
    solved = peaks(X, np.sin(X), again=np.sin)
    cubic = peaks(X, np.sin(X), slope=np.cos(X))
    parabola = peaks(X, np.sin(X))
    for found, value, place in ((solved, 1e-6, 1e-3), (cubic, 2e-4, 1e-3), (parabola, 2e-3, 0.01)):
        for peak, x, y in zip(found, (math.pi / 2, 3 * math.pi / 2), (1.0, -1.0), strict=True):
            assert peak.x == pytest.approx(x, abs=place)
            assert peak.y == pytest.approx(y, abs=value)
            assert peak.greatest == (y > 0.0)


def test_a_cubic_and_a_parabola_are_exact() -> None:
    x = np.array([-2.0, -0.5, 0.9, 1.9])
    found = peaks(x, x**3 - 3.0 * x, slope=3.0 * x**2 - 3.0)
    assert [(round(p.x, 9), round(p.y, 9)) for p in found] == [(-1.0, 2.0), (-2.0, -2.0)]
    x = np.array([-1.0, 0.5, 3.0])
    assert peaks(x, 4.0 - (x - 0.3) ** 2)[0][:2] == pytest.approx((0.3, 4.0), rel=1e-12)


def test_gaps_ends_and_several_hills() -> None:
    y = np.sin(X)
    y[[3, 4]] = np.nan  # around π/2
    greatest, least = peaks(X, y, again=np.sin)
    assert (greatest.x, greatest.y) == pytest.approx((1.0, math.sin(1.0)))
    assert least.x == pytest.approx(3 * math.pi / 2, abs=1e-3)
    # The lower of two samples has the higher hill behind it.
    x = np.array([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0])

    def hills(at: np.ndarray) -> np.ndarray:
        return np.exp(-((at - 1.0) ** 2)) + 1.02 * np.exp(-4.0 * (at - 4.3) ** 2)

    assert np.argmax(hills(x)) == 1
    assert peaks(x, hills(x), again=hills)[0].x == pytest.approx(4.3, abs=1e-3)


def test_constants_and_nothing() -> None:
    assert peaks(X, np.full(13, 2.0)) == []
    assert peaks(X, np.full(13, np.nan)) == []
    assert peaks(X, 1.0 + 1e-12 * np.sin(X)) == []
    jump = peaks(np.array([0.0, 1.0, 1.0, 2.0]), np.array([0.0, 1.0, 3.0, 0.0]))
    assert jump[0][:2] == (1.0, 3.0)
