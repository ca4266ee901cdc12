"""Searches in many intervals at once: where a condition changes, where a function is greatest."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt

    from assur._arrays import Float


def bisected(
    is_like_low: Callable[[Any], Any], low: npt.ArrayLike, high: npt.ArrayLike, halvings: int
) -> tuple[Float, Float]:
    """Return intervals after this many halvings, each about a change of the condition.

    The condition says of places in the middle whether they are as the low end is.
    """
    low, high = np.asarray(low), np.asarray(high)
    for _ in range(halvings if low.size else 0):
        middle = 0.5 * (low + high)
        same = is_like_low(middle)
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return low, high


def narrowed(
    height: Callable[[Float], Float], low: Float, high: Float, places: int, closest: float
) -> tuple[Float, npt.NDArray[np.intp]]:
    """Return the places (n, places) tried last in n intervals about peaks, and which are the best.

    The neighbours of the best of a few places are the next interval, down to the part `closest` of
    the first: a smooth maximum is known to the square of that.
    """
    first, rows = np.abs(high - low), np.arange(low.size)
    part = np.arange(places) / (places - 1.0)
    while True:
        tried = low[:, np.newaxis] + part * (high - low)[:, np.newaxis]
        best = np.argmax(height(tried), axis=1)
        if (np.abs(high - low) <= closest * first).all():
            return tried, best
        low = tried[rows, np.maximum(best - 1, 0)]
        high = tried[rows, np.minimum(best + 1, places - 1)]
