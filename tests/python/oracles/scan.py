"""Assemblies of a group counted by a scan: one link is turned by hand, one bar or block is left out.

What remains are dyads; the number of assemblies is the number of turns at which the bar left out
fits. Nothing but plane geometry with NumPy.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
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


def line(a: Complex, r: float, point: Complex | complex, way: Complex | complex, sign: int) -> Complex:
    """Where a circle about `a` meets the line through `point` along the unit vector `way`."""
    foot = (a - point) * np.conj(way)
    across2 = r * r - foot.imag**2
    return np.asarray(point + way * (foot.real + sign * np.sqrt(across2)))


def carried(given: complex, base: complex, drawn: complex, at: Complex, tip: Complex) -> Complex:
    """A point of a link drawn at `given`, when its points drawn at `base` and `drawn` are moved."""
    return at + (given - base) * (tip - at) / (drawn - base)


def count(misfit: Misfit, dyads: int, samples: int) -> int:
    """Number of assemblies found with so many samples a turn."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return sum(
            _sign_changes(misfit(turns, signs))
            for signs in product((1, -1), repeat=dyads)
            for turns in _stretches(lambda turns, signs=signs: misfit(turns, signs), samples)
        )


def _sign_changes(values: Float) -> int:
    return int(np.count_nonzero(np.diff(values > 0.0)))


def _stretches(of: Callable[[Float], Float], samples: int) -> Iterator[Float]:
    """Turns on each stretch over which all dyads close, its ends included."""
    turns = np.linspace(0.0, 2.0 * np.pi, samples + 1) + 0.123
    closes = np.isfinite(of(turns))
    edges = np.flatnonzero(closes[1:] != closes[:-1])
    inside = np.where(closes[edges], turns[edges], turns[edges + 1])
    last, beyond = inside.copy(), np.where(closes[edges], turns[edges + 1], turns[edges])
    for _ in range(60):
        middle = 0.5 * (last + beyond)
        fits = np.isfinite(of(middle))
        last, beyond = np.where(fits, middle, last), np.where(fits, beyond, middle)
    for start, stop in _runs(closes):
        stretch = [turns[start:stop]]
        at_start = np.flatnonzero(edges == start - 1)
        at_stop = np.flatnonzero(edges == stop - 1)
        if at_start.size:
            way = inside[at_start[0]] + (last[at_start[0]] - inside[at_start[0]]) * NEAR_END
            stretch.insert(0, way[:0:-1])
        if at_stop.size:
            way = inside[at_stop[0]] + (last[at_stop[0]] - inside[at_stop[0]]) * NEAR_END
            stretch.append(way[1:])
        yield np.concatenate(stretch)


def _runs(closes: npt.NDArray[np.bool_]) -> Iterator[tuple[int, int]]:
    padded = np.concatenate([[False], closes, [False]])
    changes = np.flatnonzero(padded[1:] != padded[:-1])
    return zip(changes[::2].tolist(), changes[1::2].tolist(), strict=True)
