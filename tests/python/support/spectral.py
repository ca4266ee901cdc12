"""Derivatives of a function that is only evaluated: by the polynomial through Chebyshev's points.

On a short interval the polynomial of degree 20 is the function to rounding where the function is
analytic around it (L. N. Trefethen, Spectral Methods in MATLAB, 2000, chapter 6). Its derivative in
the middle loses the digits by which the interval is shorter than the unit. Beside a fold only the
shortest intervals are free of it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

DEGREE = 20
PLACES = np.cos(np.pi * np.arange(DEGREE + 1) / DEGREE)
# Half widths: too long a one meets what is not analytic, too short a one rounding.
WIDTHS = (1e-1, 5e-2, 2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5)


def _weights() -> Any:
    """The middle row of the differentiation matrix."""
    ends = np.ones(DEGREE + 1)
    ends[0] = ends[-1] = 2.0
    middle = DEGREE // 2
    signs = (-1.0) ** (middle + np.arange(DEGREE + 1))
    others = np.arange(DEGREE + 1) != middle
    weights = np.zeros(DEGREE + 1)
    weights[others] = signs[others] / ends[others] / -PLACES[others]
    return weights


WEIGHTS = _weights()


def derivative(values: Callable[[Any], Any], unit: float = 1.0) -> tuple[Any, Any]:
    """The derivative at 0 of a function of many places at once, and how well it is known.

    Of neighbouring widths the two that agree best decide, entry by entry; how well is their
    difference, and no better than the rounding of the values allows. It is infinite where none
    agree because the function has no value beside 0.
    """
    found, rounding = [], []
    for width in WIDTHS:
        sampled = values(PLACES * width * unit)
        found.append(np.tensordot(WEIGHTS, sampled, axes=1) / (width * unit))
        size = np.finfo(float).eps * np.abs(sampled).max(axis=0)
        rounding.append(size * np.abs(WEIGHTS).sum() / (width * unit))
    gaps = np.maximum(np.abs(np.diff(found, axis=0)), rounding[1:])
    gaps = np.where(np.isnan(gaps), np.inf, gaps)
    best = np.argmin(gaps, axis=0)[np.newaxis]
    return (
        np.take_along_axis(np.array(found)[1:], best, axis=0)[0],
        np.take_along_axis(gaps, best, axis=0)[0],
    )
