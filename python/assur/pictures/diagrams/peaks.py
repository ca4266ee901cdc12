"""Extremes of sampled curves, between their samples."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from assur._search import narrowed

if TYPE_CHECKING:
    from collections.abc import Callable

    from assur._arrays import Float

# Smaller changes of a curve, relative to its values, are rounding.
FLAT = 1e-9
# If a curve has many hills, the highest are searched.
HILLS = 4
# A search tries this many places between two samples, then again about the best of them, until
# these are so much closer: four times.
PLACES, CLOSEST = 17, 1 / 500
# Interpolation counts where it gains more than this over the sample, relative to the range.
GAIN = 1e-6


class Peak(NamedTuple):
    """An extreme of a curve: where, and how great."""

    x: float
    y: float
    greatest: bool


def is_flat(y: Float) -> bool:
    """Whether a curve is constant but for rounding, or has no values."""
    known = y[np.isfinite(y)]
    return not known.size or bool(np.ptp(known) <= FLAT * np.abs(known).max())


def peaks(
    x: Float,
    y: Float,
    slope: Float | None = None,
    again: Callable[[Float], Float] | None = None,
) -> list[Peak]:
    """Return the greatest and the least value of a curve, in this order; nothing for a constant.

    Parameters
    ----------
    x, y : ndarray
        Samples; y is NaN in gaps.
    slope : ndarray, optional
        dy/dx at the samples.
    again : callable, optional
        The exact curve: solves at other places.

    Returns
    -------
    list of Peak
        Between the samples by `again`, by the cubic with the slopes, or by a parabola.
    """
    if is_flat(y):
        return []
    return [_peak(x, y, slope, again, sign) for sign in (1.0, -1.0)]


def _peak(
    x: Float,
    y: Float,
    slope: Float | None,
    again: Callable[[Float], Float] | None,
    sign: float,
) -> Peak:
    heights = np.where(np.isfinite(y), sign * y, -np.inf)
    padded = np.concatenate([[-np.inf], heights, [-np.inf]])
    hills = np.flatnonzero(
        (heights >= padded[:-2]) & (heights >= padded[2:]) & np.isfinite(heights)
    )
    hills = hills[np.argsort(-heights[hills], kind="stable")][:HILLS]
    tops = []
    for i in hills.tolist():
        low = i - 1 if i and np.isfinite(y[i - 1]) else i
        high = i + 1 if i + 1 < len(y) and np.isfinite(y[i + 1]) else i
        sample = (float(x[i]), float(y[i]))
        if low == high:
            tops.append(sample)
        elif again is not None:
            tops.append(_solved(again, (float(x[low]), float(x[high])), sample, sign))
        else:
            near = slice(low, high + 1)
            refined = (
                _parabola(x[near], y[near], sample)
                if slope is None
                else _cubic(x[near], y[near], slope[near], sign)
            )
            gains = sign * (refined[1] - sample[1]) > GAIN * float(np.nanmax(y) - np.nanmin(y))
            tops.append(refined if gains else sample)
    at, value = max(tops, key=lambda point: sign * point[1])
    return Peak(at, value, sign > 0.0)


def _solved(
    again: Callable[[Float], Float],
    between: tuple[float, float],
    best: tuple[float, float],
    sign: float,
) -> tuple[float, float]:
    def height(places: Float) -> Float:
        nonlocal best
        values = again(places[0])
        heights = np.where(np.isfinite(values), sign * values, -np.inf)
        i = int(np.argmax(heights))
        if heights[i] > sign * best[1]:
            best = float(places[0, i]), float(values[i])
        return heights[np.newaxis]

    low, high = np.array(between)[:, np.newaxis]
    narrowed(height, low, high, PLACES, CLOSEST)
    return best


def _cubic(x: Float, y: Float, slope: Float, sign: float) -> tuple[float, float]:
    """Return the extreme of the cubics through values and slopes."""
    best = max(zip(x.tolist(), y.tolist(), strict=True), key=lambda point: sign * point[1])
    for k in range(len(x) - 1):
        width = float(x[k + 1] - x[k])
        if width == 0.0:
            continue
        rise = (float(y[k + 1]) - float(y[k])) / width
        first, last = float(slope[k]), float(slope[k + 1])
        if not (np.isfinite(first) and np.isfinite(last)):
            continue
        # The derivative over the part u of the step.
        square, linear = 3.0 * (first + last - 2.0 * rise), 2.0 * (3.0 * rise - 2.0 * first - last)
        for root in np.roots([square, linear, first] if square else [linear, first]):
            u = float(root.real)
            if abs(root.imag) < 1e-12 and 0.0 < u < 1.0:
                value = float(y[k]) + width * u * (first + u * (linear / 2.0 + u * square / 3.0))
                best = max(best, (float(x[k]) + u * width, value), key=lambda p: sign * p[1])
    return best


def _parabola(x: Float, y: Float, sample: tuple[float, float]) -> tuple[float, float]:
    # Samples of a jump may have the same place.
    if len(x) < 3 or x[0] == x[1] or x[1] == x[2]:
        return sample
    before, after = (
        float(y[1] - y[0]) / float(x[1] - x[0]),
        float(y[2] - y[1]) / float(x[2] - x[1]),
    )
    bend = (after - before) / float(x[2] - x[0])
    if bend == 0.0:
        return sample
    at = (float(x[0]) + float(x[1])) / 2.0 - before / (2.0 * bend)
    near = min(max(at, float(x[0])), float(x[2])) - float(x[1])
    slope = before + bend * float(x[1] - x[0])
    return float(x[1]) + near, float(y[1]) + near * (slope + bend * near)
