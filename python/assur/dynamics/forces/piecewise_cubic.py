"""Cubics through samples of a function: its extremes and integrals between them.

Between two samples the function is the cubic through these and one neighbour on either side (at an
open end through the four samples there), written with the parameter 0 to 1 of the interval. For a
smooth function that is off by at most 3 h⁴ |f⁗| / 128 between samples h apart, at an open end by
h⁴ |f⁗| / 24 (the remainder of Lagrange's formula); steps need not be equal.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import as_number
from assur._extreme import Extreme
from assur._search import bisected

if TYPE_CHECKING:
    from collections.abc import Callable

    from assur._arrays import Float

__all__ = ["Pieces"]

# Roots are located to 1e-12 of an interval; the integral of |f| is off by the square of that.
HALVINGS = 40


class Pieces:
    """Cubics through values (..., N) at ascending or descending x (..., N).

    With `closed` the last sample is the first one again, a turn later.
    """

    def __init__(self, x: Float, values: Float, closed: bool) -> None:
        self.x, self.values = x, values
        self.width = np.diff(x, axis=-1)
        self.coefficients = _coefficients(x, values, closed)

    def integral(self) -> Float:
        """Return the integral over x."""
        a, b, c, d = self.coefficients
        total: Float = ((a + b / 2 + c / 3 + d / 4) * self.width).sum(axis=-1)
        return total

    def integral_of_size(self) -> Float:
        """Return the integral of the absolute value over |x|."""
        a, b, c, d = self.coefficients
        cuts = _roots_within(a, b, c, d)
        sizes = np.zeros(a.shape)
        for low, high in pairwise(cuts):
            first, last = (t * (a + t * (b / 2 + t * (c / 3 + t * (d / 4)))) for t in (low, high))
            sizes += np.abs(last - first)
        total: Float = (sizes * np.abs(self.width)).sum(axis=-1)
        return total

    def extreme(self, sign: float) -> Extreme:
        """Return the greatest value (sign 1) or the least (−1), and x there."""
        a, b, c, d = self.coefficients
        places = [np.zeros(a.shape), np.ones(a.shape), *_quadratic(b, 2 * c, 3 * d)]
        places = [np.clip(np.nan_to_num(t), 0.0, 1.0) for t in places]
        # At the samples the values are those given.
        heights = [self.values[..., :-1], self.values[..., 1:]]
        heights += [a + t * (b + t * (c + t * d)) for t in places[2:]]
        at = np.concatenate([self.x[..., :-1] + t * self.width for t in places], axis=-1)
        values = np.concatenate(heights, axis=-1)
        best = np.argmax(sign * values, axis=-1)[..., None]
        value = np.take_along_axis(values, best, axis=-1)[..., 0]
        place = np.take_along_axis(at, best, axis=-1)[..., 0]
        at_value = np.where(np.isnan(value), np.nan, place)
        return Extreme(value=as_number(value[()]), q=as_number(at_value[()]))


def _coefficients(x: Float, y: Float, closed: bool) -> tuple[Float, Float, Float, Float]:
    """Return a, b, c, d of a + b t + c t² + d t³ in every interval, t from 0 to 1."""
    count = x.shape[-1]
    intervals = np.arange(count - 1)
    if closed:
        # The last sample is the first: neighbours are counted without it, whole turns are added.
        turn = x[..., -1:] - x[..., :1]
        index = intervals[:, None] + np.arange(-1, 3)
        turns = np.floor_divide(index, count - 1)
        inside = index - turns * (count - 1)
        nodes = x[..., inside] + turns * turn[..., None]
        values = y[..., inside]
    else:
        used = min(count, 4)
        first = np.clip(intervals - 1, 0, count - used)
        index = first[:, None] + np.arange(used)
        nodes, values = x[..., index], y[..., index]
    start, width = x[..., :-1], np.diff(x, axis=-1)
    t = (nodes - start[..., None]) / width[..., None]
    # Newton's divided differences, then multiplied out from the last.
    table = [values[..., k] for k in range(values.shape[-1])]
    for order in range(1, len(table)):
        for k in range(len(table) - 1, order - 1, -1):
            table[k] = (table[k] - table[k - 1]) / (t[..., k] - t[..., k - order])
    out: list[Any] = [np.zeros(start.shape) for _ in range(4)]
    for k in range(len(table) - 1, -1, -1):
        shifted = [np.zeros(start.shape), *out[:3]]
        out = [s - t[..., k] * c for s, c in zip(shifted, out, strict=True)]
        out[0] = out[0] + table[k]
    return out[0], out[1], out[2], out[3]


def _quadratic(a: Float, b: Float, c: Float) -> list[Float]:
    """Return the real roots of a + b t + c t²; NaN or infinite where no real root exists."""
    with np.errstate(all="ignore"):
        root = np.sqrt(b * b - 4 * a * c)
        q = -0.5 * (b + np.copysign(root, b))
        roots = [q / c, a / q]
    return [np.where(np.isfinite(t), t, np.nan) for t in roots]


def _roots_within(a: Float, b: Float, c: Float, d: Float) -> list[Float]:
    """Return 0, ascending points between which the cubics have one sign, and 1.

    Between its extremes a cubic is monotone: bisection finds each of its roots.
    """
    turns = [np.clip(np.nan_to_num(t), 0.0, 1.0) for t in _quadratic(b, 2 * c, 3 * d)]
    zero, unit = np.zeros(a.shape), np.ones(a.shape)
    ends = np.sort(np.stack([zero, *turns, unit]), axis=0)

    def value(t: Float) -> Float:
        return a + t * (b + t * (c + t * d))

    return [zero, *(_root(value, low, high) for low, high in pairwise(ends)), unit]


def _root(value: Callable[[Float], Float], low: Float, high: Float) -> Float:
    """Return where functions that are monotone from low to high change their sign, or high."""
    sign = np.sign(value(low))
    changes = sign * np.sign(value(high)) < 0.0
    if not changes.any():
        return high
    _, far = bisected(lambda t: np.sign(value(t)) == sign, low, high, HALVINGS)
    return np.where(changes, far, high)
