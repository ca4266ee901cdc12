"""Helpers for the tests of the examples."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

import assur
from assur import examples
from models.mechanisms import named_drawings

if TYPE_CHECKING:
    from collections.abc import Iterator

Float: TypeAlias = npt.NDArray[np.float64]

TURN = np.linspace(0.0, math.tau, 721)
EXACT = 1e-14  # of the size: some tens of roundings, where the condition is below 10
STRAIGHT = 1e-13  # of the size: the same with a condition near the ends of the range of 20


def diagonals(drivers: int) -> Iterator[tuple[bool, ...]]:
    """Which drivers run backwards: every diagonal once."""
    return itertools.product((False,), *[(False, True)] * (drivers - 1))


def between(ends: Any, count: int) -> Float:
    """From the one end to the other: (N,), or (N, n) for n drivers: along its diagonals."""
    low, high = (np.array(end) for end in ends)
    if low.ndim == 0:
        return np.linspace(float(low), float(high), count)
    paths = []
    for backwards in diagonals(len(low)):
        start, stop = np.where(backwards, high, low), np.where(backwards, low, high)
        paths.append(start + np.linspace(0.0, 1.0, count)[:, np.newaxis] * (stop - start))
    return np.concatenate(paths)


def coordinates(name: str, count: int = 241) -> Float:
    """Over the whole range of a shared drawing of class II."""
    return between(named_drawings.RANGES[name], count)


def over_range(name: str, count: int = 241) -> Float:
    """Over the whole range of an example."""
    return between(examples.RANGES[name], count)


def mechanism_of(example: assur.Mechanism | assur.Machine) -> assur.Mechanism:
    found = example.mechanism if isinstance(example, assur.Machine) else example
    assert found is not None
    return found


def distance(motion: assur.Motion, a: str, b: str) -> Float:
    """Between two joints."""
    gap: Float = np.hypot(*np.moveaxis(motion.joint(a).value - motion.joint(b).value, -1, 0))
    return gap


def span(mechanism: assur.Mechanism) -> float:
    """Greatest distance of drawn joints."""
    places = list(mechanism.joints.values())
    return max(math.dist(a, b) for a, b in itertools.combinations(places, 2))
