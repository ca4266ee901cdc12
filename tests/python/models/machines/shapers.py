"""A slider-crank in closed form, with NumPy alone: the oracle of loads over its slide."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.integrate import quad

import assur

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["CRANK", "ROD", "STROKE", "TURN", "integral", "place", "slider", "turning"]

CRANK, ROD, TURN = 0.1, 0.4, math.tau
# The least and the greatest value of the slide.
STROKE = ROD - CRANK, ROD + CRANK


def slider() -> assur.Mechanism:
    return assur.SliderCrank(crank=CRANK, rod=ROD)


def place(q: Any) -> tuple[Any, Any]:
    """The slide's value and its derivative."""
    sine, cosine = np.sin(q), np.cos(q)
    root = np.sqrt(ROD**2 - (CRANK * sine) ** 2)
    return CRANK * cosine + root, -CRANK * sine - CRANK**2 * sine * cosine / root


def turning(x: float) -> float:
    """The crank's angle from 0 to π at which the slide has a value: by the law of cosines."""
    return math.acos((CRANK**2 + x**2 - ROD**2) / (2.0 * CRANK * x))


def integral(function: Callable[[float], float], start: float, end: float, *cuts: float) -> float:
    """An integral, cut where the function is not smooth."""
    nodes = sorted({start, end, *(cut for cut in cuts if start < cut < end)})
    parts = itertools.pairwise(nodes)
    return sum(quad(function, a, b, epsabs=1e-13, epsrel=1e-13)[0] for a, b in parts)
