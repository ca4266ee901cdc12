"""Assemblies of a group counted by a scan: one link is turned by hand, one bar is left out.

What remains are dyads; the number of assemblies is the number of turns at which the bar left out
fits. Nothing but plane geometry with NumPy.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import product
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

Complex: TypeAlias = npt.NDArray[np.complex128]
Float: TypeAlias = npt.NDArray[np.float64]
# The misfit at turns of the first link, given the signs of the dyads; NaN where one does not close.
Misfit: TypeAlias = Callable[[Float, tuple[int, ...]], Float]

# Samples toward the end of a stretch, where the misfit goes as a square root.
NEAR_END = 1.0 - np.linspace(1.0, 0.0, 40) ** 2


def circles(a: Complex, r: float, b: Complex | complex, s: float, sign: int) -> Complex:
    """Where a circle about `a` meets one about `b`; +1: to the left of the ray from a to b."""
    d = b - a
    d2 = np.abs(d) ** 2
    along = 0.5 * (1.0 + (r * r - s * s) / d2)
    across = np.sqrt(r * r / d2 - along**2)
    return np.asarray(a + d * (along + 1j * sign * across))


def line(
    a: Complex, r: float, point: Complex | complex, way: Complex | complex, sign: int
) -> Complex:
    """Where a circle about `a` meets the line through `point` along the unit vector `way`."""
    foot = (a - point) * np.conj(way)
    across2 = r * r - foot.imag**2
    return np.asarray(point + way * (foot.real + sign * np.sqrt(across2)))


def carried(given: complex, base: complex, drawn: complex, at: Complex, tip: Complex) -> Complex:
    """A point of a link drawn at `given`, when its points drawn at `base` and `drawn` are moved."""
    return at + (given - base) * (tip - at) / (drawn - base)


@dataclass(frozen=True)
class _Branch:
    """The misfit with certain signs of the dyads."""

    misfit: Misfit
    signs: tuple[int, ...]

    def __call__(self, turns: Float) -> Float:
        return self.misfit(turns, self.signs)


def count(misfit: Misfit, dyads: int, samples: int) -> int:
    """Number of assemblies found with so many samples a turn."""
    every = product((1, -1), repeat=dyads)
    branches = [_Branch(misfit, signs) for signs in every]
    turns = np.linspace(0.0, 2.0 * np.pi, samples + 1) + 0.123
    with np.errstate(invalid="ignore", divide="ignore"):
        for _ in range(2):
            # At the end of a branch another one may begin that is shorter than a step.
            turns = np.unique(np.concatenate([turns, *(_ends(of, turns) for of in branches)]))
        return sum(
            _roots(of, turns[start:stop]) for of in branches for start, stop in _runs(of(turns))
        )


def _roots(of: _Branch, turns: Float) -> int:
    """Roots on a stretch: changes of sign, and pairs of them beside a smallest misfit."""
    values = of(turns)
    positive = values > 0.0
    changes = int(np.count_nonzero(positive[1:] != positive[:-1]))
    size = np.abs(values)
    low = (size[1:-1] <= size[:-2]) & (size[1:-1] <= size[2:])
    alike = (positive[1:-1] == positive[:-2]) & (positive[1:-1] == positive[2:])
    dips = np.flatnonzero(low & alike)
    left, right, side = turns[dips], turns[dips + 2], np.where(positive[dips + 1], 1.0, -1.0)
    least = np.full(len(dips), np.inf)
    for _ in range(80):
        third = (right - left) / 3.0
        a, b = side * of(left + third), side * of(right - third)
        least = np.minimum(least, np.minimum(a, b))
        left, right = np.where(a > b, left + third, left), np.where(a > b, right, right - third)
    return changes + 2 * int(np.count_nonzero(least < 0.0))


def _ends(of: _Branch, turns: Float) -> Float:
    """Turns toward the ends of all stretches over which the dyads close, ends included."""
    closes = np.isfinite(of(turns))
    edges = np.flatnonzero(closes[1:] != closes[:-1])
    before = closes[edges]
    inside = np.where(before, turns[edges], turns[edges + 1])
    last, beyond = inside, np.where(before, turns[edges + 1], turns[edges])
    for _ in range(60):
        middle = 0.5 * (last + beyond)
        fits = np.isfinite(of(middle))
        last, beyond = np.where(fits, middle, last), np.where(fits, beyond, middle)
    return np.ravel(inside[:, None] + (last - inside)[:, None] * NEAR_END)


def _runs(values: Float) -> Iterator[tuple[int, int]]:
    """Stretches of finite values."""
    padded = np.concatenate([[False], np.isfinite(values), [False]])
    changes = np.flatnonzero(padded[1:] != padded[:-1])
    return zip(changes[::2].tolist(), changes[1::2].tolist(), strict=True)
